// SPDX-License-Identifier: Apache-2.0
// camera.json: what is known of one camera and its lens, beyond what its files say.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/matrix3.h"
#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/records/camera_sensitivities.h"
#include "lightcal/records/capture.h"
#include "lightcal/records/document.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/frame.h"

namespace lightcal {

// Raw signals, here and below: (sample - black)/(white - black), black and white as the file names
// them.

enum class ScaleReadingKind : std::uint8_t {
  kSpot,     // a luminance meter's reading of a part of the picture
  kCard,     // a lux meter's at a card of known reflectance
  kPicture,  // a lux meter's at the camera, against the integral of the whole picture
};
inline constexpr std::array<std::string_view, 3> kScaleReadingWords = {"spot", "card", "picture"};

// What one reading says of the constant k of CameraScale.
struct ScaleReading {
  ScaleReadingKind kind = ScaleReadingKind::kSpot;
  std::string frames;  // as the session names them
  double full_scale_constant = 0.0;
  double sigma_relative = 0.0;  // 1 sigma: meter, card, exposures, noise, lamp
  std::optional<double> f_number, iso;
  LampClass lamp_class = LampClass::kUnknown;  // whose light it was
};

//   L = k N^2/(t S) y,    y the luminance row of CameraColor times raw signals on the lens's axis
// k [cd s/m^2] by ISO 12232 is 78/0.65 = 120 where the raw signal 1 saturates.
struct CameraScale {
  double full_scale_constant = 120.0;
  double sigma_relative = 0.2;
  std::vector<ScaleReading> readings;  // none = the ISO speed's promise stands
};

enum class ColorMatrixSource : std::uint8_t { kDng, kSensitivities, kChart };
inline constexpr std::array<std::string_view, 3> kColorMatrixWords = {"dng", "sensitivities",
                                                                      "chart"};

// XYZ = M raw signals, one matrix for all lights, such that its neutral with green 1 has Y = 1.
struct CameraColor {
  ColorMatrixSource source = ColorMatrixSource::kDng;
  Matrix3 xyz_from_raw{};
  // Distances in CAM02-UCS between the chart and what the matrix makes of it.
  std::optional<double> delta_e_mean, delta_e_max;
};

// Var(signal) = scale signal + offset.
struct CameraNoise {
  double iso = 100.0;
  NoiseProfile noise;
};

// Light that the lens lets through, relative to its axis, by channel:
//   v(r) = 1 + a r^2 + b r^4 + c r^6,   r the distance from the centre / half the diagonal
struct CameraFlat {
  double f_number = 8.0;
  std::optional<Metres> focal_length;
  std::array<double, 2> center{0.0, 0.0};           // x right, y down, from the middle, as r
  std::array<std::array<double, 3>, 3> channels{};  // red, green, blue: a, b, c
  double sigma_relative = 0.0;                      // what is left of the flat's frames, 1 sigma
};

// What the sensor answers in the dark, beyond the black level its files name.
struct CameraDark {
  double iso = 100.0;
  Seconds exposure{1.0};
  std::array<double, 3> black{};  // raw signal of red, green, blue
  double sigma = 0.0;             // of these, raw signal
  std::vector<int> hot_pixels{};  // x, y, x, y, ...
};

struct CameraNdFilter {
  std::string name;
  std::array<double, 3> attenuation{1.0, 1.0, 1.0};  // signal without / with, red, green, blue
  double sigma_relative = 0.0;
};

struct CameraProfile {
  std::string camera;  // make and model as its files say, "" = unknown
  int width = 0, height = 0;
  CameraScale scale;
  std::optional<CameraColor> color;  // absent: green alone stands for luminance
  std::vector<CameraNoise> noise;    // one an ISO speed
  std::vector<CameraFlat> flats;     // one an aperture (and focal length)
  std::vector<CameraDark> darks;     // one an ISO speed and exposure time
  std::vector<CameraNdFilter> nd_filters;
  std::optional<CameraSensitivities> sensitivities;
  Provenance provenance;
};

inline constexpr std::string_view kCameraSchema = "lightcal.camera/1";

[[nodiscard]] records::Node DocumentOf(const CameraProfile& profile);
// Fails: not_finite. Refused: bad_camera, unknown_key, with file and key.
[[nodiscard]] Result<std::string> CameraProfileToJson(const CameraProfile& profile);
[[nodiscard]] Result<CameraProfile> CameraProfileFromJson(std::string_view text,
                                                          std::string_view where);

// Whatever a person gives as a camera's file: a profile, or sensitivities alone (a profile that
// holds nothing else). Told apart by the key "schema".
// Refused as the two readers.
struct CameraFile {
  std::optional<CameraProfile> profile;
  std::optional<CameraSensitivities> sensitivities;  // the profile's, or the file itself
};
[[nodiscard]] Result<CameraFile> CameraFileFromJson(std::string_view text, std::string_view where);

}  // namespace lightcal
