// SPDX-License-Identifier: Apache-2.0
// What a camera is set to for a bracket, out of what it offers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal_devices/captures/bracket_plan.h"
#include "lightcal_devices/captures/camera_settings.h"

namespace lightcal::app {

// Values nearer than this part of each other are one choice of a camera.
inline constexpr double kNearFNumber = 0.06, kNearIso = 0.12;

// As typed; empty = as the camera is set.
struct ExposureWish {
  std::string center;  // the middle shutter time
  std::string aperture;
  std::string iso;
};

struct CameraSetup {
  std::string shutter_setting;
  std::vector<NamedSetting> settings;   // of all frames, in the order to set them
  std::vector<NamedSetting> changes;    // those of them the camera is not at
  int pictures = 1;                     // files that one exposure makes
  std::optional<double> f_number, iso;  // what the frames should say
  devices::BracketPlan plan;
};

// RAW, on the card, ISO fixed, no dark frame subtracted, the bracket about its centre.
// Warns (in plan.warnings): not_raw, auto_iso, and as PlanBracket.   Fails: setting_refused (the
// shutter cannot be set over the cable).   Wrong usage: a wish the camera does not offer.
[[nodiscard]] Result<CameraSetup> SetupFor(const devices::CameraState& state,
                                           const devices::BracketRange& bracket,
                                           const ExposureWish& wish);

}  // namespace lightcal::app
