// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/ut382/frame.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "lightcal_devices/transport/framing.h"

namespace lightcal::devices::ut382 {
namespace {

constexpr std::size_t kNibbles = 30;
constexpr std::size_t kSegmentBytes = kNibbles / 2;
using Segments = std::array<unsigned, kSegmentBytes>;

constexpr unsigned kSegmentsMask = 0x7FU;
constexpr unsigned kPoint = 0x80U;
constexpr unsigned kBlank = 0x00U;
constexpr unsigned kLetterL = 0x0BU;
// The seven-segment shapes of 0 .. 9.
constexpr std::array<unsigned, 10> kDigits = {0x7B, 0x60, 0x5E, 0x7C, 0x65,
                                              0x3D, 0x3F, 0x70, 0x7F, 0x7D};
// Which bytes hold the large digits, thousands first, and which of them may carry a point, and for
// how many decimals it stands.
constexpr std::array<std::size_t, 4> kLargeDigits = {4, 3, 2, 1};
constexpr std::array<std::size_t, 3> kPointOfDecimals = {2, 3, 4};

tl::unexpected<Error> BadFrame(std::string what) {
  return Failed(std::string(kBadReply), "ut382",
                std::move(what) + "; is this a UT382, and is its cable firm?");
}

bool Fits(std::size_t at, std::byte byte) {
  if (at < kNibbles) return (byte & std::byte{0xF0}) == std::byte{0x30};
  return byte == (at == kNibbles ? std::byte{0x0D} : std::byte{0x0A});
}

Segments SegmentsOf(std::span<const std::byte> bytes) {
  Segments segments{};
  for (std::size_t i = 0; i < kSegmentBytes; ++i) {
    const auto low = std::to_integer<unsigned>(bytes[2 * i]) & 0x0FU;
    const auto high = std::to_integer<unsigned>(bytes[2 * i + 1]) & 0x0FU;
    segments[i] = low | (high << 4U);
  }
  return segments;
}

std::string_view Frozen(unsigned mode) {
  if ((mode & 0x10U) != 0) return "HOLD";
  if ((mode & 0x20U) != 0) return "MAX";
  if ((mode & 0x40U) != 0) return "MIN";
  return "";
}

bool ShowsOverload(const Segments& segments) {
  constexpr std::array<unsigned, 4> kOverload = {kBlank, kDigits[0], kLetterL, kBlank};
  for (std::size_t i = 0; i < kOverload.size(); ++i) {
    if ((segments[kLargeDigits[i]] & kSegmentsMask) != kOverload[i]) return false;
  }
  return true;
}

// Leading blanks are allowed, others and a display without any digit are not.
std::optional<int> Counts(const Segments& segments) {
  std::optional<int> counts;
  for (const std::size_t at : kLargeDigits) {
    const unsigned shape = segments[at] & kSegmentsMask;
    if (shape == kBlank && !counts) continue;
    const auto* digit = std::ranges::find(kDigits, shape);
    if (digit == kDigits.end()) return std::nullopt;
    counts = 10 * counts.value_or(0) + static_cast<int>(digit - kDigits.begin());
  }
  return counts;
}

std::optional<int> Decimals(const Segments& segments) {
  int decimals = 0;
  for (std::size_t i = 0; i < kPointOfDecimals.size(); ++i) {
    if ((segments[kPointOfDecimals[i]] & kPoint) == 0) continue;
    if (decimals != 0) return std::nullopt;
    decimals = static_cast<int>(i) + 1;
  }
  return decimals;
}

}  // namespace

bool MayBeginFrame(std::span<const std::byte> bytes) {
  if (bytes.size() > kFrameBytes) return false;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (!Fits(i, bytes[i])) return false;
  }
  return true;
}

Result<Display> DecodeDisplay(std::span<const std::byte> bytes) {
  if (bytes.size() != kFrameBytes || !MayBeginFrame(bytes)) {
    return BadFrame("the frame is not 30 bytes 3n and an end of line");
  }
  const Segments segments = SegmentsOf(bytes);
  const unsigned flags = segments[9];
  Display display;
  display.in_menu = segments[0] != 0;
  display.automatic_range = (segments[10] & 0x02U) != 0;
  display.battery_low = (flags & 0x10U) != 0;
  display.frozen = Frozen(segments[11]);
  display.overload = ShowsOverload(segments);
  if (display.in_menu || display.overload) return display;

  const auto counts = Counts(segments);
  if (!counts) return BadFrame("the segments of the display are no digits");
  const auto decimals = Decimals(segments);
  if (!decimals) return BadFrame("the display has two decimal points");
  const unsigned unit = flags & 0x0CU;
  if (unit != 0x08U && unit != 0x04U) return BadFrame("the display shows neither lux nor fc");
  const bool ten_times = (flags & 0x01U) != 0;
  display.shown = {*counts, *decimals - (ten_times ? 1 : 0), unit == 0x04U};
  return display;
}

}  // namespace lightcal::devices::ut382
