// SPDX-License-Identifier: Apache-2.0
// A representative part of a bracket's signals in memory, and how two frames of it compare.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "lightcal/imaging/bracket/signal.h"
#include "lightcal/records/frame.h"

namespace lightcal {

// Share of the clip from which a sample compares with nothing: sensors clip with some noise.
inline constexpr float kClippedFrom = 0.98F;

struct SampledSignals {
  std::vector<std::vector<float>> frames;  // the same samples of every frame
  std::vector<float> clip;                 // of each sample
  std::size_t row_samples = 0;             // of the whole rows that they are; 0: places unknown
};

// The clips that levels of two frames are shares of: those of the samples, and where no clip is
// known (scene-linear files), 1.5 times what all but a thousandth of both frames' samples stay
// below.
struct PairClips {
  std::vector<float> clip;
  bool known = true;  // of all samples
};
[[nodiscard]] PairClips ClipsOfPair(const SampledSignals& signals, std::size_t a, std::size_t b);

// Whole rows, spread evenly; about `samples` a frame.
[[nodiscard]] SampledSignals SampleRows(std::span<const SignalFrame> frames, std::size_t samples,
                                        const FrameDone& done = {});

// Levels are signals of the longer frame as shares of the clip, in bins of equal width of the root
// (in which shot noise has one width): bin = floor(kLevelBins sqrt(level)).
inline constexpr int kLevelBins = 64;
[[nodiscard]] constexpr double BinLowerLevel(int bin) {
  return static_cast<double>(bin) * bin / (double{kLevelBins} * kLevelBins);
}

// Sums over the samples of one level, of residuals d = b - r a.
struct LevelSums {
  double count = 0.0;
  double a = 0.0, b = 0.0;
  double d = 0.0, d2 = 0.0;
};
using PairSums = std::array<LevelSums, kLevelBins>;

// Two frames compared at the exposure ratio r = b/a. A sample's level is the estimate of its signal
// from both frames, weighted so that the residual does not depend on it: choosing samples by level
// then leaves ratio and variance unbiased. Residuals beyond gate[bin] (0 = no gate) are left out:
// people walk through pictures.
struct PairSetting {
  double ratio = 1.0;
  NoiseProfile noise{1.0, 0.0};  // relative weights only
  std::array<double, kLevelBins> gate{};
};
[[nodiscard]] PairSums ComparePair(std::span<const float> a, std::span<const float> b,
                                   std::span<const float> clip, const PairSetting& setting);

// Gates of four standard deviations of each bin's residuals; the first ones from the median of
// |d|, which a moving crowd does not reach.
// A level of fewer than `least` samples tells no gate.
[[nodiscard]] std::array<double, kLevelBins> GatesOf(const PairSums& sums, double least = 2.0);
[[nodiscard]] std::array<double, kLevelBins> FirstGates(std::span<const float> a,
                                                        std::span<const float> b,
                                                        std::span<const float> clip,
                                                        const PairSetting& setting,
                                                        double least = 1.0);

}  // namespace lightcal
