// SPDX-License-Identifier: Apache-2.0
// What was described and estimated of a lamp, as its FittedLight has it.
#pragma once

#include "lightcal/fit/estimate_light.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// Name, kind, sizes, cone and pose as described; nothing measured yet.
[[nodiscard]] FittedLight Describe(const LightDescription& light);

// Intensity (or illuminance), offset and ambient light with their 95 % intervals, and their
// covariance. An upper limit becomes the interval from 0 to it.
void FillParameters(const LightEstimate& estimate, bool distance_law, FittedLight& out);

// Flux and luminance that follow from the intensity; none where a size that the kind needs is not
// given.
void AddDerivedQuantities(const LightDescription& light, FittedLight& out);

}  // namespace lightcal::fit
