// SPDX-License-Identifier: Apache-2.0
// Where a fixture's light starts and how wide it shines, by its zoom and by what is in front of it.
#pragma once

#include <string>
#include <vector>

#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// Whether two states have one offset and beam: the same words (a modifier) and the same zoom_deg.
[[nodiscard]] bool SameGeometry(const FixtureState& a, const FixtureState& b);

// A session by the geometries of one light.
struct GeometryParts {
  Session main;                 // without the readings of `others`
  std::vector<Session> others;  // each of one other geometry, its reference state apart
};
// Geometries other than the reference's that were read at two places or more at one state, so that
// they tell where their light starts. `others` is empty where there is none; then main is too.
[[nodiscard]] GeometryParts SplitGeometries(const Session& session, const LightDescription& light);

// The light as described at that state; without the cone that it gives for its reference where the
// readings of `part` across the beam tell this one's.
[[nodiscard]] LightDescription DescriptionFromReadings(const Session& part,
                                                       const LightDescription& light,
                                                       const FixtureState& state);

// The states of `own`, the same light fitted at another geometry, become states of `light`:
//   relative = I_own/I_light k,   ln of variance s_own^2 + s_light^2 - 2 s_meter^2 + s_k^2
// of the intensities, the scale of the one meter that read both being in neither. Its offset, size,
// beam and flux become one of light.geometries.
void TakeGeometry(const FittedLight& own, FittedLight& light);

// Geometries that were not fitted, but that the light's `at` describe: size, cone and flux as they
// say, the offset as of the light's own state.
void DescribeOtherGeometries(const LightDescription& light, FittedLight& fitted);

}  // namespace lightcal::fit
