// SPDX-License-Identifier: Apache-2.0
// The pictures of a wall capture: the lit wall, and where the camera stood that took it.
#pragma once

#include "lightcal/calibrate/captures/wall_pictures.h"
#include "lightcal/calibrate/evidence.h"
#include "lightcal/core/result.h"
#include "lightcal/imaging/scene/board_camera.h"
#include "lightcal/records/session.h"
#include "lightcal/records/sources.h"

namespace lightcal {

struct PosedWall {
  WallPicture picture;
  SolvedCamera camera;  // of `picture`'s pixels
};

// Its camera by the board in the frames, else in wall.board_frame, and by wall.board_views, of which
// one where no board is found is left out and named. Refused: mixed_size, and as ReadWallPicture,
// Sources::find_board, SolveCamera.
[[nodiscard]] Result<PosedWall> ReadPosedWall(const Session& session,
                                              const CaptureDescription& capture,
                                              const Sources& sources, Evidence& evidence);

}  // namespace lightcal
