// SPDX-License-Identifier: Apache-2.0
// A session folder with the frames of a synthetic camera, and `lightcal camera` driven on it. Full
// scale of green in daylight is k N^2/(t S), k = 78/(0.65 sensitivity).
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "merge_brackets.h"
#include "run_cli_json.h"

namespace lightcal::test {

class CameraFolder : public testing::Test {
 protected:
  static constexpr double kSensitivity = 0.85;
  static constexpr double kTrueConstant = 78.0 / 0.65 / kSensitivity;

  CameraFolder() : camera_(merge::Camera(180, 120)) { camera_.sensitivity = kSensitivity; }

  // Frames as <stem>_<i>.dng; returns the wildcard that names them.
  std::string Shoot(const std::string& stem, const std::vector<SyntheticExposure>& series,
                    const SyntheticScene& scene, const SyntheticDngOptions& options = {}) {
    files_ = WriteDngBracket(folder_.path(), stem, camera_, series, scene, options);
    return stem + "_*.dng";
  }
  // Shutters that do what the third stops of their labels say, 2 EV apart.
  static std::vector<SyntheticExposure> Steady(int frames = 4, double f_number = 8.0,
                                               std::uint64_t seed = 3,
                                               double shortest_s = 1.0 / 1024) {
    return ExposureSeries(shortest_s, frames, 2.0, f_number, 0.0, seed);
  }
  static std::string Frames(const std::string& use, const std::string& frames,
                            const std::string& more = "") {
    return "[[camera_frames]]\nuse = \"" + use + "\"\nframes = \"" + frames + "\"\n" + more;
  }
  std::string Session(const std::string& frames) {
    return folder_.Write("session.toml", "lightcal = 1\nname = \"camera\"\n" + frames);
  }
  [[nodiscard]] std::string ProfilePath() const { return folder_.path() + "/camera.json"; }
  nlohmann::json Profile(const std::string& frames) {
    return LightcalJson("camera",
                        {Session(frames), "--allow-outside", "-o", ProfilePath(), "--force"});
  }
  void ExpectRefused(const std::string& frames, const std::string& code) {
    std::filesystem::remove(ProfilePath());
    ExpectRefusal({"camera", Session(frames), "--allow-outside", "-o", ProfilePath()}, code);
    EXPECT_FALSE(std::filesystem::exists(ProfilePath()));
  }
  static void ExpectRefusal(merge::Words words, const std::string& code) {
    words.emplace_back("--json");
    const CliResult result = RunLightcal(words);
    EXPECT_EQ(result.exit_code, 3) << code << result.err;
    const auto answer = nlohmann::json::parse(result.out, nullptr, false);
    ASSERT_TRUE(answer.contains("error")) << result.out;
    EXPECT_EQ(answer["error"]["code"], code) << answer.dump();
  }
  // The frames shot last, merged by the profile.
  nlohmann::json MergeLast(merge::Words more = {}) {
    merge::Words words = {"--camera", ProfilePath(), "--force"};
    words.insert(words.end(), more.begin(), more.end());
    return merge::MergeJson(files_, Out(), words);
  }
  void ExpectMergeRefused(const merge::Words& more, const std::string& code) {
    merge::Words words = merge::MergeWords(files_, Out(), {"--force"});
    words.insert(words.end(), more.begin(), more.end());
    ExpectRefusal(words, code);
  }
  [[nodiscard]] std::string Out() const { return folder_.path() + "/lum.exr"; }

  TempDir folder_;
  SyntheticCamera camera_;
  merge::Words files_;
};

}  // namespace lightcal::test
