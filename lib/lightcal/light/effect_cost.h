// SPDX-License-Identifier: Apache-2.0
// What an effect's own arithmetic is and what it costs here and now.
#pragma once

#include <string_view>

#include "lightcal/light/scene.h"

namespace lightcal {

// Illuminance at the pose over that of a point in the open, I cos(t)/d^2, by this effect alone:
// finite source, tilt, head, haze, narrow beam, offset, the room's bounce and ambient light, each
// by the formula of its file in light/effects. 1 of an effect that only widens the interval, and of
// one that the scene has nothing of.
[[nodiscard]] double FactorOfEffect(std::string_view name, const Scene& scene,
                                    const ScenePose& pose);

// Processor time of that formula for one of the scene's readings, in ns (of an effect that only
// widens: of its part of the interval): the least of several
// batches, so that what else the machine does counts little. Measured, never the same twice.
[[nodiscard]] double MeasuredCost_ns(std::string_view name, const Scene& scene);

}  // namespace lightcal
