// SPDX-License-Identifier: Apache-2.0
// Brackets of the synthetic camera as files, `lightcal merge` driven on them, and what came out.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "run_cli.h"
#include "synthetic_dng.h"

namespace lightcal::test::merge {

using Words = std::vector<std::string>;

// FlawedCamera of a size that merges quickly.
SyntheticCamera Camera(int width = 300, int height = 200);

// One frame as a file.
std::string Shoot(const TempDir& folder, const std::string& stem, const SyntheticCamera& camera,
                  const SyntheticExposure& exposure, const SyntheticScene& scene,
                  const SyntheticDngOptions& options = {});
Words ShootAll(const TempDir& folder, const SyntheticCamera& camera,
               const std::vector<SyntheticExposure>& series, const SyntheticScene& scene,
               const SyntheticDngOptions& options = {});

// Frames 2 EV apart from 1/1024 s at f/8, shutters off by 3 %.
std::vector<SyntheticExposure> Series(int frames = 4, std::uint64_t seed = 3);

// Something to look at: 8 patches in two rows.
StepWedge Wedge(const SyntheticCamera& camera, double lowest_nits = 1.0, double highest_nits = 1e4);
// A bright wall with dark posts, so that movement shows anywhere.
SyntheticScene Posts(double shift_pixels);

struct Picture {
  int width = 0, height = 0, channels = 0;
  std::vector<float> samples;
  [[nodiscard]] double Mean(int x, int y, int w, int h, int channel = 0) const;
};
Picture ReadExr(const std::string& path);
// Mean of the middle of a patch of the wedge.
double PatchMean(const Picture& picture, const StepWedge& wedge, int patch);

Words MergeWords(Words files, const std::string& output, const Words& more = {});
nlohmann::json MergeJson(const Words& files, const std::string& output, Words more = {});
// Exit 3 with this code, and no file.
void ExpectRefused(const Words& files, const std::string& output, const std::string& code,
                   Words more = {});
bool Warns(const nlohmann::json& document, const std::string& code);

}  // namespace lightcal::test::merge
