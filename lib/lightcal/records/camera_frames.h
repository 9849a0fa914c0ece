// SPDX-License-Identifier: Apache-2.0
// The pictures that calibrate a camera: [[camera_frames]] and [camera] of session.toml.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/units.h"
#include "lightcal/records/capture.h"

namespace lightcal {

enum class CameraFramesUse : std::uint8_t {
  kScale,  // a bracket of something whose luminance or illuminance was read
  kNoise,  // a bracket, or equal frames, of anything
  kFlat,   // an evenly lit surface that fills the picture, at one aperture
  kDark,   // the cap on, at one ISO speed and exposure time
  kNd,     // one scene with and without a filter
  kChart,  // a colour chart
};
inline constexpr std::array<std::string_view, 6> kCameraFramesUseWords = {
    "scale", "noise", "flat", "dark", "nd", "chart"};
// Of a meter that has no [[meter]], 1 sigma.
inline constexpr double kSigmaSpotMeter = 0.05;

struct CameraFramesDescription {
  CameraFramesUse use = CameraFramesUse::kScale;
  std::string frames;                      // files or a wildcard, relative to the session
  std::string where;                       // "session.toml [[camera_frames]] 1"
  std::optional<std::array<int, 4>> rect;  // x, y, width, height: what was read, compared
  std::vector<double> exposure_s;          // override the files
  std::optional<double> f_number, iso;

  // scale: a luminance; or an illuminance with the card's reflectance; or an illuminance at the
  // camera with the picture's projection.
  std::optional<Nits> luminance;
  std::optional<Lux> illuminance;
  std::optional<double> reflectance;
  double reflectance_sigma = kSigmaReflectance;
  std::string projection;  // "" = none
  std::optional<double> field_of_view_deg;
  std::string meter;                        // the [[meter]], "" = unnamed
  double sigma_relative = kSigmaSpotMeter;  // of the meter
  LampClass lamp_class = LampClass::kUnknown;
  std::string spectrum_file;

  std::string name;     // nd: of the filter
  std::string without;  // nd: the frames without it
  std::string chart;    // chart: file of the patches
};

// [camera]
struct CameraDescription {
  std::string sensitivities;  // file, relative to the session; "" = none
};

}  // namespace lightcal
