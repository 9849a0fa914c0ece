// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/sensor_to_xyz.h"

#include <Eigen/Dense>
#include <cmath>

#include "lightcal/colorimetry/camera_neutral.h"
#include "lightcal/colorimetry/cct.h"

namespace lightcal {
namespace {

constexpr Kelvin kDaylight{6502.71};
// Radiance's RGB: equal-energy white, luminance .265 R + .670 G + .065 B.
// Source: Ward, Radiance color.h (STDPRIMARIES).
constexpr RgbPrimaries kRadiance = {
    {0.640, 0.330}, {0.290, 0.600}, {0.150, 0.060}, {1.0 / 3.0, 1.0 / 3.0}};

Eigen::Matrix3d ToEigen(const Matrix3& m) {
  Eigen::Matrix3d out;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      out(i, j) = m[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
  }
  return out;
}

PictureColor GreenOnly(const FrameInfo& info, bool warn) {
  PictureColor color;
  color.xyz_from_rgb = {{{0.0, 1.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 1.0, 0.0}}};
  color.has_colour = false;
  if (warn) {
    color.warnings.push_back(
        {"no_colour_matrix", info.file,
         "the file says nothing about its camera's colours; luminance is that of the green "
         "pixels, right for neutral surfaces only (a white LED reads up to 30 % low)"});
  }
  return color;
}

// The temperature whose matrix to take: that of the neutral's light, else daylight.
Kelvin TemperatureOf(const CameraMatrices& matrices, const std::array<double, 3>& neutral) {
  const auto xy = XyFromCameraNeutral(matrices, neutral);
  if (!xy) return kDaylight;
  const CctResult cct = CctFromXy(*xy);
  return cct.valid() ? cct.temperature : kDaylight;
}

Result<PictureColor> CameraColor(const FrameInfo& info) {
  const CameraMatrices& matrices = *info.matrices;
  const bool balanced = info.as_shot_neutral.has_value();
  const Kelvin temperature = balanced ? TemperatureOf(matrices, *info.as_shot_neutral) : kDaylight;
  const Eigen::Matrix3d camera_from_xyz = ToEigen(CameraMatrixAt(matrices, temperature));
  if (!(std::abs(camera_from_xyz.determinant()) > 1e-9)) {
    return Refused("no_colour", info.file, "its colour matrix cannot be inverted");
  }
  const Eigen::Matrix3d inverse = camera_from_xyz.inverse();
  Eigen::Vector3d neutral = camera_from_xyz * Eigen::Vector3d(0.95047, 1.0, 1.08883);
  if (balanced) {
    const auto& n = *info.as_shot_neutral;
    neutral = Eigen::Vector3d(n[0], n[1], n[2]);
  }
  const double luminance = (inverse * neutral)(1);
  if (!(luminance > 0.0) || !(neutral(1) > 0.0)) {
    return Refused("no_colour", info.file, "its matrix gives its own neutral no luminance");
  }
  const Eigen::Matrix3d scaled = inverse * (neutral(1) / luminance);
  PictureColor color;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      color.xyz_from_rgb[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = scaled(i, j);
    }
  }
  return color;
}

}  // namespace

Result<PictureColor> ColorOfPicture(const FrameInfo& info) {
  const bool mosaic = info.meaning == SampleMeaning::kMosaic;
  if (info.channels == 1 && !mosaic) {
    PictureColor color = GreenOnly(info, false);
    color.xyz_from_rgb = {{{1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}};
    return color;
  }
  if (!mosaic && info.channels != 3) {
    return Refused("no_colour", info.file,
                   "has " + std::to_string(info.channels) + " channels; 1 or 3 are understood");
  }
  if (mosaic || info.meaning == SampleMeaning::kSensor) {
    return info.matrices ? CameraColor(info) : GreenOnly(info, true);
  }
  PictureColor color;
  color.xyz_from_rgb = XyzFromRgbMatrix(RgbSpace::kSrgb);
  if (info.chromaticities) {
    color.xyz_from_rgb = XyzFromRgbMatrix(*info.chromaticities);
  } else if (info.format == "hdr") {
    color.xyz_from_rgb = XyzFromRgbMatrix(kRadiance);
  } else if (info.meaning == SampleMeaning::kLinear) {
    color.warnings.push_back(
        {"primaries_assumed", info.file, "the file names no chromaticities; Rec. 709 is assumed"});
  }
  return color;
}

}  // namespace lightcal
