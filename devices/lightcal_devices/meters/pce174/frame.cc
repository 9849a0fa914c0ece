// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/pce174/frame.h"

#include <string>

#include "lightcal_devices/transport/framing.h"

namespace lightcal::devices::pce174 {
namespace {

constexpr std::array<std::byte, 3> kMagic = {std::byte{0xAA}, std::byte{0xDD}, std::byte{0x00}};
constexpr std::size_t kRawHighAt = 12;
constexpr std::size_t kRawLowAt = 13;
constexpr std::size_t kStatus0At = 14;
constexpr std::size_t kStatus1At = 15;
constexpr unsigned kHighestPair = 99;

constexpr unsigned kHold = 0x40;
constexpr unsigned kFootcandles = 0x04;
constexpr unsigned kBatteryLow = 0x20;
constexpr unsigned kNegative = 0x10;
constexpr unsigned kMemoryMask = 0x03;
constexpr unsigned kRecall = 0x02;

// By the mode's number; the two without a name are not documented.
constexpr std::array<std::string_view, 8> kModes = {"",    "?",   "PMIN", "PMAX",
                                                    "MAX", "MIN", "REL",  "?"};
// Decimals of the range's number, in lx: 400k, 400, 4k, 40k. In fc: 40k, 40, 400, 4k.
constexpr std::array<int, 4> kLuxDecimals = {-2, 1, 0, -1};
constexpr std::array<int, 4> kFootcandleDecimals = {-1, 2, 1, 0};

tl::unexpected<Error> BadFrame(std::string what) {
  return Failed(std::string(kBadReply), "pce174",
                std::move(what) + "; is this a PCE-174 or HD450, and is its cable firm?");
}

}  // namespace

bool MayBeginFrame(std::span<const std::byte> bytes) {
  if (bytes.size() > kFrameBytes) return false;
  for (std::size_t i = 0; i < bytes.size() && i < kMagic.size(); ++i) {
    if (bytes[i] != kMagic[i]) return false;
  }
  return true;
}

Result<Measurement> DecodeMeasurement(std::span<const std::byte> bytes) {
  if (bytes.size() != kFrameBytes || !MayBeginFrame(bytes)) {
    return BadFrame("the reply is not 18 bytes from AA DD 00 on");
  }
  const auto high = std::to_integer<unsigned>(bytes[kRawHighAt]);
  const auto low = std::to_integer<unsigned>(bytes[kRawLowAt]);
  if (high > kHighestPair || low > kHighestPair) {
    return BadFrame("the number's digits are above 99");
  }
  const auto status0 = std::to_integer<unsigned>(bytes[kStatus0At]);
  const auto status1 = std::to_integer<unsigned>(bytes[kStatus1At]);
  Measurement measurement;
  measurement.mode = kModes[(status0 >> 3U) & 7U];
  if (measurement.mode == "?") return BadFrame("the meter is in a mode nobody has documented");
  if ((status0 & kHold) != 0) measurement.mode = "HOLD";
  if ((status1 & kMemoryMask) == kRecall) measurement.mode = "LOAD";
  const bool footcandles = (status0 & kFootcandles) != 0;
  const auto& decimals = footcandles ? kFootcandleDecimals : kLuxDecimals;
  measurement.raw = {static_cast<int>(100 * high + low), decimals[status0 & 3U], footcandles};
  measurement.negative = (status1 & kNegative) != 0;
  measurement.battery_low = (status1 & kBatteryLow) != 0;
  return measurement;
}

}  // namespace lightcal::devices::pce174
