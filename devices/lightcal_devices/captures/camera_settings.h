// SPDX-License-Identifier: Apache-2.0
// What a bracket needs of a tethered camera's settings, and giving them back.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/tethered_shoot.h"
#include "lightcal_devices/captures/tether.h"

namespace lightcal::devices {

// The settings that matter, as this camera offers them; makers name them differently. Absent: it
// has none of that sort.
struct CameraState {
  std::optional<CameraSetting> shutter;  // with 1/60 before 0.0166s where both are there
  std::optional<CameraSetting> aperture;
  std::optional<CameraSetting> iso;
  std::optional<CameraSetting> format;  // one that can make RAW
  std::optional<CameraSetting> mode;    // exposure programme
  std::optional<CameraSetting> target;  // card or the camera's memory
  std::vector<CameraSetting> helpers;   // automatic ISO, noise reduction by a dark frame: off
};
[[nodiscard]] Result<CameraState> ReadCameraState(TetheredCamera& camera);

// The choice that means manual exposure, off, the card; absent: not offered.
[[nodiscard]] std::optional<std::string> ManualChoice(const CameraSetting& mode);
[[nodiscard]] std::optional<std::string> OffChoice(const CameraSetting& helper);
[[nodiscard]] std::optional<std::string> CardChoice(const CameraSetting& target);

// Sets a camera and remembers what it had before, also across runs: what an earlier run could not
// give back is handed in.
class BorrowedSettings {
 public:
  BorrowedSettings(TetheredCamera& camera, std::vector<NamedSetting> owed)
      : camera_(&camera), owed_(std::move(owed)) {}

  // Notes what is to be given back; what was noted first counts.
  void Remember(const CameraSetting& setting);
  // Fails as TetheredCamera::Set; a busy camera is asked again for two seconds.
  [[nodiscard]] Result<void> Set(const std::string& name, const std::string& choice);
  // Gives back what is not as it was, the last noted first. What could not be is left in owed().
  void GiveBack();
  // After the camera was opened anew.
  void Move(TetheredCamera& camera) { camera_ = &camera; }
  [[nodiscard]] const std::vector<NamedSetting>& owed() const { return owed_; }

 private:
  TetheredCamera* camera_;
  std::vector<NamedSetting> owed_;  // in the order they were noted
};

}  // namespace lightcal::devices
