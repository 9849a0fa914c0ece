// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/pair_ratios.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "lightcal/core/parallel.h"
#include "lightcal/core/statistics.h"
#include "lightcal/imaging/bracket/noise.h"

namespace lightcal {
namespace {

constexpr double kLeastSharedSamples = 64.0;
constexpr double kWorstPairSd = 0.02;  // of a pair's ln ratio; wider is no measurement
constexpr double kStraightTo = 0.5;    // every sensor is linear up to here
constexpr double kBlackSd = 3e-4;      // of full scale: of black levels, where a bend is sought
constexpr double kBendShare = 1e-3;    // departure that counts as a bend
constexpr double kBendSigmas = 4.0;
constexpr double kHighestLinear = 0.9;
constexpr int kPasses = 3;

// Where most numbers lie: the middle of the shortest interval that holds a quarter of them. Half of
// a picture that moved does not reach it, as it does the median.
float Densest(std::vector<float>& values) {
  constexpr std::size_t kEnough = 20'000;
  const std::size_t step = values.size() / kEnough + 1;
  std::vector<float> some;
  for (std::size_t i = 0; i < values.size(); i += step) some.push_back(values[i]);
  std::ranges::sort(some);
  const std::size_t quarter = some.size() / 4;
  std::size_t best = 0;
  for (std::size_t i = 0; i + quarter < some.size(); ++i) {
    // As a ratio: what is rare is spread over all of them.
    if (some[i + quarter] * some[best] < some[best + quarter] * some[i]) best = i;
  }
  return some[best + quarter / 2];
}

// Noise grows with the level, and less than in proportion. A level whose residuals break that law,
// beside levels that keep it, shows edges that moved: its gate is that of the others.
std::array<double, kLevelBins> WithinNoise(std::array<double, kLevelBins> gates) {
  constexpr double kSlack = 1.5;  // of one level's gate
  std::array<double, kLevelBins> lawful = gates;
  const auto take = [&](std::size_t bin, double limit) {
    if (std::isfinite(limit))
      lawful[bin] = lawful[bin] > 0.0 ? std::min(lawful[bin], limit) : limit;
  };
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const auto level = [](std::size_t bin) { return BinLowerLevel(static_cast<int>(bin) + 1); };
  double relative = kNone;
  for (std::size_t bin = 0; bin < gates.size(); ++bin) {
    if (gates[bin] > 0.0 && level(bin) <= kBelievedTo) {
      relative = std::min(relative, kSlack * gates[bin] / level(bin));
    }
    take(bin, relative * level(bin));
  }
  double absolute = kNone;
  for (std::size_t bin = gates.size(); bin-- > 0;) {
    if (gates[bin] > 0.0 && level(bin) <= kBelievedTo) {
      absolute = std::min(absolute, kSlack * gates[bin]);
    }
    take(bin, absolute);
  }
  return lawful;
}

// A first ratio that needs no label: what most of b/a is where both stand clear of noise and clip.
std::optional<double> RoughRatio(std::span<const float> a, std::span<const float> b,
                                 std::span<const float> clip) {
  for (const float floor : {0.03F, 0.01F, 0.003F, 0.001F}) {
    std::vector<float> ratios;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const bool clear = a[i] > floor * clip[i] && b[i] > floor * clip[i] &&
                         a[i] < 0.9F * clip[i] && b[i] < 0.9F * clip[i];
      if (clear) ratios.push_back(b[i] / a[i]);
    }
    if (static_cast<double>(ratios.size()) < kLeastSharedSamples) continue;
    return Densest(ratios);
  }
  return std::nullopt;
}

bool Tells(const LevelSums& total) {
  return total.count >= kLeastSharedSamples && total.a > 0.0 && total.b > 0.0 &&
         std::sqrt(total.d2) < kWorstPairSd * total.b;
}

}  // namespace

LevelSums SumLevels(const PairSums& sums, double from, double to) {
  LevelSums total;
  for (int bin = 0; bin < kLevelBins; ++bin) {
    if (BinLowerLevel(bin) < from || BinLowerLevel(bin + 1) > to) continue;
    const LevelSums& sum = sums[static_cast<std::size_t>(bin)];
    total.count += sum.count;
    total.a += sum.a;
    total.b += sum.b;
    total.d += sum.d;
    total.d2 += sum.d2;
  }
  return total;
}

std::optional<LevelSums> TellingLevels(const PairSums& sums, double to) {
  for (const double from : {0.05, 0.01, 0.002}) {
    const LevelSums total = SumLevels(sums, from, to);
    if (Tells(total)) return total;
  }
  return std::nullopt;
}

namespace {

std::optional<PairRatio> MeasurePair(const SampledSignals& signals, std::size_t a, std::size_t b) {
  const auto& first = signals.frames[a];
  const auto& second = signals.frames[b];
  const PairClips clips = ClipsOfPair(signals, a, b);
  const auto rough = RoughRatio(first, second, clips.clip);
  if (!rough) return std::nullopt;
  PairRatio pair{.a = a, .b = b, .clip_known = clips.known};
  PairSetting setting{.ratio = *rough, .noise = kMiddlingNoise};
  setting.gate = WithinNoise(FirstGates(first, second, clips.clip, setting, kLeastSharedSamples));
  for (int pass = 0; pass < kPasses; ++pass) {
    pair.sums = ComparePair(first, second, clips.clip, setting);
    const auto total = TellingLevels(pair.sums, kBelievedTo);
    if (!total) return std::nullopt;
    setting.ratio = total->b / total->a;
    setting.gate = WithinNoise(GatesOf(pair.sums, kLeastSharedSamples));
  }
  pair.regions = DisagreeingRegions(signals, a, b, clips.clip, setting.ratio);
  return pair;
}

// Mean residual of a level, offset + slope a, and its variance.
struct StraightLine {
  double offset = 0.0, slope = 0.0;
  double offset2 = 0.0, cross = 0.0, slope2 = 0.0;  // covariance
};

// Of the levels at which every sensor is linear. Black levels that are off leave the offset, and
// must not look like a bend.
std::optional<StraightLine> StraightLineOf(const PairSums& sums) {
  double one = 0.0, a = 0.0, aa = 0.0, d = 0.0, da = 0.0, exposures = 0.0;
  int levels = 0;
  for (int bin = 0; bin < kLevelBins; ++bin) {
    if (BinLowerLevel(bin + 1) > kStraightTo) break;
    const LevelSums& sum = sums[static_cast<std::size_t>(bin)];
    if (sum.count < kLeastSharedSamples || !(sum.d2 > 0.0) || !(sum.a > 0.0)) continue;
    const double weight = sum.count * sum.count / sum.d2;
    const double mean_a = sum.a / sum.count, mean_d = sum.d / sum.count;
    one += weight;
    a += weight * mean_a;
    aa += weight * mean_a * mean_a;
    d += weight * mean_d;
    da += weight * mean_a * mean_d;
    exposures = std::max(exposures, sum.b / sum.a);
    ++levels;
  }
  if (levels < 2) return std::nullopt;
  one += 1.0 / std::pow(kBlackSd * (1.0 + exposures), 2);
  const double determinant = one * aa - a * a;
  return StraightLine{(aa * d - a * da) / determinant, (one * da - a * d) / determinant,
                      aa / determinant, -a / determinant, one / determinant};
}

}  // namespace

double LinearTo(std::span<const PairRatio> pairs) {
  for (int bin = 0; bin < kLevelBins; ++bin) {
    if (BinLowerLevel(bin) < kStraightTo || BinLowerLevel(bin + 1) > kHighestLinear) continue;
    double behind = 0.0, of = 0.0, variance = 0.0;
    for (const PairRatio& pair : pairs) {
      if (!pair.clip_known) continue;
      const auto straight = StraightLineOf(pair.sums);
      const LevelSums& sum = pair.sums[static_cast<std::size_t>(bin)];
      if (!straight || sum.count < kLeastSharedSamples) continue;
      behind += sum.d - straight->offset * sum.count - straight->slope * sum.a;
      of += sum.b;
      variance += sum.d2 + sum.count * sum.count * straight->offset2 +
                  2.0 * sum.count * sum.a * straight->cross + sum.a * sum.a * straight->slope2;
    }
    if (std::abs(behind) > std::max(kBendShare * of, kBendSigmas * std::sqrt(variance))) {
      return BinLowerLevel(bin);
    }
  }
  return kHighestLinear;
}

std::vector<PairRatio> MeasurePairs(const SampledSignals& signals,
                                    std::span<const std::size_t> order) {
  std::vector<std::pair<std::size_t, std::size_t>> candidates;
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i + 1; j < std::min(i + 3, order.size()); ++j) {
      candidates.emplace_back(order[i], order[j]);
    }
  }
  std::vector<std::optional<PairRatio>> measured(candidates.size());
  ParallelFor(static_cast<int>(candidates.size()), [&](int i) {
    const auto [a, b] = candidates[static_cast<std::size_t>(i)];
    measured[static_cast<std::size_t>(i)] = MeasurePair(signals, a, b);
  });
  std::vector<PairRatio> pairs;
  for (const auto& pair : measured) {
    if (pair) pairs.push_back(*pair);
  }
  return pairs;
}

}  // namespace lightcal
