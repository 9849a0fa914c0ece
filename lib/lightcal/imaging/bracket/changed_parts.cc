// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/changed_parts.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

#include "lightcal/core/statistics.h"
#include "lightcal/core/weighted_median.h"
#include "lightcal/imaging/bracket/exposure_ratios.h"
#include "lightcal/imaging/bracket/rough_ratio.h"

namespace lightcal {
namespace {

constexpr double kLevelsFrom = 0.05,
                 kLevelsTo = 0.5;             // levels of the longer frame, as shares of the clip
constexpr std::size_t kEnoughOfRegion = 700;  // samples
constexpr std::size_t kLeastOfRegion = 48;    // of a region
constexpr std::size_t kLeastRegions = 8;
constexpr double kModel = 0.003;    // of a region's ln ratio: what no noise shows
constexpr double kBlackOff = 2e-4;  // of the clip
constexpr double kMemberSigmas = 4.0;
constexpr double kWellKnown = 0.01;   // of a region's ln ratio
constexpr double kSecondShare = 0.1;  // of the first part, at least
constexpr double kRivalShare = 0.25;  // of the first part: either may be what stayed
constexpr double kMostOfRest = 0.5;   // that a rival holds
constexpr double kSurer = 20.0;       // times as likely

struct RegionRatio {
  double ln = 0.0, sd = 0.0, weight = 0.0;
};
using RegionRatios = std::vector<std::optional<RegionRatio>>;

struct RegionSamples {
  std::vector<WeightedValue> ratios;
  double levels = 0.0;  // sum, as shares of the clip
};

std::optional<RegionRatio> RatioOf(RegionSamples& samples) {
  constexpr double kSdOfMedian = 1.2533;
  if (samples.ratios.size() < kLeastOfRegion) return std::nullopt;
  const double level = samples.levels / static_cast<double>(samples.ratios.size());
  const double ratio = WeightedMedian(samples.ratios);
  if (!(ratio > 0.0)) return std::nullopt;
  double sum = 0.0, squares = 0.0;
  for (WeightedValue& one : samples.ratios) {
    sum += one.weight;
    squares += one.weight * one.weight;
    one.value = std::abs(one.value - ratio);
  }
  const double scatter = kSdPerMad * WeightedMedian(samples.ratios) / ratio;
  const double noise = kSdOfMedian * scatter * std::sqrt(squares) / sum;
  const double sd = std::hypot(noise, kModel, kBlackOff / level);
  return RegionRatio{std::log(ratio), sd, 1.0 / (1.0 + sd * sd / (kWellKnown * kWellKnown))};
}

RegionRatios RatiosOfRegions(const SampledSignals& signals, std::size_t a, std::size_t b,
                             std::span<const float> clip, double ratio) {
  std::vector<RegionSamples> samples(kRegions);
  const auto& first = signals.frames[a];
  const auto& second = signals.frames[b];
  const double larger = std::max(ratio, 1.0);
  for (std::size_t i = 0; i < first.size(); i += first.size() / (kRegions * kEnoughOfRegion) + 1) {
    const double x = (double{first[i]} + second[i]) / (1.0 + ratio) / clip[i];
    if (x * larger < kLevelsFrom || x * larger > kLevelsTo || !(first[i] > 0.0F)) continue;
    RegionSamples& region = samples[RegionOf(signals, i)];
    region.ratios.push_back({second[i] / double{first[i]}, std::sqrt(x)});
    region.levels += x;
  }
  RegionRatios ratios;
  for (auto& region : samples) ratios.push_back(RatioOf(region));
  return ratios;
}

// How much of what is left lies about `ln`.
double DensityAt(const RegionRatios& ratios, const std::vector<bool>& left, double ln) {
  double sum = 0.0;
  for (std::size_t r = 0; r < kRegions; ++r) {
    if (!left[r]) continue;
    const double off = (ratios[r]->ln - ln) / (kMemberSigmas * ratios[r]->sd);
    if (std::abs(off) < 1.0) sum += ratios[r]->weight * (1.0 - off * off);
  }
  return sum;
}

// The regions about the densest ratio, taken out of what is left.
RatioPart TakeDensest(const RegionRatios& ratios, std::vector<bool>& left) {
  double densest = -1.0, at = 0.0;
  for (std::size_t r = 0; r < kRegions; ++r) {
    if (!left[r]) continue;
    const double density = DensityAt(ratios, left, ratios[r]->ln);
    if (density > densest) densest = density, at = ratios[r]->ln;
  }
  RatioPart part{.regions = std::vector<bool>(kRegions, false)};
  double sum = 0.0, precision = 0.0;
  for (std::size_t r = 0; r < kRegions; ++r) {
    if (!left[r] || std::abs(ratios[r]->ln - at) > kMemberSigmas * ratios[r]->sd) continue;
    part.regions[r] = true;
    left[r] = false;
    part.weight += ratios[r]->weight;
    sum += ratios[r]->ln / (ratios[r]->sd * ratios[r]->sd);
    precision += 1.0 / (ratios[r]->sd * ratios[r]->sd);
  }
  part.ln_ratio = sum / precision;
  return part;
}

double WeightOf(const RegionRatios& ratios, const std::vector<bool>& left) {
  double sum = 0.0;
  for (std::size_t r = 0; r < kRegions; ++r) sum += left[r] ? ratios[r]->weight : 0.0;
  return sum;
}

double Overlap(const std::vector<bool>& one, const std::vector<bool>& other) {
  double both = 0.0;
  for (std::size_t r = 0; r < kRegions; ++r) both += one[r] && other[r] ? 1.0 : 0.0;
  return both;
}

// Whether the regions are a light's change: they lie together, and neighbours are alike,
// beside what they differ from the first part by. People and edges that moved leave many ratios.
bool AreLight(const RegionRatios& ratios, const std::vector<bool>& regions, double ln_first) {
  constexpr double kBeside = 0.8;  // neighbours a region
  constexpr double kAlike = 0.4;
  std::vector<double> off, steps;
  const auto step = [&](std::size_t r, std::size_t beside) {
    if (regions[beside]) steps.push_back(std::abs(ratios[r]->ln - ratios[beside]->ln));
  };
  for (std::size_t r = 0; r < kRegions; ++r) {
    if (!regions[r]) continue;
    off.push_back(std::abs(ratios[r]->ln - ln_first));
    if ((r + 1) % kRegionsAcross != 0) step(r, r + 1);
    if (r + kRegionsAcross < kRegions) step(r, r + kRegionsAcross);
  }
  if (static_cast<double>(steps.size()) < kBeside * static_cast<double>(off.size())) return false;
  return UpperMedian(steps) < kAlike * UpperMedian(off);
}

// The part of the pair that is most of `still`.
std::size_t ShownBy(const PairParts& pair, const std::vector<bool>& still) {
  if (pair.parts.size() < 2) return 0;
  return Overlap(pair.parts[1].regions, still) > Overlap(pair.parts[0].regions, still) ? 1 : 0;
}

// ln of how likely labels and sizes make it that `still` is what stayed: frames are each off their
// label by as much as the pairs of neighbours say, of which no common factor is known.
double LikelihoodOf(std::span<const PairParts> pairs, const std::vector<bool>& still) {
  std::vector<double> off{0.0};
  double sizes = 0.0, rivals = 0.0;
  for (const PairParts& pair : pairs) {
    if (!pair.neighbours) continue;
    off.push_back(off.back());
    if (pair.parts.empty()) continue;
    const RatioPart& part = pair.parts[ShownBy(pair, still)];
    off.back() += part.ln_ratio - pair.ln_label;
    if (!pair.rivals) continue;
    sizes += std::log(part.weight);
    rivals += 1.0;
  }
  const double mean =
      std::accumulate(off.begin(), off.end(), 0.0) / static_cast<double>(off.size());
  double squares = 0.0;
  for (const double o : off) squares += (o - mean) * (o - mean);
  return sizes / std::max(rivals, 1.0) - squares / (2.0 * kLabelSd * kLabelSd);
}

struct Candidate {
  std::vector<bool> still;
  double ln_likelihood = 0.0;
};

// The likeliest first.
std::vector<Candidate> CandidatesOf(std::span<const PairParts> pairs) {
  std::vector<Candidate> candidates;
  for (const PairParts& pair : pairs) {
    if (!pair.rivals || !pair.neighbours) continue;
    for (const RatioPart& part : pair.parts) {
      candidates.push_back({part.regions, LikelihoodOf(pairs, part.regions)});
    }
  }
  std::ranges::stable_sort(candidates, std::ranges::greater{}, &Candidate::ln_likelihood);
  return candidates;
}

// By how much the ratios that `other` shows differ from those chosen.
std::vector<double> ApartOf(std::span<const PairParts> pairs, const Candidate& other) {
  std::vector<double> apart;
  for (const PairParts& pair : pairs) {
    const std::size_t shown = ShownBy(pair, other.still);
    apart.push_back(
        shown == pair.stayed ? 0.0 : pair.parts[shown].ln_ratio - pair.parts[pair.stayed].ln_ratio);
  }
  return apart;
}

// Where a pair shows no change, too little of it to be told may be where other pairs show one.
void LeaveOutChanged(std::span<PairParts> pairs) {
  std::vector<bool> changed(kRegions, false);
  for (const PairParts& pair : pairs) {
    for (std::size_t r = 0; pair.rivals && r < kRegions; ++r) {
      if (pair.parts[1 - pair.stayed].regions[r]) changed[r] = true;
    }
  }
  for (PairParts& pair : pairs) {
    if (pair.parts.size() != 1) continue;
    RatioPart still = pair.parts[0];
    for (std::size_t r = 0; r < kRegions; ++r) still.regions[r] = still.regions[r] && !changed[r];
    if (static_cast<std::size_t>(std::ranges::count(still.regions, true)) < kLeastRegions) continue;
    pair.parts.insert(pair.parts.begin(), still);
  }
}

}  // namespace

std::size_t RegionOf(const SampledSignals& signals, std::size_t i) {
  const std::size_t rows = signals.clip.size() / signals.row_samples;
  const std::size_t y = i / signals.row_samples * kRegionsDown / rows;
  const std::size_t x = i % signals.row_samples * kRegionsAcross / signals.row_samples;
  return y * kRegionsAcross + x;
}

void FindParts(const SampledSignals& signals, PairParts& pair) {
  if (signals.row_samples == 0) return;
  const PairClips clips = ClipsOfPair(signals, pair.a, pair.b);
  const auto rough = RoughRatio(signals.frames[pair.a], signals.frames[pair.b], clips.clip);
  if (!rough) return;
  const RegionRatios ratios = RatiosOfRegions(signals, pair.a, pair.b, clips.clip, *rough);
  std::vector<bool> left;
  for (const auto& region : ratios) left.push_back(region.has_value());
  if (static_cast<std::size_t>(std::ranges::count(left, true)) < kLeastRegions) return;
  pair.parts.push_back(TakeDensest(ratios, left));
  const double rest = WeightOf(ratios, left);
  const double ln_first = pair.parts[0].ln_ratio;
  if (rest < kSecondShare * pair.parts[0].weight || !AreLight(ratios, left, ln_first)) return;
  pair.parts.push_back(TakeDensest(ratios, left));
  const RatioPart& second = pair.parts[1];
  pair.rivals = second.weight > kRivalShare * pair.parts[0].weight &&
                second.weight > kMostOfRest * rest && AreLight(ratios, second.regions, ln_first);
}

void ChooseStill(std::span<PairParts> pairs) {
  const std::vector<Candidate> candidates = CandidatesOf(pairs);
  if (candidates.empty()) return;
  for (PairParts& pair : pairs) {
    pair.stayed = ShownBy(pair, candidates.front().still);
  }
  LeaveOutChanged(pairs);
  // The likeliest one that shows other ratios.
  for (const Candidate& other : candidates) {
    if (other.ln_likelihood + std::log(kSurer) < candidates.front().ln_likelihood) return;
    const std::vector<double> apart = ApartOf(pairs, other);
    if (std::ranges::all_of(apart, [](double ln) { return ln == 0.0; })) continue;
    for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i].apart = apart[i];
    return;
  }
}

}  // namespace lightcal
