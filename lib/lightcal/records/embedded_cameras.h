// SPDX-License-Identifier: Apache-2.0
// The texts of sample_data/camera_sensitivities, written into the library by embed_cameras.cmake.
#pragma once

#include <span>
#include <string_view>

namespace lightcal::records {

struct EmbeddedCamera {
  std::string_view name, text;
};
[[nodiscard]] std::span<const EmbeddedCamera> EmbeddedCameras();

}  // namespace lightcal::records
