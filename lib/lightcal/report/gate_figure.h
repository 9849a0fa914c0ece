// SPDX-License-Identifier: Apache-2.0
// What the effect gate saves, as a picture.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightcal/records/fitted_light.h"

namespace lightcal::report {

// The tolerance that effects are judged by where nobody says another; a light.json keeps none.
inline constexpr double kUsualTolerance = 0.01;

// Whether any light says which effects it considered.
[[nodiscard]] bool HasEffects(const std::vector<FittedLight>& lights);

// Cost and error of one evaluation with every effect, with those the gate calls for and with none,
// over the scenes of light/gate_ladder.h, and below them the session's own lights: of those only
// what was left off at most is known, and what the effects found do when they are all left out. id
// must be unique in the page.
[[nodiscard]] std::string GateFigure(const std::vector<FittedLight>& lights, double tolerance,
                                     std::string_view id);

// A whole SVG file: GateFigure with its style sheet inside.
[[nodiscard]] std::string GatePlot(const std::vector<FittedLight>& lights, double tolerance);

}  // namespace lightcal::report
