// SPDX-License-Identifier: Apache-2.0
// HID report descriptors: which bits of which report mean what. Pure.
// Source: USB Device Class Definition for HID 1.11, section 6.2.2.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices::hid_als {

inline constexpr std::string_view kBadDescriptor = "bad_descriptor";

// Usage page in the upper half, usage in the lower: 0x00200041 = ambient light sensor.
using Usage = std::uint32_t;
[[nodiscard]] constexpr Usage SensorUsage(std::uint16_t usage) { return 0x00200000U | usage; }

enum class ReportKind { kInput, kOutput, kFeature };

// One data item of one report. Constant (padding) items have no field.
struct Field {
  ReportKind kind = ReportKind::kInput;
  std::uint8_t report = 0;  // its number, 0 = the device has no numbers
  Usage usage = 0;          // of a variable
  // An array (a selector of HID sensors) holds an index into these, counted from logical_min; what
  // it selects for is the usage of the collection around it. Empty for a variable.
  std::vector<Usage> choices;
  std::vector<Usage> collections;  // around it, outermost first
  std::uint32_t bit_offset = 0;    // from the start of the report, its number (if any) included
  std::uint8_t bit_count = 0;      // 1 .. 32
  std::int64_t logical_min = 0;
  std::int64_t logical_max = 0;
  std::int8_t unit_exponent = 0;  // value = raw * 10^this

  // The raw number in `report_bytes`, sign-extended where logical_min < 0. Absent when the report
  // is too short or the number lies outside the logical range.
  [[nodiscard]] std::optional<std::int64_t> RawIn(std::span<const std::byte> report_bytes) const;
  // raw * 10^exponent.
  [[nodiscard]] std::optional<double> ValueIn(std::span<const std::byte> report_bytes) const;
  // The choice an array has made.
  [[nodiscard]] std::optional<Usage> ChoiceIn(std::span<const std::byte> report_bytes) const;
  // Writes a raw number into its bits; false when the report is too short for it.
  [[nodiscard]] bool Put(std::int64_t raw, std::span<std::byte> report_bytes) const;
};

struct ReportLength {
  ReportKind kind = ReportKind::kInput;
  std::uint8_t report = 0;
  std::uint32_t bits = 0;  // the report's number and its padding included
};

struct ReportDescriptor {
  std::vector<Field> fields;
  std::vector<ReportLength> lengths;
  bool numbered = false;  // reports begin with their number
  // Bytes of a report, its number included; 0 = there is none.
  [[nodiscard]] std::size_t ReportBytes(ReportKind kind, std::uint8_t report) const;
};

// Short items, report numbers, push and pop, usages and usage ranges; long items are skipped.
// Refuses what is cut short, pops more than was pushed, or is larger than these limits (a sound
// device has far less).   Fails: bad_descriptor.
inline constexpr std::size_t kLongestDescriptor = 4096;
inline constexpr std::size_t kMostFields = 2048;
inline constexpr std::size_t kDeepestNesting = 32;
inline constexpr std::uint32_t kLongestReportBits = 8 * 4096;
[[nodiscard]] Result<ReportDescriptor> ParseReportDescriptor(std::span<const std::byte> bytes);

}  // namespace lightcal::devices::hid_als
