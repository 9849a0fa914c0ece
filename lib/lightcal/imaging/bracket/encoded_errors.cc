// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/encoded_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/parallel.h"
#include "lightcal/core/statistics.h"
#include "lightcal/imaging/bracket/merge_bracket.h"

namespace lightcal {
namespace {

constexpr double kLeastOfLevel = 50.0;  // samples
constexpr double kLowestLevel = 0.01;   // below, codes are cut off at black
constexpr double kHighestLevel = 0.85;  // above, they fill up
constexpr float kOutlier = 4.0F;        // standard deviations; what moved
constexpr float kPriorSamples = 20.0F;  // of a cell: that scatter as their noise says
constexpr int kBandCells = 64;          // rows of cells in memory at once

// Every `channels`-th number from `channel` on.
std::vector<float> ChannelOf(std::span<const float> all, int channel, int channels) {
  std::vector<float> one;
  one.reserve(all.size() / static_cast<std::size_t>(channels) + 1);
  for (auto i = static_cast<std::size_t>(channel); i < all.size();
       i += static_cast<std::size_t>(channels)) {
    one.push_back(all[i]);
  }
  return one;
}

// What two frames' means of a level differ by, relative, and of how many samples.
struct LevelMisfit {
  double size = 0.0, count = 0.0;
};

void AddLevels(const PairSums& sums, double ratio, double floor,
               std::vector<LevelMisfit>& misfits) {
  for (int bin = 0; bin < kLevelBins; ++bin) {
    const LevelSums& level = sums[static_cast<std::size_t>(bin)];
    const bool middle =
        BinLowerLevel(bin) >= kLowestLevel && BinLowerLevel(bin + 1) <= kHighestLevel;
    if (!middle || level.count < kLeastOfLevel) continue;
    const double signal = ratio * (level.a + level.b) / (1.0 + ratio) / level.count;
    if (signal < floor * ratio) continue;  // the merge leaves the shorter frame out
    const double mean = level.d / level.count;
    const double variance = level.d2 / level.count - mean * mean;
    const double beyond = mean * mean - variance / level.count;
    misfits.push_back({std::sqrt(std::max(0.0, beyond)) / signal, level.count});
  }
}

// Half of all samples belong to levels that differ by less.
double MedianSize(std::vector<LevelMisfit> misfits) {
  std::ranges::sort(misfits, {}, &LevelMisfit::size);
  double all = 0.0, below = 0.0;
  for (const LevelMisfit& level : misfits) all += level.count;
  for (const LevelMisfit& level : misfits) {
    below += level.count;
    if (2.0 * below >= all) return level.size;
  }
  return 0.0;
}

}  // namespace

double CurveMisfit(const SampledSignals& signals, int channels, const MergePlan& plan) {
  const auto& exposure = plan.exposure;
  std::vector<LevelMisfit> misfits;
  for (std::size_t k = 1; k < signals.frames.size(); ++k) {
    const PairClips clips = ClipsOfPair(signals, k - 1, k);
    for (int c = 0; c < channels; ++c) {
      const auto shorter = ChannelOf(signals.frames[k - 1], c, channels);
      const auto longer = ChannelOf(signals.frames[k], c, channels);
      const auto clip = ChannelOf(clips.clip, c, channels);
      PairSetting setting{.ratio = exposure[k] / exposure[k - 1], .noise = plan.noise[k]};
      setting.gate = FirstGates(shorter, longer, clip, setting);
      AddLevels(ComparePair(shorter, longer, clip, setting), setting.ratio, plan.floor, misfits);
    }
  }
  // The difference of two frames holds the misfit of both.
  return kSdPerMad * MedianSize(std::move(misfits)) / std::sqrt(2.0);
}

double SharedNoise(const SampledSignals& signals, int channels, const MergePlan& plan) {
  if (channels < 3) return 0.0;
  double own = 0.0, common = 0.0;
  for (std::size_t k = 1; k < signals.frames.size(); ++k) {
    const auto& shorter = signals.frames[k - 1];
    const auto& longer = signals.frames[k];
    const NoiseProfile& noise = plan.noise[k];
    const auto r = static_cast<float>(plan.exposure[k] / plan.exposure[k - 1]);
    for (std::size_t i = 0; i + 2 < longer.size(); i += 3) {
      std::array<float, 3> u{};
      bool usable = true;
      for (std::size_t c = 0; c < 3; ++c) {
        const float a = shorter[i + c], b = longer[i + c];
        const float mean = std::max(0.0F, (a + b) / (1.0F + r));
        const double variance = noise.scale * mean * r * (1.0 + r) + noise.offset * (1.0 + r * r);
        const auto highest = static_cast<float>(kHighestLevel) * signals.clip[i + c];
        u[c] = (b - r * a) / static_cast<float>(std::sqrt(variance));
        const auto lowest = static_cast<float>(kLowestLevel) * signals.clip[i + c];
        usable = usable && mean >= static_cast<float>(plan.floor) && mean * r > lowest &&
                 b < highest && std::abs(u[c]) < kOutlier;
      }
      if (!usable) continue;
      own += double{u[0]} * u[0] + double{u[1]} * u[1] + double{u[2]} * u[2];
      common += double{u[0]} * u[1] + double{u[1]} * u[2] + double{u[2]} * u[0];
    }
  }
  return own > 0.0 ? std::clamp(common / own, 0.0, 1.0) : 0.0;
}

void ScatterOfPlaces::Row(int y, std::size_t first, int channels, std::span<float> out) const {
  const auto row =
      static_cast<std::size_t>(std::min(y / kCell, height - 1)) * static_cast<std::size_t>(width);
  const std::size_t samples = static_cast<std::size_t>(channels) * kCell;
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = factor[row + std::min((first + i) / samples, static_cast<std::size_t>(width) - 1)];
  }
}

namespace {

// Sums of chi-square and degrees of freedom of a row of cells -> their factors.
void FactorsOfRow(const BracketMerger& merger, int cell_row, ScatterOfPlaces& places) {
  const SignalFrame& frame = merger.frames()[0];
  const auto width = static_cast<std::size_t>(places.width);
  const std::size_t samples = static_cast<std::size_t>(frame.channels) * ScatterOfPlaces::kCell;
  std::vector<float> sum(width, kPriorSamples), degrees(width, kPriorSamples);
  std::vector<float> chi2(frame.row_samples()), free(frame.row_samples());
  const int first = cell_row * ScatterOfPlaces::kCell;
  const int end = std::min(first + ScatterOfPlaces::kCell, frame.height);
  for (int y = first; y < end; ++y) {
    merger.ScatterOfRow(y, chi2, free);
    for (std::size_t i = 0; i < chi2.size(); ++i) {
      if (free[i] < 1.0F) continue;
      sum[i / samples] += chi2[i];
      degrees[i / samples] += free[i];
    }
  }
  for (std::size_t x = 0; x < width; ++x) {
    places.factor[static_cast<std::size_t>(cell_row) * width + x] = sum[x] / degrees[x];
  }
}

ScatterOfPlaces MeasurePlaces(const BracketMerger& merger, const FrameDone& done) {
  const SignalFrame& frame = merger.frames()[0];
  constexpr int kCell = ScatterOfPlaces::kCell;
  ScatterOfPlaces places;
  places.width = (frame.width + kCell - 1) / kCell;
  places.height = (frame.height + kCell - 1) / kCell;
  places.factor.resize(static_cast<std::size_t>(places.width) *
                       static_cast<std::size_t>(places.height));
  for (int from = 0; from < places.height; from += kBandCells) {
    ParallelFor(std::min(kBandCells, places.height - from),
                [&](int i) { FactorsOfRow(merger, from + i, places); });
    for (std::size_t k = 0; done && k < merger.frames().size(); ++k) done(k);
  }
  return places;
}

}  // namespace

Toe ToeOf(const ResponseCurves& response, int channels, double longest_exposure) {
  // Source: frames of sRGB's curve, a power and two films, three and five of them, 1 to 3 EV apart
  // (seeds 0 to 2): curves are off by .1 ln(12 / code) below code 12, 1 sigma.
  constexpr std::size_t kHighestCode = 12, kLowestCode = 3;
  constexpr double kSdOverLnCode = 0.1;
  Toe toe;
  double slope = 0.0;
  for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
    const auto& curve = response.signal_of_code[c];
    if (curve.size() != 256) return {};
    toe.below[c] = double{curve[kHighestCode]} / longest_exposure;
    slope += std::log(double{curve[kHighestCode]} / curve[kLowestCode]) / channels;
  }
  toe.slope_sd = kSdOverLnCode * std::log(double{kHighestCode} / kLowestCode) / slope;
  return toe;
}

void CheckStatedCurve(EncodedErrors& errors, const std::string& file, Warnings& warnings) {
  if (errors.misfit > kMostMisfit) {
    warnings.push_back({"response_disagrees", file,
                        "under the stated response the frames differ by " +
                            PercentText(std::sqrt(2.0) * errors.misfit) +
                            " where they show the same light; it is another camera's or setting's: "
                            "leave it out, two frames and more tell their own"});
  }
  errors.misfit = std::max(errors.misfit, kLeastStatedMisfit);
}

EncodedErrors MeasureEncodedErrors(const BracketMerger& merger, const SampledSignals& signals,
                                   const FrameDone& done) {
  const int channels = merger.frames()[0].channels;
  const MergePlan& plan = merger.plan();
  return {CurveMisfit(signals, channels, plan),
          SharedNoise(signals, channels, plan),
          MeasurePlaces(merger, done),
          {}};
}

}  // namespace lightcal
