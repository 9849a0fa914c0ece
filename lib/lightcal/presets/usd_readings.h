// SPDX-License-Identifier: Apache-2.0
// How renderers are documented to read UsdLux, each a variant of the .usda that lightcal writes.
// The table of what they misread, with its sources, stands in README.md of this room.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace lightcal {

enum class UsdReading : std::uint8_t {
  kSpec,     // the schema's own text (OpenUSD 25.05 and later)
  kKarma,    // suns in nits: what normalize makes of them is told in two ways
  kArnold,   // tubes normalised: arnold-usd's procedural leaves that switch on
  kRtx,      // NVIDIA's ovrtx documents the schema's text
  kRtx2024,  // suns as pictures of USD Composer show them: pi brighter, normalize ignored
};

struct UsdReadingRow {
  UsdReading reading;
  std::string_view word;  // the variant's name
  std::string_view note;  // what is documented and what is not; in the file, too
};

[[nodiscard]] std::span<const UsdReadingRow> UsdReadings();

}  // namespace lightcal
