// SPDX-License-Identifier: Apache-2.0
// An aim is as good as people set it (AngleSigma): where the light falls steeply about it, what is
// off is found from the readings under that prior.
#pragma once

#include "lightcal/core/vec3.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// The stated aim, tilted by x towards C0 and by y towards C90 (aim ~ aim + x c0 + y c90), and C0 as
// it goes with it. Unit vectors.
struct TiltedAim {
  Vec3 aim{}, c0{};
};
[[nodiscard]] TiltedAim Tilt(const LightDescription& light, double x, double y);

// Gives every lit row how its direct light goes with the aim (Observation::by_aim), of a lamp that
// shines to one side: by the meter's place, or by its angle off the axis; and how far off the aim
// may be (Observations::aim). Nothing where that moves no reading by half a percent, of a lamp
// whose size or cone is not known, and where the axis is exact (off_axis_sigma_deg = 0).
void LetAimMove(const LightDescription& light, Observations& observations);

}  // namespace lightcal::fit
