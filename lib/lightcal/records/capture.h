// SPDX-License-Identifier: Apache-2.0
// What a session says of its pictures: which frames, of what, and what to make of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/units.h"
#include "lightcal/records/accuracy_profile.h"
#include "lightcal/records/ball_capture.h"
#include "lightcal/records/projection.h"
#include "lightcal/records/wall_capture.h"

namespace lightcal {

// How a lamp makes its light: what decides how far a camera misreads its luminance.
enum class LampClass : std::uint8_t {
  kUnknown,
  kWhiteLed,    // a blue LED under phosphor
  kHighCriLed,  // the same, or a violet LED, with red enough: R9 of 70 and more
  kRgbLed,      // red, green and blue LEDs
  kTungsten,    // anything that glows: flames and mantles too
  kDaylight,
};
inline constexpr std::array<std::string_view, 6> kLampClassWords = {
    "unknown", "white_led", "high_cri_led", "rgb_led", "tungsten", "daylight"};

// What the pictures are used for.
enum class CaptureUse : std::uint8_t { kCard, kSource, kWall, kDome, kBall };
inline constexpr std::array<std::string_view, 5> kCaptureUseWords = {"card", "source", "wall",
                                                                     "dome", "ball"};

// Cards and their printed reflectance agree within about this, 1 sigma.
inline constexpr double kSigmaReflectance = 0.03;

// What opening a capture's pictures told of them.
struct PictureFacts {
  bool flat_field = false;                // the lens's own map was divided out
  std::optional<double> exposure_s;       // of the longest frame that shows it unclipped
  std::optional<double> mean_over_patch;  // the picture's mean luminance over the patch's
  std::optional<double> off_middle_rad;   // of what was read, from the lens's axis
};

// card: a matt card of known reflectance that faces the lamp (or is tilted from it), photographed
// in its light: E = pi L / reflectance.
// source: the lamp itself, seen from distance_m.  dome: one panorama or fisheye picture of what
// surrounds the scene.  ball: a mirror ball whose highlight shows where the lamp is.
struct CaptureDescription {
  CaptureUse use = CaptureUse::kCard;
  std::string light;   // name of the [[light]]
  std::string frames;  // files or a wildcard, relative to the session
  std::string camera;  // its profile or spectral sensitivities, relative to the session; "" = none
  std::string response;  // of codes: a word (kResponseWords) or a table's file; "" = recovered
  std::string nd;        // the profile's filter that the frames were taken through; "" = none
  double reflectance = 0.0;
  double reflectance_sigma = kSigmaReflectance;  // relative
  std::optional<Metres> distance;  // from the lamp's reference point to the card (source: to the
                                   // camera; ball: to its middle)
  Radians tilt{0.0};               // between the card's normal and the lamp
  std::optional<std::array<int, 4>> rect;  // x, y, width, height of the card in the picture
  std::vector<double> exposure_s;          // one a frame; empty = from the files
  std::optional<double> f_number, iso;     // override the files
  std::optional<Lux> anchor_illuminance;   // a lux meter's reading at the card
  std::string meter;                       // the [[meter]] that read it
  LampClass lamp_class = LampClass::kUnknown;
  std::string spectrum_file;             // of the lamp, relative to the session; "" = unknown
  std::optional<WallDescription> wall;   // [capture.wall]
  std::optional<BallDescription> ball;   // [capture.ball]
  std::optional<Projection> projection;  // source, dome, ball; absent: rect, of a dome latlong
  std::optional<Radians> field_of_view;  // full angle across the width, or a fisheye's circle
  std::optional<double> rows_s;          // from the first to the last row averaged; 0 = global
                                         // shutter
  std::optional<double> lens_glare;      // part of the picture's mean on every pixel
  PictureFacts found{};                  // by whoever opened its pictures; no key
  PictureChoice work{};                  // how much of its pictures to use; a profile's, no key
  std::string where;                     // "session.toml [[capture]] 1"
};

}  // namespace lightcal
