// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/gm1020/frame.h"

#include <cstdint>
#include <string>

#include "lightcal_devices/transport/framing.h"

namespace lightcal::devices::gm1020 {
namespace {

struct Mark {
  std::size_t at;
  std::byte value;
};
constexpr std::array<Mark, 4> kMarks = {
    {{0, std::byte{0x33}}, {1, std::byte{0x22}}, {4, std::byte{0x01}}, {7, std::byte{0x11}}}};

constexpr unsigned kCountsMask = 0x0FFF;
constexpr unsigned kUnknownBits = 0x3000;
constexpr unsigned kTenTimes = 0x4000;
constexpr unsigned kHundredTimes = 0x8000;

unsigned BigEndian16(std::span<const std::byte> bytes, std::size_t at) {
  return (std::to_integer<unsigned>(bytes[at]) << 8U) | std::to_integer<unsigned>(bytes[at + 1]);
}

}  // namespace

bool MayBeginFrame(std::span<const std::byte> bytes) {
  if (bytes.size() > kFrameBytes) return false;
  for (const Mark& mark : kMarks) {
    if (mark.at < bytes.size() && bytes[mark.at] != mark.value) return false;
  }
  return true;
}

Result<LiveMeasurement> DecodeLive(std::span<const std::byte> bytes) {
  if (bytes.size() != kFrameBytes || !MayBeginFrame(bytes)) {
    return Failed(std::string(kBadReply), "gm1020",
                  "the frame is not 33 22 .. 01 .. 11; is this a GM1020, and is its cable firm?");
  }
  const unsigned light = BigEndian16(bytes, 2);
  if ((light & kUnknownBits) != 0) {
    return Failed(
        std::string(kBadReply), "gm1020",
        "the illuminance has bits whose meaning is unknown; please send a tape ({meter.tape})"
        " with what the display shows");
  }
  LiveMeasurement measurement;
  measurement.shown.counts = static_cast<int>(light & kCountsMask);
  measurement.shown.decimals =
      1 - ((light & kTenTimes) != 0 ? 1 : 0) - ((light & kHundredTimes) != 0 ? 2 : 0);
  measurement.temperature_C = static_cast<std::int16_t>(BigEndian16(bytes, 5)) / 10.0;
  return measurement;
}

}  // namespace lightcal::devices::gm1020
