// SPDX-License-Identifier: Apache-2.0
// use = "ball": pictures of mirror balls -> where the lamp is.
#pragma once

#include <string>
#include <vector>

#include "lightcal/calibrate/evidence.h"
#include "lightcal/core/result.h"
#include "lightcal/core/vec3.h"
#include "lightcal/records/session.h"
#include "lightcal/records/sources.h"

namespace lightcal {

struct BallPlacement {
  std::string light;
  Vec3 position_m{};
  Vec3 u95_m{};
};

// One place for each light with [[capture]]s of use = "ball", from all of them together; it is to
// become the position_m of a light without. Warned: position_differs (the session gives another
// place, which is believed), several_highlights.
// Refused: several_pictures, bad_region, and as Sources::read_frame, PixelSolidAngles,
// FindHighlight, RayOfBall, LampOfRays.
[[nodiscard]] Result<std::vector<BallPlacement>> PlaceByBalls(const Session& session,
                                                              const Sources& sources,
                                                              Evidence& evidence);

}  // namespace lightcal
