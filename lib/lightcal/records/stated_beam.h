// SPDX-License-Identifier: Apache-2.0
// A beam drawn from the angles of a data sheet, told from one that was measured.
#pragma once

#include <string>
#include <string_view>

#include "lightcal/records/fitted_light.h"

namespace lightcal {

// The only family of MeasuredBeam where no reading told the beam.
inline constexpr std::string_view kStatedBeam = "stated";

[[nodiscard]] inline bool OfStatedBeam(const FittedLight& light) {
  return light.beam && light.beam->families.size() == 1 &&
         light.beam->families.front().name == kStatedBeam;
}

// What a light's distribution is, in a sentence of what became of it.
[[nodiscard]] inline std::string DistributionWords(const FittedLight& light) {
  return OfStatedBeam(light) ? "a beam drawn from its stated angle" : "a measured distribution";
}

}  // namespace lightcal
