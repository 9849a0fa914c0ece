// SPDX-License-Identifier: Apache-2.0
// Colours of light as a screen can show them.
#pragma once

#include <string>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::report {

// "#ffd3a1" of a linear colour, sRGB-encoded (IEC 61966-2-1), components clamped to 0..1.
[[nodiscard]] std::string HexOf(const Rgb& linear);

// A chromaticity at full brightness: out of gamut it is desaturated, then its largest component
// is 1. Holds for y > 0.
[[nodiscard]] std::string SwatchOf(Xy xy);

// "#ffd3a1": the light's colour at full brightness; empty when its colour is unknown.
[[nodiscard]] std::string SwatchOf(const FittedColor& color);

}  // namespace lightcal::report
