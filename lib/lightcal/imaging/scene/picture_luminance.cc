// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/scene/picture_luminance.h"

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "lightcal/imaging/camera/sensor_to_xyz.h"
#include "lightcal/photometry/luminous_efficacy.h"

namespace lightcal {
namespace {

constexpr double kRadianceEfficacy = 179.0;  // lm/W
constexpr std::array<double, 3> kRadianceWeights = {0.265, 0.670, 0.065};

Result<std::array<double, 3>> Weights(const FrameInfo& info, LuminanceConvention convention,
                                      Warnings& warnings) {
  auto color = ColorOfPicture(info);
  if (!color) return Propagate(std::move(color));
  const bool xyz = color->xyz_from_rgb[1] == std::array<double, 3>{0.0, 1.0, 0.0};
  if (convention == LuminanceConvention::kRadiance && info.channels == 3 && !xyz) {
    return kRadianceWeights;
  }
  warnings.insert(warnings.end(), color->warnings.begin(), color->warnings.end());
  return color->xyz_from_rgb[1];
}

double Scale(const FrameInfo& info, LuminanceConvention convention, PictureLuminance& luminance) {
  switch (convention) {
    case LuminanceConvention::kRadiometric:
      luminance.scale = "radiometric_683";
      return kEfficacyAt540THz.value();
    case LuminanceConvention::kRadiance:
      luminance.scale = "radiance_179";
      return kRadianceEfficacy;
    case LuminanceConvention::kPhotometric:
      break;
  }
  if (info.white_luminance) {
    luminance.scale = "white_luminance";
    return info.white_luminance->value();
  }
  luminance.scale = "assumed_nits";
  luminance.warnings.push_back(
      {"relative_scale", info.file,
       "the file does not say which luminance 1.0 is (no whiteLuminance); its numbers are taken as "
       "cd/m^2: calibrate it by a lux reading ({MakeDome} {dome.illuminance}), or name the "
       "convention"});
  return 1.0;
}

void Convert(std::span<const float> samples, int channels, const std::array<double, 3>& weights,
             std::span<float> nits) {
  const auto r = static_cast<float>(weights[0]), g = static_cast<float>(weights[1]),
             b = static_cast<float>(weights[2]);
  if (channels == 1) {
    for (std::size_t i = 0; i < nits.size(); ++i) nits[i] = r * samples[i];
    return;
  }
  for (std::size_t i = 0; i < nits.size(); ++i) {
    nits[i] = r * samples[3 * i] + g * samples[3 * i + 1] + b * samples[3 * i + 2];
  }
}

}  // namespace

Result<PictureLuminance> LuminanceOfPicture(const Frame& frame, LuminanceConvention convention) {
  const FrameInfo& info = frame.info;
  const auto* const samples = std::get_if<View2d<const float>>(&frame.samples);
  if (info.meaning != SampleMeaning::kLinear || samples == nullptr) {
    return Refused("not_linear", info.file,
                   "its samples are no luminance yet; merge its bracket first ({MergeBracket})");
  }
  PictureLuminance luminance;
  const double scale = Scale(info, convention, luminance) / info.radiance_exposure;
  luminance.nits_per_unit = scale;
  auto weights = Weights(info, convention, luminance.warnings);
  if (!weights) return Propagate(std::move(weights));
  luminance.width = samples->width();
  luminance.height = samples->height();
  for (double& w : *weights) w *= scale;
  luminance.nits.resize(static_cast<std::size_t>(luminance.width) * luminance.height);
  for (int y = 0; y < luminance.height; ++y) {
    const std::size_t first = static_cast<std::size_t>(y) * luminance.width;
    Convert(samples->row(y), samples->channels(), *weights,
            std::span(luminance.nits).subspan(first, luminance.width));
  }
  for (const float v : luminance.nits) {
    if (!std::isfinite(v)) {
      return Refused("over_range", info.file,
                     "its samples times its scale are beyond 3e38 cd/m^2; its header or the "
                     "convention is wrong");
    }
  }
  return luminance;
}

}  // namespace lightcal
