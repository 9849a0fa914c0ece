// SPDX-License-Identifier: Apache-2.0
// Typical values to hold a measurement or a scene against, each with where it comes from.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace lightcal {

enum class ReferenceQuantity {
  kFlux,         // lm
  kIlluminance,  // lx
  kLuminance,    // cd/m^2
  kEfficacy,     // lm/W
};
enum class ReferenceBasis {
  kStandard,     // a standard or regulation requires or defines it
  kPublished,    // a publication reports it
  kDerived,      // follows from a definition by arithmetic
  kRuleOfThumb,  // nobody in particular says so; good to half an order of magnitude
};

// low..high in the quantity's unit; equal where the source gives one figure.
struct ReferenceValue {
  ReferenceQuantity quantity;
  double low;
  double high;
  std::string_view what;
  ReferenceBasis basis;
  std::string_view source;
  std::optional<double> seed_value;  // the seed's differing figure, same unit
  std::string_view seed_note;        // what the seed says and why it is doubtful, "" = nothing
};

[[nodiscard]] std::span<const ReferenceValue> ReferenceValues();

// "lm" "lx" "cd/m²" "lm/W", and "luminous flux" "illuminance" "luminance" "luminous efficacy".
[[nodiscard]] std::string_view ReferenceUnit(ReferenceQuantity quantity);
[[nodiscard]] std::string_view ReferenceQuantityName(ReferenceQuantity quantity);
// "standard" "published" "derived" "rule of thumb"
[[nodiscard]] std::string_view ReferenceBasisName(ReferenceBasis basis);

}  // namespace lightcal
