// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/sekonic/frame.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"

namespace lightcal::devices::sekonic {
namespace {

using ByteSpan = std::span<const std::byte>;

constexpr std::size_t kDataOffset = 5;  // after XX@@@
constexpr std::size_t kStateBytes = 5;
constexpr double kLowestCheckedLx = 5.0;  // below, the spectrum is mostly noise

// Where the values of an NR reply stand.
constexpr std::size_t kTitleAt = 7;
constexpr std::size_t kTitleBytes = 16;
constexpr std::size_t kCctAt = 50;
constexpr std::size_t kDuvAt = 55;
constexpr std::size_t kLuxAt = 271;
constexpr std::size_t kFootcandleAt = 276;
constexpr std::size_t kXAt = 281;
constexpr std::size_t kYAt = 290;
constexpr std::size_t kZAt = 299;
constexpr std::size_t kChromaXAt = 308;
constexpr std::size_t kChromaYAt = 313;
constexpr std::size_t kRaAt = 348;
constexpr std::size_t kRiAt = 353;
constexpr std::size_t kRiStride = 5;
constexpr std::size_t kSpectrumAt = 753;
constexpr std::size_t kSpectrumStride = 4;
constexpr std::array<std::size_t, 14> kCommas = {6,   23,  49,  54,  270, 275, 280,
                                                 289, 298, 307, 312, 347, 427, 752};

tl::unexpected<Error> BadReply(std::string what) {
  return Failed(std::string(kBadReply), "sekonic",
                std::move(what) + "; try again, then switch the meter off and on");
}

template <class Unsigned>
Unsigned BigEndian(ByteSpan bytes, std::size_t at) {
  Unsigned value = 0;
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
    value = static_cast<Unsigned>(value << 8U) | std::to_integer<Unsigned>(bytes[at + i]);
  }
  return value;
}

double Float64At(ByteSpan bytes, std::size_t at) {
  return std::bit_cast<double>(BigEndian<std::uint64_t>(bytes, at));
}

// The double whose text is the float's own shortest text.
double Float32At(ByteSpan bytes, std::size_t at) {
  const auto value = std::bit_cast<float>(BigEndian<std::uint32_t>(bytes, at));
  if (!std::isfinite(value)) return static_cast<double>(value);
  std::array<char, 32> text{};
  const auto written = std::to_chars(text.data(), text.data() + text.size(), value);
  double decimal = 0.0;
  std::from_chars(text.data(), written.ptr, decimal);
  return decimal;
}

// Printable characters from `at` up to the first NUL.
std::string TextAt(ByteSpan bytes, std::size_t at, std::size_t length) {
  std::string text;
  for (const std::byte b : bytes.subspan(at, length)) {
    const char c = static_cast<char>(std::to_integer<unsigned char>(b));
    if (c == '\0') break;
    if (c >= ' ' && c <= '~') text += c;
  }
  return std::string(TrimBlanks(text));
}

std::string_view WhatKeepsItBusy(unsigned s2) {
  if ((s2 & 0x01U) != 0) return "initialising";
  if ((s2 & 0x04U) != 0) return "calibrating its dark signal";
  if ((s2 & 0x10U) != 0) return "waiting for a flash";
  if ((s2 & 0x08U) != 0) return "measuring";
  return "busy";
}

bool Agrees(double a, double b, double relative) {
  return std::isfinite(a) && std::isfinite(b) &&
         std::abs(a - b) <= relative * std::max(std::abs(a), std::abs(b));
}

Warning Disagreement(std::string_view subject, const std::string& what) {
  return {
      "self_check", std::string(subject),
      what +
          "; the reading may be damaged: measure again, and keep a tape ({meter.tape}) to report"};
}

}  // namespace

Result<void> DecodeAcknowledge(ByteSpan bytes) {
  constexpr std::array kAccepted = {std::byte{0x06}, std::byte{0x30}};
  constexpr std::array kRefused = {std::byte{0x15}, std::byte{0x32}};
  if (std::ranges::equal(bytes, kAccepted)) return {};
  if (std::ranges::equal(bytes, kRefused)) {
    return Failed("nak", "sekonic",
                  "the meter refused the command; leave its menus, then try again");
  }
  return BadReply("acknowledged with " + std::to_string(bytes.size()) +
                  " bytes that are neither yes nor no");
}

Result<void> CheckEcho(ByteSpan bytes, std::string_view command) {
  const bool echoed = bytes.size() >= 2 && command.size() >= 2 &&
                      std::to_integer<char>(bytes[0]) == command[0] &&
                      std::to_integer<char>(bytes[1]) == command[1];
  if (echoed) return {};
  return BadReply("answered something other than " + std::string(command.substr(0, 2)));
}

Result<std::string> DecodeModel(ByteSpan bytes) {
  if (bytes.size() <= kDataOffset) return BadReply("the model's name is missing");
  std::string model = TextAt(bytes, kDataOffset, bytes.size() - kDataOffset);
  if (model.empty()) return BadReply("the model's name is empty");
  return model;
}

Result<Firmware> DecodeFirmware(ByteSpan bytes) {
  if (bytes.size() <= kDataOffset) return BadReply("the firmware's version is missing");
  Firmware firmware{TextAt(bytes, kDataOffset, bytes.size() - kDataOffset), 0};
  std::string_view rest = firmware.text;
  for (int skipped = 0; skipped < 2; ++skipped) {
    const auto comma = rest.find(',');
    if (comma == std::string_view::npos)
      return BadReply("the firmware's version has no third field");
    rest.remove_prefix(comma + 1);
  }
  const auto number = ParseNumber(rest.substr(0, rest.find(',')));
  if (!number || std::abs(*number) > 1e6) return BadReply("the firmware's version is not a number");
  firmware.main = static_cast<int>(*number);
  return firmware;
}

Result<State> DecodeState(ByteSpan bytes) {
  if (bytes.size() != kStateBytes) {
    return BadReply("the state has " + std::to_string(bytes.size()) + " bytes, not 5");
  }
  const auto s1 = std::to_integer<unsigned>(bytes[2]);
  const auto s2 = std::to_integer<unsigned>(bytes[3]);
  const auto key = std::to_integer<unsigned>(bytes[4]);
  State state;
  if ((s1 & 0x10U) != 0) {
    state.activity = Activity::kHardwareError;
  } else if ((s1 & 0x01U) != 0) {
    state.activity = Activity::kBusy;
    state.doing = WhatKeepsItBusy(s2);
  }
  const bool busy = state.activity == Activity::kBusy;
  state.calibrating_dark = busy && (s2 & 0x05U) == 0x04U;
  state.outside_measurement = state.activity == Activity::kIdle && (s1 & 0x08U) != 0;
  state.remote = (s1 & 0x02U) != 0;
  state.measure_button_held = (key & 0x1FU) == 0x02U;
  state.ring = static_cast<Ring>((key & 0x60U) >> 5U);
  return state;
}

std::string_view RingName(Ring ring) {
  switch (ring) {
    case Ring::kUnpositioned:
      return "between two positions";
    case Ring::kCalibration:
      return "at CAL";
    case Ring::kLow:
      return "at LOW";
    case Ring::kHigh:
      return "at HIGH";
  }
  return "";
}

namespace {

// A reply of this layout, whatever command it answers.
Result<Measurement> DecodeLayout(ByteSpan bytes, std::string_view command) {
  if (bytes.size() != kMeasurementBytes) {
    return BadReply("the measurement has " + std::to_string(bytes.size()) + " bytes, not " +
                    std::to_string(kMeasurementBytes));
  }
  if (auto echo = CheckEcho(bytes, command); !echo) return tl::unexpected(echo.error());
  for (const std::size_t at : kCommas) {
    if (bytes[at] != std::byte{','}) {
      return BadReply("the measurement has no comma at byte " + std::to_string(at));
    }
  }
  Measurement m;
  m.title = TextAt(bytes, kTitleAt, kTitleBytes);
  m.cct_K = Float32At(bytes, kCctAt);
  m.duv = Float32At(bytes, kDuvAt);
  m.illuminance_lx = Float32At(bytes, kLuxAt);
  m.illuminance_fc = Float32At(bytes, kFootcandleAt);
  m.xyz = {Float64At(bytes, kXAt), Float64At(bytes, kYAt), Float64At(bytes, kZAt)};
  m.xy = {Float32At(bytes, kChromaXAt), Float32At(bytes, kChromaYAt)};
  m.cri_Ra = Float32At(bytes, kRaAt);
  for (std::size_t i = 0; i < m.cri_R.size(); ++i) {
    m.cri_R[i] = Float32At(bytes, kRiAt + kRiStride * i);
  }
  for (std::size_t i = 0; i < kSpectrumSamples; ++i) {
    m.spectrum.push_back(Float32At(bytes, kSpectrumAt + kSpectrumStride * i));
  }
  if (!std::isfinite(m.illuminance_lx) || m.illuminance_lx < 0.0) {
    return BadReply("the illuminance is not a number of lux");
  }
  return m;
}

}  // namespace

Result<Measurement> DecodeMeasurement(ByteSpan bytes) { return DecodeLayout(bytes, "NR"); }

Result<Measurement> DecodeStoredMeasurement(ByteSpan bytes) { return DecodeLayout(bytes, "MR"); }

Result<int> DecodeMemoryInfo(ByteSpan bytes) {
  if (auto echo = CheckEcho(bytes, "MI"); !echo) return tl::unexpected(echo.error());
  const std::string text =
      bytes.size() <= kDataOffset ? "" : TextAt(bytes, kDataOffset, bytes.size() - kDataOffset);
  const auto first = text.find(',');
  if (first == std::string::npos) return BadReply("the memory's size is missing");
  const std::string_view rest = std::string_view(text).substr(first + 1);
  const auto count = ParseNumber(rest.substr(0, rest.find(',')));
  if (!count || *count < 0.0 || *count > kMostStored + 1 || *count != std::floor(*count)) {
    return BadReply("the memory's size is no number of measurements");
  }
  return static_cast<int>(*count);
}

std::string StoredMeasurementCommand(int index) {
  const std::string digits = std::to_string(index);
  return "MR" + std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits;
}

Warnings SelfCheck(const Measurement& m, std::string_view subject) {
  Warnings warnings;
  const double lux = m.illuminance_lx;
  const std::string reads = "the meter says " + RoundedText(lux, 6) + " lx";
  if (!Agrees(m.xyz.Y, lux, 1e-5)) {
    warnings.push_back(Disagreement(subject, reads + " but another Y in the same reply"));
  }
  if (!Agrees(m.illuminance_fc * kLuxPerFootcandle, lux, 1e-4)) {
    warnings.push_back(Disagreement(subject, reads + " but other foot-candles in the same reply"));
  }
  if (lux < kLowestCheckedLx) return warnings;
  const Xy from_xyz = XyFromXyz(m.xyz);
  if (!Agrees(from_xyz.x, m.xy.x, 1e-4) || !Agrees(from_xyz.y, m.xy.y, 1e-4)) {
    warnings.push_back(Disagreement(subject, "xy and XYZ of the same reply are different colours"));
  }
  Spectrum spectrum{{}, m.spectrum, SpectralQuantity::kIrradiance};
  for (int i = 0; i < kSpectrumSamples; ++i) {
    spectrum.wavelengths_nm.push_back(kSpectrumStartNm + i);
  }
  const auto integral = XyzFromSpectrum(spectrum);
  if (!integral || !Agrees(integral->Y, lux, 0.01)) {
    const std::string found = integral ? RoundedText(integral->Y, 6) + " lx" : "no illuminance";
    warnings.push_back(Disagreement(subject, reads + " but its spectrum integrates to " + found));
  }
  return warnings;
}

}  // namespace lightcal::devices::sekonic
