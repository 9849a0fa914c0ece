// SPDX-License-Identifier: Apache-2.0
// What a merge of codes (JPEG, PNG) is wrong by, beyond the noise of its samples.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/imaging/bracket/sampled.h"
#include "lightcal/imaging/bracket/signal.h"

namespace lightcal {

class BracketMerger;
struct MergePlan;

// How much more or less than their noise says frames scatter about their mean, place by place:
// compression smooths what is plain and wrongs what is not.
struct ScatterOfPlaces {
  static constexpr int kCell = 8;  // pixels each way; a JPEG's block
  int width = 0, height = 0;       // in cells
  std::vector<float> factor;       // of the variance

  // Of samples [first, first + out.size()) of row y, `channels` a pixel.
  void Row(int y, std::size_t first, int channels, std::span<float> out) const;
};

// The darkest codes: noise is cut off at black there, so the curve is carried on by its smoothness.
struct Toe {
  double slope_sd = 0.0;          // t: of ln(signal) over ln(signal); 0 of a curve that is stated
  std::array<double, 3> below{};  // X of its highest code in the longest frame, of each channel
};

// sigma^2 of a pixel's luminance Y = sum k_c X_c:
//   (1 - r) sum k_c^2 v_c + r (sum |k_c| v_c^.5)^2 + (m Y)^2 + (t ln(Y0 / Y) Y)^2 + (h D)^2
// v_c the variance of a channel (its noise times the place's factor, and the pixels' unequal
// sensitivity), D the standard deviation of Y in the 3 x 3 pixels around; Y0 the light of the toe's
// highest code in the longest frame, whose term is 0 above.
struct EncodedErrors {
  double misfit = 0.0;  // m: of curve and exposures, alike in all pixels of one level; relative
  double shared = 0.0;  // r: of the noise, alike in all channels; luminance is compressed as one
  ScatterOfPlaces places;
  Toe toe{};
};

// h: this share of what a picture shows from pixel to pixel is not as it was, and alike in every
// frame, so that no two of them tell it.
// Source: simulated JPEGs of quality 75 to 98 with colour whole and at half size
// (tests/bench/still_brackets, seeds 1000 to 1079): .3 to .35 where texture is 3 % and more. An
// interpolated mosaic and sharpening add to it.
inline constexpr double kHiddenDetail = 1.0 / 3.0;

// m, of each frame: what neighbouring frames' means of a level differ by beyond noise, in the
// middle of levels and channels (the darkest codes, and a channel bent by a style of colours, may
// be worse). With two frames a recovered curve takes all of it and 0 is left.
[[nodiscard]] double CurveMisfit(const SampledSignals& signals, int channels,
                                 const MergePlan& plan);

// r, from the residuals of neighbouring frames, 0 to 1; 0 of one channel.
[[nodiscard]] double SharedNoise(const SampledSignals& signals, int channels,
                                 const MergePlan& plan);

// A curve found from the frames is off by this at most, whatever they differ by; one that was
// stated instead by this at least, 1 sigma: what recovered ones are off by where others are known.
inline constexpr double kMostMisfit = 0.05, kLeastStatedMisfit = 0.02;

// Widens m to kLeastStatedMisfit. Warns: response_disagrees, where the frames contradict the curve
// by more than kMostMisfit.
void CheckStatedCurve(EncodedErrors& errors, const std::string& file, Warnings& warnings);

// Of 8 bit codes whose curve was recovered; of more bits the toe is too dark to be seen.
[[nodiscard]] Toe ToeOf(const ResponseCurves& response, int channels, double longest_exposure);

// All of it but the toe, of the frames and the plan that the merger has. `done` as in signal.h.
[[nodiscard]] EncodedErrors MeasureEncodedErrors(const BracketMerger& merger,
                                                 const SampledSignals& signals,
                                                 const FrameDone& done = {});

}  // namespace lightcal
