// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/environments.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "lightcal/core/matrix3.h"

namespace lightcal {
namespace {

// Where R, G and B (or Y alone, three times) lie in the samples.
Result<std::array<int, 3>> ChannelsOf(const FrameInfo& info, const std::string& file) {
  const auto place = [&](const char* name) {
    const auto at = std::ranges::find(info.channel_names, name);
    return at == info.channel_names.end() ? -1 : static_cast<int>(at - info.channel_names.begin());
  };
  const std::array<int, 3> rgb = {place("R"), place("G"), place("B")};
  if (rgb[0] >= 0 && rgb[1] >= 0 && rgb[2] >= 0) return rgb;
  if (const int y = place("Y"); y >= 0) return std::array<int, 3>{y, y, y};
  if (info.channel_names.empty() && info.channels >= 3) return std::array<int, 3>{0, 1, 2};
  if (info.channels == 1) return std::array<int, 3>{0, 0, 0};
  return Refused("bad_environment", file, "has neither R, G and B nor Y");
}

Result<std::shared_ptr<const EnvironmentPicture>> PictureOf(const EnvironmentFile& named,
                                                            const std::string& path,
                                                            const Sources& sources) {
  if (named.projection != "latlong") {
    return Refused("bad_environment", path,
                   "environment.projection is \"" + named.projection + "\"; latlong is known");
  }
  const auto frame = sources.read_frame(path);
  if (!frame) return tl::unexpected(frame.error());
  const auto* samples = std::get_if<View2d<const float>>(&frame->samples);
  if (samples == nullptr || frame->info.meaning != SampleMeaning::kLinear) {
    return Refused("bad_environment", path, "is no linear picture (EXR, HDR)");
  }
  if (samples->width() != 2 * samples->height()) {
    return Refused("bad_environment", path,
                   "is not twice as wide as high: no whole lat-long picture");
  }
  const auto channels = ChannelsOf(frame->info, path);
  if (!channels) return tl::unexpected(channels.error());
  const bool grey = (*channels)[0] == (*channels)[1];
  const Matrix3 xyz =
      XyzFromRgbMatrix(frame->info.chromaticities.value_or(PrimariesOf(RgbSpace::kSrgb)));
  const Matrix3 back = RgbFromXyzMatrix(RgbSpace::kSrgb);
  auto picture = std::make_shared<EnvironmentPicture>();
  picture->width = samples->width();
  picture->height = samples->height();
  picture->rgb.reserve(3 * static_cast<std::size_t>(picture->width) *
                       static_cast<std::size_t>(picture->height));
  const double scale = named.nits_per_unit / frame->info.radiance_exposure;
  for (int y = 0; y < picture->height; ++y) {
    for (int x = 0; x < picture->width; ++x) {
      Column3 rgb{};
      for (std::size_t c = 0; c < 3; ++c) {
        rgb[c] = scale * double{(*samples)(x, y, (*channels)[c])};
      }
      if (!grey) rgb = Times(back, Times(xyz, rgb));
      for (const double v : rgb) picture->rgb.push_back(static_cast<float>(v));
    }
  }
  picture->Reduce();
  return std::shared_ptr<const EnvironmentPicture>(std::move(picture));
}

}  // namespace

Result<std::shared_ptr<const EnvironmentPicture>> LoadEnvironment(const FittedLight& light,
                                                                  const std::string& folder,
                                                                  const Sources& sources) {
  if (!light.environment) return std::shared_ptr<const EnvironmentPicture>();
  const auto path = std::filesystem::path(folder) / light.environment->file;
  return PictureOf(*light.environment, path.string(), sources);
}

Result<std::vector<std::shared_ptr<const EnvironmentPicture>>> LoadEnvironments(
    const LightFile& lights, const std::string& folder, const Sources& sources) {
  std::vector<std::shared_ptr<const EnvironmentPicture>> pictures;
  for (const FittedLight& light : lights.lights) {
    auto picture = LoadEnvironment(light, folder, sources);
    if (!picture) return Propagate(std::move(picture));
    pictures.push_back(*std::move(picture));
  }
  return pictures;
}

}  // namespace lightcal
