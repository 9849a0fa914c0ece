// SPDX-License-Identifier: Apache-2.0
// A bracket from a tethered camera into a session.
#pragma once

#include <optional>
#include <string>

#include "console.h"
#include "lightcal/core/result.h"
#include "lightcal/records/capture.h"
#include "lightcal/records/tethered_shoot.h"
#include "lightcal_devices/captures/bracket_plan.h"
#include "shooting/camera_setup.h"

namespace lightcal::app {

struct ShootRequest {
  std::string session, light, device;
  devices::BracketRange bracket;
  ExposureWish exposure;
  // What the session makes of the frames, all but `frames`; absent: the person says it later.
  std::optional<CaptureDescription> capture;
  bool delete_from_card = false;
  bool resume = false;   // go on with the one that was broken off; the rest above is not asked
  bool dry_run = false;  // plan only; the camera is read and nothing is set
};

struct ShootOutcome {
  std::string folder;  // relative to the session, "" of a dry run
  TetheredShoot shoot;
};

// Opens the camera, sets it, takes every frame, fetches it (temporary name, sync, rename) and
// checks what its tags say against what was asked; the folder's capture.json is written anew after
// each. However it ends (done, failed, Ctrl-C), the camera gets its settings back; where it could
// not, the record keeps them for --resume and the warning not_restored names them. Warns:
// exposure_conflict, no_exposure_time, not_raw, not_manual, not_deleted, not_restored, and as
// SetupFor.  Fails: as the camera; interrupted.  Refused: bad_capture, bad_picture, no_bracket.
[[nodiscard]] Result<ShootOutcome> ShootBracket(const ShootRequest& request, Console& console);

}  // namespace lightcal::app
