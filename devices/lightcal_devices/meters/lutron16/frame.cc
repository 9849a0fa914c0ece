// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/lutron16/frame.h"

#include <optional>
#include <string>
#include <string_view>

#include "lightcal_devices/transport/framing.h"
#include "lightcal_devices/transport/tape.h"

namespace lightcal::devices::lutron16 {
namespace {

constexpr std::byte kStart{0x02};
constexpr std::byte kAlways4{'4'};
constexpr std::byte kEnd{0x0D};
constexpr std::size_t kDisplayAt = 2;
constexpr std::size_t kUnitAt = 3;
constexpr std::size_t kSignAt = 5;
constexpr std::size_t kDecimalsAt = 6;
constexpr std::size_t kDigitsAt = 7;
constexpr std::size_t kDigits = 8;
constexpr std::string_view kLuxCode = "15";
constexpr std::string_view kFootcandleCode = "16";
constexpr int kMostDecimals = 3;

tl::unexpected<Error> BadFrame(std::string what) {
  return Failed(std::string(kBadReply), "lutron16", std::move(what));
}

char CharAt(std::span<const std::byte> bytes, std::size_t at) {
  return std::to_integer<char>(bytes[at]);
}

std::optional<int> DigitAt(std::span<const std::byte> bytes, std::size_t at) {
  const char c = CharAt(bytes, at);
  if (c < '0' || c > '9') return std::nullopt;
  return c - '0';
}

std::optional<int> Counts(std::span<const std::byte> bytes) {
  int counts = 0;
  for (std::size_t i = 0; i < kDigits; ++i) {
    const auto digit = DigitAt(bytes, kDigitsAt + i);
    if (!digit) return std::nullopt;
    counts = 10 * counts + *digit;
  }
  return counts;
}

}  // namespace

bool MayBeginFrame(std::span<const std::byte> bytes) {
  if (bytes.size() > kFrameBytes) return false;
  if (!bytes.empty() && bytes[0] != kStart) return false;
  if (bytes.size() > 1 && bytes[1] != kAlways4) return false;
  return bytes.size() < kFrameBytes || bytes[kFrameBytes - 1] == kEnd;
}

Result<Measurement> DecodeMeasurement(std::span<const std::byte> bytes) {
  if (bytes.size() != kFrameBytes || !MayBeginFrame(bytes)) {
    return BadFrame("the frame is not 16 bytes from 02 '4' to 0D; is this a Lutron meter?");
  }
  Measurement measurement;
  const char display = CharAt(bytes, kDisplayAt);
  if (display != '1' && display != '2') {
    return BadFrame("the frame belongs to neither the upper nor the lower display");
  }
  measurement.upper_display = display == '1';
  if (!measurement.upper_display) return measurement;

  const std::string unit = {CharAt(bytes, kUnitAt), CharAt(bytes, kUnitAt + 1)};
  if (unit != kLuxCode && unit != kFootcandleCode) {
    return Failed("wrong_unit", "lutron16",
                  "the display shows the unit of code " + EscapedBytes(AsBytes(unit)) +
                      ", neither lux (15) nor foot-candles (16); switch the meter to light, or is "
                      "it another instrument?");
  }
  const char sign = CharAt(bytes, kSignAt);
  const auto decimals = DigitAt(bytes, kDecimalsAt);
  const auto counts = Counts(bytes);
  if ((sign != '0' && sign != '1') || !decimals || *decimals > kMostDecimals || !counts) {
    return BadFrame(
        "the display shows no number; when it shows dashes the light is beyond the range: choose a "
        "higher one");
  }
  measurement.shown = {*counts, *decimals, unit == kFootcandleCode};
  measurement.negative = sign == '1';
  return measurement;
}

}  // namespace lightcal::devices::lutron16
