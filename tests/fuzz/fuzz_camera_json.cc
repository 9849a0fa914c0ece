// SPDX-License-Identifier: Apache-2.0
// A camera.json that is taken can be written, and the writing is a fixed point; sensitivities come
// through the same door.
#include "lightcal/records/camera_profile.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  const auto file = lightcal::CameraFileFromJson(lightcal::fuzz::TextOf(data, size), "camera.json");
  if (!file) {
    lightcal::fuzz::RequireGoodError(file.error());
    return 0;
  }
  Require(file->profile.has_value() || file->sensitivities.has_value());
  if (!file->profile) return 0;
  const auto text = lightcal::CameraProfileToJson(*file->profile);
  Require(text.has_value());
  const auto again = lightcal::CameraProfileFromJson(*text, "camera.json");
  Require(again.has_value());
  Require(lightcal::CameraProfileToJson(*again).value_or("") == *text);
  return 0;
}
