// SPDX-License-Identifier: Apache-2.0
// Bytes of the Sekonic C-700, C-800 and C-7000 as values. Pure: no wire, no clock.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/core/result.h"

namespace lightcal::devices::sekonic {

// The code of a reply that is not what the protocol promises; asking again may help.
inline constexpr std::string_view kBadReply = "bad_reply";

inline constexpr std::size_t kMeasurementBytes = 2380;
inline constexpr std::size_t kLongestReplyBytes = 4160;

// The first of the two transfers that answer a command: 06 30 accepted, 15 32 refused (then there
// is no second). Fails: nak, bad_reply.
[[nodiscard]] Result<void> DecodeAcknowledge(std::span<const std::byte> bytes);

// The second transfer repeats the command's first two characters. Fails: bad_reply.
[[nodiscard]] Result<void> CheckEcho(std::span<const std::byte> bytes, std::string_view command);

// MN@@@C-800\0... -> "C-800".
[[nodiscard]] Result<std::string> DecodeModel(std::span<const std::byte> bytes);

// FV@@@20,C36E,27,7881,... -> the text after FV@@@, and the main firmware, its third field (27).
struct Firmware {
  std::string text;
  int main = 0;
};
[[nodiscard]] Result<Firmware> DecodeFirmware(std::span<const std::byte> bytes);

enum class Activity { kIdle, kBusy, kHardwareError };
enum class Ring { kUnpositioned = 0, kCalibration = 1, kLow = 2, kHigh = 3 };

// The five bytes S T s1 s2 key of the state.
struct State {
  Activity activity = Activity::kIdle;
  std::string_view doing;  // "initialising", "measuring", ... while busy
  bool remote = false;
  bool measure_button_held = false;
  Ring ring = Ring::kUnpositioned;
  bool calibrating_dark = false;     // busy with its dark signal: may take long
  bool outside_measurement = false;  // idle, but in its menus
};
[[nodiscard]] std::string_view RingName(Ring ring);  // "HIGH"
[[nodiscard]] Result<State> DecodeState(std::span<const std::byte> bytes);

inline constexpr int kSpectrumSamples = 401;  // 380 .. 780 nm, 1 nm
inline constexpr double kSpectrumStartNm = 380.0;

// The reply to NR, number for number; any may be non-finite where the meter had none. A float32 is
// given as the shortest decimal that is that float (406.96, not 406.95999), as a double.
struct Measurement {
  std::string title;
  double cct_K = 0.0;
  double duv = 0.0;
  double illuminance_lx = 0.0;
  double illuminance_fc = 0.0;
  Xyz xyz;
  Xy xy;
  double cri_Ra = 0.0;
  std::array<double, 15> cri_R{};
  std::vector<double> spectrum;  // kSpectrumSamples of W m^-2 nm^-1
};
// Refuses any reply but exactly 2380 bytes with the prefix NR and commas where they belong.
// Layout: README.md.   Fails: bad_reply.
[[nodiscard]] Result<Measurement> DecodeMeasurement(std::span<const std::byte> bytes);

// A measurement kept in the memory of a C-7000, numbered from 0: the reply to MRnnnn, which is laid
// out as NR is. Experimental: known from one public driver only.   Fails: bad_reply.
[[nodiscard]] Result<Measurement> DecodeStoredMeasurement(std::span<const std::byte> bytes);

// MIB@@u,captures,titles -> captures.   Fails: bad_reply.
inline constexpr int kMostStored = 9999;  // four digits name one
[[nodiscard]] Result<int> DecodeMemoryInfo(std::span<const std::byte> bytes);

// "MR0007"; `index` from 0 to kMostStored.
[[nodiscard]] std::string StoredMeasurementCommand(int index);

// What a sound measurement agrees with itself on; each that does not hold is a warning self_check:
//   Y = E (1e-5), E/E_fc = 10.7639 lx/fc (1e-4), xy of XYZ = xy (1e-4), and, from 5 lx up,
//   E = 683 sum ybar(l) S(l) dl (1 %).
[[nodiscard]] Warnings SelfCheck(const Measurement& measurement, std::string_view subject);

}  // namespace lightcal::devices::sekonic
