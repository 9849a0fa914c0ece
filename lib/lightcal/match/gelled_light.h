// SPDX-License-Identifier: Apache-2.0
// A fitted light behind gels.
#pragma once

#include "lightcal/match/match_lights.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::match {

// The light with the match's colour, its intensity, flux, illuminance and luminance 2^-stops_lost
// of what they were, the gels' uncertainty added in quadrature. Where it stands and how it spreads
// stay: a gel before the lamp's mouth changes neither. Effects and residuals are of the readings
// without gels, and are left out.
[[nodiscard]] FittedLight LightBehind(const FittedLight& light, const Match& match);

// A lamp known by its spectrum alone, behind gels, as light that falls where the meter stood:
// directional, with the illuminance read there. Refused: "no_level" (a relative spectrum).
[[nodiscard]] Result<FittedLight> LightAtMeter(const MatchRequest& request, const Match& match,
                                               const std::string& name);

}  // namespace lightcal::match
