// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/exposure_ratios.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "lightcal/core/parallel.h"
#include "lightcal/core/statistics.h"
#include "lightcal/imaging/bracket/changed_parts.h"
#include "lightcal/imaging/bracket/compare_labels.h"
#include "lightcal/imaging/bracket/encoded_errors.h"
#include "lightcal/imaging/bracket/label_choices.h"
#include "lightcal/imaging/bracket/noise.h"
#include "lightcal/imaging/bracket/rough_ratio.h"

namespace lightcal {
namespace {

constexpr double kWorstPairSd = 0.02;   // of a pair's ln ratio; wider is no measurement
constexpr double kModelSd = 2e-4;       // what no residual shows: black levels, slow bends
constexpr double kLabelRatioSd = 0.06;  // of a label's ln ratio: third-stop rounding, 3 % shutter
constexpr double kBelievedTo = 0.8;     // of the clip, when ratios are summed
constexpr double kStraightTo = 0.5;     // every sensor is linear up to here
constexpr double kBendShare = 1e-3;     // departure that counts as a bend
constexpr double kBendSigmas = 4.0;
constexpr double kBlackSd = 2e-4;  // of a black level, of full scale: 3 codes of 14 bits
constexpr double kHighestLinear = 0.9;
constexpr int kPasses = 3;

struct PairRatio {
  std::size_t a = 0, b = 0;
  double ln_ratio = 0.0, sd = 0.0;
  double apart = 0.0;  // PairParts
  bool clip_known = true;
  PairSums sums{};
};

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

// sum b / sum a and its standard deviation over the levels between the two.
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

bool Tells(const LevelSums& total) {
  return total.count >= kLeastSharedSamples && total.a > 0.0 && total.b > 0.0 &&
         std::sqrt(total.d2) < kWorstPairSd * total.b;
}

// The brightest range that tells the ratio: there black levels matter least.
std::optional<LevelSums> TellingLevels(const PairSums& sums, double to) {
  for (const double from : {0.05, 0.01, 0.002}) {
    const LevelSums total = SumLevels(sums, from, to);
    if (Tells(total)) return total;
  }
  return std::nullopt;
}

// What two frames show of the regions.
struct PairSamples {
  std::vector<float> a, b, clip;
};

PairSamples SamplesOf(std::span<const float> a, std::span<const float> b,
                      std::span<const float> clip, const SampledSignals& signals,
                      const std::vector<bool>& regions) {
  PairSamples samples;
  for (std::size_t i = 0; i < clip.size(); ++i) {
    if (!regions[RegionOf(signals, i)]) continue;
    samples.a.push_back(a[i]);
    samples.b.push_back(b[i]);
    samples.clip.push_back(clip[i]);
  }
  return samples;
}

std::optional<PairRatio> MeasurePair(const SampledSignals& signals, const PairParts& parts) {
  const std::size_t a = parts.a, b = parts.b;
  const PairClips clips = ClipsOfPair(signals, a, b);
  std::span<const float> first = signals.frames[a], second = signals.frames[b], clip = clips.clip;
  PairSamples still;
  if (parts.parts.size() > 1) {
    still = SamplesOf(first, second, clip, signals, parts.parts[parts.stayed].regions);
    first = still.a, second = still.b, clip = still.clip;
  }
  const auto rough = RoughRatio(first, second, clip);
  if (!rough) return std::nullopt;
  PairRatio pair{.a = a, .b = b, .apart = parts.apart, .clip_known = clips.known};
  PairSetting setting{.ratio = *rough, .noise = kMiddlingNoise};
  setting.gate = WithinNoise(FirstGates(first, second, clip, setting, kLeastSharedSamples));
  for (int pass = 0; pass < kPasses; ++pass) {
    pair.sums = ComparePair(first, second, clip, setting);
    const auto total = TellingLevels(pair.sums, kBelievedTo);
    if (!total) return std::nullopt;
    setting.ratio = total->b / total->a;
    setting.gate = WithinNoise(GatesOf(pair.sums, kLeastSharedSamples));
  }
  return pair;
}

// A level beside the ratio R = sum b / sum a of the straight levels: what b is more than R a, and
// by how much more for a black level that is off by 1 (of full scale) in both frames, the camera's
// own:
//   (1 - R) (n - N sum a / sum A), n samples of the level and N, A of the straight ones
struct LevelBehind {
  double behind = 0.0, by_black = 0.0, of = 0.0, variance = 0.0;
};
LevelBehind BehindAt(const LevelSums& sum, const LevelSums& straight) {
  const double ratio = straight.b / straight.a;
  return {sum.b - ratio * sum.a, (1.0 - ratio) * (sum.count - straight.count * sum.a / straight.a),
          sum.b, sum.d2};
}

LevelBehind OverPairs(std::span<const PairRatio> pairs, std::size_t bin) {
  LevelBehind all;
  for (const PairRatio& pair : pairs) {
    if (!pair.clip_known) continue;
    const auto straight = TellingLevels(pair.sums, kStraightTo);
    if (!straight || pair.sums[bin].count < kLeastSharedSamples) continue;
    const LevelBehind one = BehindAt(pair.sums[bin], *straight);
    all.behind += one.behind;
    all.by_black += one.by_black;
    all.of += one.of;
    all.variance += one.variance;
  }
  return all;
}

struct BlackOff {
  double off = 0.0, variance = 0.0;
};
// Of all pairs together, by the levels up to which every sensor is straight.
BlackOff BlackOffOf(std::span<const PairRatio> pairs) {
  double weight = 1.0 / (kBlackSd * kBlackSd), sum = 0.0;
  for (int bin = 0; bin < kLevelBins && BinLowerLevel(bin + 1) <= kStraightTo; ++bin) {
    const LevelBehind level = OverPairs(pairs, static_cast<std::size_t>(bin));
    const double model = kModelSd * level.of;
    const double variance = level.variance + model * model;
    if (!(variance > 0.0)) continue;
    sum += level.by_black * level.behind / variance;
    weight += level.by_black * level.by_black / variance;
  }
  return {sum / weight, 1.0 / weight};
}

// The level from which longer frames fall behind what shorter ones predict, over all pairs and
// beside what their black level does. Where nobody knows the clip there is no level.
double LinearTo(std::span<const PairRatio> pairs) {
  const BlackOff black = BlackOffOf(pairs);
  for (int bin = 0; bin < kLevelBins; ++bin) {
    if (BinLowerLevel(bin) < kStraightTo || BinLowerLevel(bin + 1) > kHighestLinear) continue;
    const LevelBehind level = OverPairs(pairs, static_cast<std::size_t>(bin));
    const double behind = level.behind - black.off * level.by_black;
    const double variance = level.variance + black.variance * level.by_black * level.by_black;
    if (std::abs(behind) > std::max(kBendShare * level.of, kBendSigmas * std::sqrt(variance))) {
      return BinLowerLevel(bin);
    }
  }
  return kHighestLinear;
}

// Every pair of neighbours and of next neighbours in exposure that tells something. A curve's error
// makes ratios differ by level, as light that changed does: no parts are looked for then.
std::vector<PairRatio> MeasurePairs(const SampledSignals& signals,
                                    std::span<const std::size_t> order,
                                    std::span<const double> label, bool look_for_parts) {
  std::vector<std::pair<std::size_t, std::size_t>> candidates;
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i + 1; j < std::min(i + 3, order.size()); ++j) {
      candidates.emplace_back(order[i], order[j]);
    }
  }
  std::vector<PairParts> parts(candidates.size());
  ParallelFor(static_cast<int>(candidates.size()), [&](int i) {
    PairParts& pair = parts[static_cast<std::size_t>(i)];
    std::tie(pair.a, pair.b) = candidates[static_cast<std::size_t>(i)];
    pair.ln_label = std::log(label[pair.b] / label[pair.a]);
    pair.neighbours = std::ranges::find(order, pair.a) + 1 == std::ranges::find(order, pair.b);
    if (look_for_parts) FindParts(signals, pair);
  });
  ChooseStill(parts);
  std::vector<std::optional<PairRatio>> measured(candidates.size());
  ParallelFor(static_cast<int>(candidates.size()), [&](int i) {
    measured[static_cast<std::size_t>(i)] =
        MeasurePair(signals, parts[static_cast<std::size_t>(i)]);
  });
  std::vector<PairRatio> pairs;
  for (const auto& pair : measured) {
    if (pair) pairs.push_back(*pair);
  }
  return pairs;
}

// Ratios once more, up to where the sensor is straight; `model_sd` of what no residual shows.
void SumUp(std::span<PairRatio> pairs, double linear_to, double model_sd) {
  for (PairRatio& pair : pairs) {
    const double to = std::min(kBelievedTo, linear_to);
    const auto total = TellingLevels(pair.sums, to);
    const LevelSums sum = total ? *total : SumLevels(pair.sums, 0.002, kBelievedTo);
    pair.ln_ratio = std::log(sum.b / sum.a);
    pair.sd = std::hypot(std::hypot(std::sqrt(sum.d2) / sum.b, model_sd), 0.5 * pair.apart);
  }
}

// Exposures that another part of the picture shows as likely: of the frames in their order, how far
// these are from the ones chosen, and which two frames most.
void WeighParts(std::span<const PairRatio> pairs, std::span<const std::size_t> order,
                std::span<const std::string> names, ExposureRatios& answer) {
  const PairRatio* most = nullptr;
  double off = 0.0, least = 0.0, largest = 0.0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    for (const PairRatio& pair : pairs) {
      if (pair.a != order[i - 1] || pair.b != order[i] || pair.apart == 0.0) continue;
      off += pair.apart;
      if (most == nullptr || std::abs(pair.apart) > std::abs(most->apart)) most = &pair;
    }
    least = std::min(least, off);
    largest = std::max(largest, off);
  }
  if (most == nullptr) return;
  answer.part_sd = 0.5 * (largest - least);
  answer.warnings.push_back(
      {"light_changed", names[most->b],
       "beside " + names[most->a] + ", the light of a part of the picture changed by " +
           PercentText(std::expm1(std::abs(most->apart))) +
           ", and neither sizes nor exposures tell which part it was: sigma holds either. Take the "
           "frames while the light stays"});
}

// min sum ((e_b - e_a - ln_ratio)/sd)^2 with e of the first frame 0.
void SolveNetwork(std::span<const PairRatio> pairs, ExposureRatios& answer) {
  const auto n = static_cast<Eigen::Index>(answer.ln_exposure.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  for (const PairRatio& pair : pairs) {
    const double weight = 1.0 / (pair.sd * pair.sd);
    const auto a = static_cast<Eigen::Index>(pair.a);
    const auto b = static_cast<Eigen::Index>(pair.b);
    normal(a, a) += weight;
    normal(b, b) += weight;
    normal(a, b) -= weight;
    normal(b, a) -= weight;
    right(b) += weight * pair.ln_ratio;
    right(a) -= weight * pair.ln_ratio;
  }
  normal.row(0).setZero();
  normal.col(0).setZero();
  normal(0, 0) = 1.0;
  right(0) = 0.0;
  const Eigen::LDLT<Eigen::MatrixXd> solver(normal);
  const Eigen::VectorXd solution = solver.solve(right);
  const Eigen::MatrixXd covariance = solver.solve(Eigen::MatrixXd::Identity(n, n));
  for (Eigen::Index i = 0; i < n; ++i) {
    answer.ln_exposure[static_cast<std::size_t>(i)] = solution(i);
    answer.sd_ln[static_cast<std::size_t>(i)] = i == 0 ? 0.0 : std::sqrt(covariance(i, i));
  }
}

// Neighbours that share nothing are joined by their labels.
void AddLabelPairs(std::span<const std::size_t> order, std::span<const double> label,
                   std::vector<PairRatio>& pairs) {
  const std::size_t measured = pairs.size();
  for (std::size_t i = 1; i < order.size(); ++i) {
    const bool bridged =
        std::any_of(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(measured),
                    [&](const PairRatio& p) { return p.a == order[i - 1] && p.b == order[i]; });
    if (bridged) continue;
    PairRatio pair{.a = order[i - 1], .b = order[i]};
    pair.ln_ratio = std::log(label[pair.b] / label[pair.a]);
    pair.sd = kLabelRatioSd;
    pairs.push_back(pair);
  }
}

// For each frame the first of those that measurements join it to: itself, where none does.
std::vector<std::size_t> FirstJoined(std::size_t frames, std::span<const PairRatio> pairs) {
  std::vector<std::size_t> first(frames);
  std::iota(first.begin(), first.end(), std::size_t{0});
  for (const PairRatio& pair : pairs) {
    const std::size_t from = std::max(first[pair.a], first[pair.b]);
    const std::size_t to = std::min(first[pair.a], first[pair.b]);
    std::ranges::replace(first, from, to);
  }
  return first;
}

}  // namespace

Result<ExposureRatios> MeasureExposureRatios(const SampledSignals& signals,
                                             std::span<const double> label,
                                             std::span<const std::string> names,
                                             const std::optional<CurvePower>& curve) {
  const std::size_t n = label.size();
  ExposureRatios answer;
  answer.ln_exposure.assign(n, 0.0);
  answer.sd_ln.assign(n, 0.0);
  answer.measured.assign(n, false);
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return label[i] < label[j]; });
  std::vector<PairRatio> pairs = MeasurePairs(signals, order, label, !curve);
  if (!curve) answer.linear_to = LinearTo(pairs);
  SumUp(pairs, answer.linear_to, curve ? std::numbers::sqrt2 * kLeastStatedMisfit : kModelSd);
  for (const PairRatio& pair : pairs) answer.measured[pair.a] = answer.measured[pair.b] = true;
  const std::vector<std::size_t> first = FirstJoined(n, pairs);
  WeighParts(pairs, order, names, answer);
  AddLabelPairs(order, label, pairs);
  SolveNetwork(pairs, answer);
  auto compared = curve ? WeighCurve(label, names, *curve, answer)
                        : CompareWithLabels(label, names, first, answer);
  if (!compared) {
    return Propagate(std::move(compared));
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (n > 1 && !answer.measured[i]) {
      answer.warnings.push_back(
          {"ratio_from_label", names[i],
           "it shares no well exposed part with another frame, so its exposure is its label's, "
           "good to 6 %; take frames 1 to 2 EV apart"});
    }
  }
  return answer;
}

}  // namespace lightcal
