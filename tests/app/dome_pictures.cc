// SPDX-License-Identifier: Apache-2.0
#include "dome_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <variant>

#include "lightcal_devices/captures/picture.h"

namespace lightcal::test::dome {

using nlohmann::json;
using std::numbers::pi;

std::string WritePicture(const TempDir& folder, const std::string& name, const SkyPicture& picture,
                         double nits_per_unit, bool absolute) {
  std::vector<float> samples = picture.rgb;
  for (float& v : samples) v /= static_cast<float>(nits_per_unit);
  devices::ExrPicture exr;
  exr.samples = View2d<const float>(samples.data(), picture.width, picture.height, 3);
  exr.channel_names = {"R", "G", "B"};
  if (absolute) exr.white_luminance = Nits(nits_per_unit);
  exr.compressed = false;
  std::string path = folder.path() + "/" + name;
  EXPECT_TRUE(devices::WriteExr(path, exr));
  return path;
}

SkyPicture ReadPictureFile(const std::string& path) {
  const auto frame = devices::ReadPicture(path);
  EXPECT_TRUE(frame.has_value()) << path;
  SkyPicture picture;
  if (!frame) return picture;
  const auto& view = std::get<View2d<const float>>(frame->samples);
  picture.width = view.width();
  picture.height = view.height();
  const double unit = frame->info.white_luminance ? frame->info.white_luminance->value() : 1.0;
  for (int y = 0; y < view.height(); ++y) {
    for (const float v : view.row(y)) picture.rgb.push_back(v * static_cast<float>(unit));
  }
  return picture;
}

CliResult Dome(const std::string& picture, const std::string& output, const Words& more) {
  Words words = {"dome", picture, "-o", output};
  words.insert(words.end(), more.begin(), more.end());
  return RunLightcal(words);
}

json DomeJson(const std::string& picture, const std::string& output, Words more) {
  more.emplace_back("--json");
  const CliResult run = Dome(picture, output, more);
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  return json::parse(run.out);
}

void ExpectRefused(const std::string& picture, const std::string& output, const std::string& code,
                   Words more) {
  more.emplace_back("--json");
  const CliResult run = Dome(picture, output, more);
  EXPECT_EQ(run.exit_code, 3) << run.out << run.err;
  EXPECT_EQ(json::parse(run.out)["error"]["code"], code) << run.out;
  EXPECT_FALSE(std::filesystem::exists(output));
}

bool Warns(const json& document, const std::string& code) {
  const json warnings = document.value("warnings", json::array());
  return std::ranges::any_of(warnings, [&](const json& w) { return w["code"] == code; });
}

double LuxOfPicture(const SkyPicture& picture, const Ray& normal, double nits_per_unit) {
  const SkyView view = LatLongView(picture.width, picture.height);
  double lux = 0.0;
  for (int y = 0; y < picture.height; ++y) {
    const double omega =
        2.0 * pi / picture.width *
        (std::cos(pi * y / picture.height) - std::cos(pi * (y + 1) / picture.height));
    for (int x = 0; x < picture.width; ++x) {
      const Ray ray = view(x + 0.5, y + 0.5).ray;
      const double cosine = ray[0] * normal[0] + ray[1] * normal[1] + ray[2] * normal[2];
      if (cosine <= 0.0) continue;
      const float* p = &picture.rgb[3 * (static_cast<std::size_t>(y) * picture.width + x)];
      lux += nits_per_unit * Luminance({p[0], p[1], p[2]}) * cosine * omega;
    }
  }
  return lux;
}

double LuxOfLights(const json& light_file, const Ray& normal) {
  double lux = 0.0;
  for (const json& light : light_file["lights"]) {
    if (light.at("kind") == "dome") continue;
    double cosine = 0.0;
    for (std::size_t c = 0; c < 3; ++c) cosine -= light.at("aim")[c].get<double>() * normal[c];
    lux += light.at("illuminance_lx").at("value").get<double>() * std::max(0.0, cosine);
  }
  return lux;
}

Found LightAt(const json& document, const Ray& direction) {
  Found found;
  for (const json& light : document["lights"]) {
    const Ray at = light["direction"].get<Ray>();
    const double off = AngleBetween(at, direction) * 180.0 / pi;
    if (off < found.off_deg) found = {light, off};
  }
  return found;
}

SkyScene ClearSky(const Ray& sun) {
  const auto nits = [sun](const Ray& ray) {
    if (ray[2] <= 0.0) return 1500.0;
    const double degrees = AngleBetween(ray, sun) * 180.0 / pi;
    return 4000.0 + 4000.0 * std::pow(1.0 - ray[2], 3) + 2e5 * std::exp(-degrees / 1.5) +
           1.5e4 * std::exp(-degrees / 8.0);
  };
  return {[nits](const Ray& ray) {
            const double v = nits(ray);
            return Rgb3{0.8 * v, v, 1.3 * v};
          },
          {}};
}

SkyLamp Sun(const Ray& direction) {
  Rgb3 tint = {1.05, 1.0, 0.85};
  const double y = Luminance(tint);
  for (double& v : tint) v /= y;
  return {direction, 0.2665, 9e4, tint, 0.6, false};
}

}  // namespace lightcal::test::dome
