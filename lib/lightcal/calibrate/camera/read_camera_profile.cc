// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/camera/read_camera_profile.h"

#include <utility>

namespace lightcal {

Result<CameraProfile> ReadCameraProfile(const std::string& path, const Sources& sources) {
  const auto text = sources.read_text(path);
  if (!text) return tl::unexpected(text.error());
  auto file = CameraFileFromJson(*text, path);
  if (!file) return Propagate(std::move(file));
  if (!file->profile) {
    return Refused("no_profile", path,
                   "holds spectral sensitivities alone; name them in a session's [camera] and "
                   "make a profile of it with {CalibrateCamera}");
  }
  return std::move(*file->profile);
}

}  // namespace lightcal
