// SPDX-License-Identifier: Apache-2.0
// What a session says of one lamp and its readings, as the gate asks for it.
#pragma once

#include <optional>
#include <vector>

#include "lightcal/fit/model/observations.h"
#include "lightcal/light/scene.h"
#include "lightcal/light/wall_prior.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// The session's [room], its reflectance within a fifth (95 %) unless it says how well; absent:
// none.
[[nodiscard]] std::optional<StatedRoom> StatedRoomOf(const Session& session);

// What is known beforehand of the walls' light about this lamp, in the room that the session states
// or in an ordinary one.
[[nodiscard]] std::vector<WallHypothesis> WallPriorsOf(const Session& session,
                                                       const LightDescription& light);

// The lamp in time, as the session says it; its readings are its own.
[[nodiscard]] SceneTime TimeOfLamp(const Session& session, const LightDescription& light);

// Poses of the lit readings, the worst of the meters and pictures that took them, and the priors of
// walls (light/wall_prior.h) and distance offset (light/fixture.h). `patches`: along each side of a
// stated room's walls. No poses: nothing lit was read.
[[nodiscard]] Scene SceneOfSession(const Session& session, const LightDescription& light,
                                   const Observations& observations, int patches);

}  // namespace lightcal::fit
