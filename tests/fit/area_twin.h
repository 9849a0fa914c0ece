// SPDX-License-Identifier: Apache-2.0
// Lamps with size, aim and cone as sums over thousands of small pieces: what a meter anywhere would
// read. Shares nothing with the models the fit uses.
#pragma once

#include <array>
#include <random>
#include <vector>

#include "lightcal/records/session.h"

namespace lightcal::test {

struct AreaTwin {
  LightDescription light;                   // kind, size, position, aim as a session would say them
  double intensity_cd = 1.0;                // on the axis, of the far field
  double offset_m = 0.0;                    // how far the light really starts behind its position
  Vec3 width_axis{1.0, 0.0, 0.0};           // unit: of a rect's width, a tube's length
  double inner_rad = 0.0, outer_rad = 3.2;  // of a spot, the truth
};

// One of that kind at the origin, as large as such lamps are, its aim along y.
[[nodiscard]] AreaTwin LampOfKind(LightKind kind);

// Illuminance on a meter of unit normal.
[[nodiscard]] double TrueLux(const AreaTwin& twin, const Vec3& meter, const Vec3& normal);

struct Pose {
  Vec3 position;
  Vec3 normal;
};
// Readings of it at poses with log-normal noise.
[[nodiscard]] Session ReadAt(const AreaTwin& twin, const std::vector<Pose>& poses, double sigma,
                             std::mt19937_64& random);

// Meters round a lamp at the origin that shines along `aim`: turned off its direction by up to
// `tilt_rad`, off its axis by up to `off_rad`, `near` to `far` away.
[[nodiscard]] std::vector<Pose> PosesAround(const Vec3& aim, int count, double near, double far,
                                            double off_rad, double tilt_rad,
                                            std::mt19937_64& random);

}  // namespace lightcal::test
