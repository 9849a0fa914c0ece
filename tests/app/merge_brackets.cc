// SPDX-License-Identifier: Apache-2.0
#include "merge_brackets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <variant>

#include "lightcal_devices/captures/picture.h"

namespace lightcal::test::merge {

using nlohmann::json;

SyntheticCamera Camera(int width, int height) { return FlawedCamera(width, height); }

std::string Shoot(const TempDir& folder, const std::string& stem, const SyntheticCamera& camera,
                  const SyntheticExposure& exposure, const SyntheticScene& scene,
                  const SyntheticDngOptions& options) {
  return WriteDngBracket(folder.path(), stem, camera, {exposure}, scene, options).at(0);
}

Words ShootAll(const TempDir& folder, const SyntheticCamera& camera,
               const std::vector<SyntheticExposure>& series, const SyntheticScene& scene,
               const SyntheticDngOptions& options) {
  Words files;
  for (const SyntheticExposure& exposure : series) {
    files.push_back(
        Shoot(folder, "f" + std::to_string(files.size()), camera, exposure, scene, options));
  }
  return files;
}

StepWedge Wedge(const SyntheticCamera& camera, double lowest_nits, double highest_nits) {
  return {LogSteps(lowest_nits, highest_nits, 8), 4, camera.width, camera.height};
}

std::vector<SyntheticExposure> Series(int frames, std::uint64_t seed) {
  return ExposureSeries(1.0 / 1024, frames, 2.0, 8.0, 0.03, seed);
}

double Picture::Mean(int x, int y, int w, int h, int channel) const {
  double sum = 0.0;
  for (int j = y; j < y + h; ++j) {
    for (int i = x; i < x + w; ++i) {
      sum += samples[static_cast<std::size_t>((j * width + i) * channels + channel)];
    }
  }
  return sum / w / h;
}

Picture ReadExr(const std::string& path) {
  const auto frame = devices::ReadPicture(path);
  EXPECT_TRUE(frame.has_value()) << path;
  Picture picture;
  if (!frame) return picture;
  const auto& view = std::get<View2d<const float>>(frame->samples);
  picture = {view.width(), view.height(), view.channels(), {}};
  for (int y = 0; y < view.height(); ++y) {
    picture.samples.insert(picture.samples.end(), view.row(y).begin(), view.row(y).end());
  }
  return picture;
}

Words MergeWords(Words files, const std::string& output, const Words& more) {
  files.insert(files.begin(), "merge");
  files.insert(files.end(), {"-o", output});
  files.insert(files.end(), more.begin(), more.end());
  return files;
}

json MergeJson(const Words& files, const std::string& output, Words more) {
  more.emplace_back("--json");
  const CliResult run = RunLightcal(MergeWords(files, output, more));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return json::parse(run.out);
}

void ExpectRefused(const Words& files, const std::string& output, const std::string& code,
                   Words more) {
  more.emplace_back("--json");
  const CliResult run = RunLightcal(MergeWords(files, output, more));
  EXPECT_EQ(run.exit_code, 3) << run.out << run.err;
  EXPECT_EQ(json::parse(run.out)["error"]["code"], code) << run.out;
  EXPECT_FALSE(std::filesystem::exists(output));
}

bool Warns(const json& document, const std::string& code) {
  const json warnings = document.value("warnings", json::array());
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const json& warning) { return warning["code"] == code; });
}

double PatchMean(const Picture& picture, const StepWedge& wedge, int patch) {
  const int w = wedge.width / wedge.columns;
  const int h = wedge.height / 2;
  return picture.Mean(patch % wedge.columns * w + 6, patch / wedge.columns * h + 6, w - 12, h - 12);
}

SyntheticScene Posts(double shift_pixels) {
  return [shift_pixels](int x, int y) {
    const double pattern =
        std::sin(0.13 * (x - shift_pixels)) * std::sin(0.11 * y + 0.02 * (x - shift_pixels));
    return XyzOf(3000.0 + 2500.0 * pattern);
  };
}

}  // namespace lightcal::test::merge
