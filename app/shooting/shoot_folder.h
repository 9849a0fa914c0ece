// SPDX-License-Identifier: Apache-2.0
// The folder of one tethered bracket: its frames and their record.
#pragma once

#include <string>
#include <utility>

#include "lightcal/core/result.h"
#include "lightcal/records/tethered_shoot.h"
#include "lightcal_devices/captures/tether.h"

namespace lightcal::app {

class ShootFolder {
 public:
  // The first free "LIGHT-N" below `captures`; nothing is created yet.
  [[nodiscard]] static ShootFolder New(const std::string& captures, const std::string& light);
  // The last one below `captures` that was broken off, of this light ("" = any), with its record.
  // Fails: nothing_to_resume, and as TetheredShootFromJson.
  [[nodiscard]] static Result<std::pair<ShootFolder, TetheredShoot>> Unfinished(
      const std::string& captures, const std::string& light);

  [[nodiscard]] const std::string& path() const { return path_; }
  // Whether the frame's file is here.
  [[nodiscard]] bool Has(const ShotFrame& frame) const;
  [[nodiscard]] std::string PathOf(const std::string& file) const;

  // Replaces the record, whole.  Fails: unwritable.
  [[nodiscard]] Result<void> Save(const TetheredShoot& shoot) const;
  // Fetches a frame, whole or not at all, as frame_NN with the extension the camera gave it.
  // Returns the file's name.  Fails as TetheredCamera::Download.
  [[nodiscard]] Result<std::string> Fetch(devices::TetheredCamera& camera,
                                          const devices::StoredPicture& file, int number) const;

 private:
  explicit ShootFolder(std::string path) : path_(std::move(path)) {}
  std::string path_;
};

}  // namespace lightcal::app
