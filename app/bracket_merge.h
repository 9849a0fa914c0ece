// SPDX-License-Identifier: Apache-2.0
// A bracket -> a picture in cd/m^2 with its sigma.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/imaging/plan_merge.h"
#include "lightcal_devices/captures/bracket.h"

namespace lightcal::app {

// What a luminance meter read of a part of the picture.
struct SpotReading {
  int x = 0, y = 0, width = 0, height = 0;
  Nits luminance;
  double sigma_relative = 0.05;
};

// A demosaiced pixel shares its noise with its neighbours: the mean of many is this much less sure
// than the mean of as many independent ones (they count as a quarter).
inline constexpr double kInterpolatedNoise = 2.0;

struct BracketMergeRequest {
  std::optional<SpotReading> anchor;
  std::optional<NoiseProfile> noise;
  std::optional<RgbSpace> space;  // absent: luminance alone
  std::optional<Xy> white;        // what becomes the space's white
  bool want_sigma = false;
};

struct MergedFrame {
  FrameInfo info;
  std::optional<double> ratio_ev;  // measured exposure relative to the shortest frame
  bool used = false;
};

struct MergedBracket {
  std::vector<MergedFrame> frames;
  int width = 0, height = 0, channels = 1;
  std::vector<float> picture;  // cd/m^2: Y, or RGB whose (1,1,1) is 1 cd/m^2
  std::vector<float> sigma;    // of the luminance, 1 standard deviation, cd/m^2
  double nits_per_unit = 0.0;  // luminance of full scale in the shortest frame
  std::string scale_source;    // "iso_prior" "anchor"
  double scale_u95_relative = 0.0;
  double clipped_fraction = 0.0;  // of the samples, in every frame
  MergePlan plan;
  NoiseSource noise_source = NoiseSource::kEstimated;
  Warnings warnings;
};

// Refused: no_exposure_metadata (a frame without exposure time; ISO or f-number unknown and no
// anchor), bad_anchor (outside the picture, clipped or black there), no_colour (a space asked of a
// picture without), and as LoadFrame, RecoverResponse, PlanMerge, MergePicture.
[[nodiscard]] Result<MergedBracket> MergeBracket(const Bracket& bracket,
                                                 const BracketMergeRequest& request);

}  // namespace lightcal::app
