// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/camera/sensor_to_xyz.h"

#include <string>
#include <vector>

#include "lightcal/imaging/camera/spectral_mismatch.h"

namespace lightcal {
namespace {

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

Result<PictureColor> ColorOfCamera(const FrameInfo& info) {
  auto xyz_from_raw = DaylightXyzFromRaw(*info.matrices);
  if (!xyz_from_raw) {
    return Refused("no_colour", info.file, xyz_from_raw.error().message);
  }
  PictureColor color;
  color.xyz_from_rgb = *xyz_from_raw;
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
    return info.matrices ? ColorOfCamera(info) : GreenOnly(info, true);
  }
  PictureColor color;
  if (info.channel_names == std::vector<std::string>{"X", "Y", "Z"}) {
    color.xyz_from_rgb = {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    return color;
  }
  color.xyz_from_rgb = XyzFromRgbMatrix(info.chromaticities.value_or(PrimariesOf(RgbSpace::kSrgb)));
  // OpenEXR says what its absence means (Rec. 709); other formats do not.
  const bool assumed = info.meaning == SampleMeaning::kLinear && info.format != "exr";
  if (assumed && !info.chromaticities) {
    color.warnings.push_back(
        {"primaries_assumed", info.file,
         "the file names no primaries; those of Rec. 709 are assumed, as most programs mean" +
             std::string(info.format == "hdr" ? " (Radiance's own differ by up to a quarter in "
                                                "the luminance of red)"
                                              : "")});
  }
  return color;
}

}  // namespace lightcal
