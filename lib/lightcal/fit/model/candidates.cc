// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "lightcal/core/normal_mixture.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/model/merged_rows.h"
#include "lightcal/fit/model/misfit.h"
#include "lightcal/fit/model/shared_scatter.h"
#include "lightcal/fit/model/starts.h"

namespace lightcal::fit {
namespace {

constexpr double kPriorConflict = 2.0;  // prior standard deviations
// Logarithm of a blunder's density in ln E: one reading in fifty, anywhere within a factor of 150.
const double kLnBlunder = std::log(0.02 / std::log(150.0));

void SortByProbability(std::vector<Candidate>& candidates) {
  std::ranges::stable_sort(candidates, std::ranges::greater(), &Candidate::ln_probability);
}

Candidate CandidateUnder(const LampHypothesis& hypothesis, const Prepared& prepared,
                         const Observations& observations) {
  Candidate out;
  out.hypothesis = hypothesis;
  out.estimation = EstimationUnder(hypothesis, prepared, observations);
  return out;
}

// And how likely that makes it among others.
void TakeOptimum(const Theta& theta, Candidate& candidate) {
  candidate.squared = theta;
  candidate.ln_prior = std::log(candidate.hypothesis.weight);
  candidate.ln_probability = candidate.ln_prior + LnEvidence(candidate.estimation, theta);
}

// A hypothesis as its merged rows have it.
struct MergedCandidate {
  LampHypothesis hypothesis;
  Theta theta{};
  double ln_probability = 0.0;
};

// Where to begin: at its own start or, where that is likelier, at the optimum of the hypothesis
// before it in all that may move: neighbours differ little.
Theta StartBeside(const Theta* before, Estimation& estimation) {
  const Theta own = StartOf(estimation);
  if (before == nullptr || !estimation.rules[kLnWalls].free) return own;
  Theta beside = own;
  for (int k = 0; k < kParameters; ++k) {
    if (estimation.rules[k].free) beside[k] = (*before)[k];
  }
  SettleScatter(estimation, own);
  const double cost = HalfChiSquared(estimation, own);
  return HalfChiSquared(estimation, beside) < cost ? beside : own;
}

std::optional<std::vector<MergedCandidate>> SolveMerged(
    const std::vector<LampHypothesis>& hypotheses, const Prepared& prepared,
    const Observations& observations) {
  std::vector<MergedCandidate> out;
  for (const LampHypothesis& hypothesis : hypotheses) {
    std::optional<MergedRows> merged = Merge(EstimationUnder(hypothesis, prepared, observations));
    if (!merged) return std::nullopt;
    Estimation& rows = merged->estimation;
    if (!rows.rules[kLnWalls].free || rows.rules[kAmbient].free) return std::nullopt;
    const Theta start = StartBeside(out.empty() ? nullptr : &out.back().theta, rows);
    const Result<Theta> theta = SolveSettledFrom(start, rows);
    if (!theta) return std::nullopt;
    out.push_back({hypothesis, *theta, std::log(hypothesis.weight) + LnEvidence(*merged, *theta)});
  }
  return out;
}

// Of many readings, only the hypotheses that their merged rows leave in question, each from there;
// the likeliest first. Absent where merging tells nothing, or told the evidence by more than a
// third of the margin wrong.
std::optional<std::vector<Candidate>> SolveLikely(const Prepared& prepared,
                                                  const ForwardModel& model,
                                                  const Observations& observations) {
  // Shares end at exp(-9.2) of the likeliest (SharesOf).
  constexpr double kMargin = 18.0;
  constexpr std::size_t kFewest = 24;
  if (prepared.estimation.choice.solver != SolverChoice::kQuick) return std::nullopt;
  if (prepared.estimation.rows.size() < kFewest) return std::nullopt;
  const std::vector<LampHypothesis> hypotheses = HypothesesOf(model);
  if (hypotheses.size() < 2) return std::nullopt;
  const auto merged = SolveMerged(hypotheses, prepared, observations);
  if (!merged) return std::nullopt;
  const double most =
      std::ranges::max(*merged, {}, &MergedCandidate::ln_probability).ln_probability;
  std::vector<Candidate> out;
  double least_off = std::numeric_limits<double>::infinity();
  double most_off = -least_off;
  for (const MergedCandidate& likely : *merged) {
    if (!(likely.ln_probability >= most - kMargin)) continue;
    Candidate one = CandidateUnder(likely.hypothesis, prepared, observations);
    const Result<Theta> theta = SolveSettledFrom(likely.theta, one.estimation);
    if (!theta) return std::nullopt;
    TakeOptimum(*theta, one);
    least_off = std::min(least_off, one.ln_probability - likely.ln_probability);
    most_off = std::max(most_off, one.ln_probability - likely.ln_probability);
    out.push_back(std::move(one));
  }
  if (!(most_off - least_off < kMargin / 3.0)) return std::nullopt;
  SortByProbability(out);
  return out;
}

// Every hypothesis solved, the likeliest first. Fails as Solve, where none has an optimum.
Result<std::vector<Candidate>> SolveEach(const Prepared& prepared, const ForwardModel& model,
                                         const Observations& observations) {
  std::vector<Candidate> out;
  std::optional<Error> failure;
  const std::vector<LampHypothesis> hypotheses = HypothesesOf(model);
  for (const LampHypothesis& hypothesis : hypotheses) {
    Candidate one = CandidateUnder(hypothesis, prepared, observations);
    const Theta start = StartBeside(out.empty() ? nullptr : &out.back().squared, one.estimation);
    const Result<Theta> theta = SolveSettledFrom(start, one.estimation);
    if (!theta) {
      failure = theta.error();
      continue;
    }
    if (hypotheses.size() > 1) {
      TakeOptimum(*theta, one);
    } else {
      one.squared = *theta;  // nothing to weigh it against
    }
    out.push_back(std::move(one));
  }
  if (out.empty()) return tl::unexpected(*std::move(failure));
  SortByProbability(out);
  return out;
}

bool HasFarRow(const Candidate& candidate) {
  return std::ranges::any_of(candidate.estimation.rows, [&](const ReadingRow& row) {
    return std::abs(RowResidual(row, candidate.squared)) > kSuspiciousResidual;
  });
}

// Where readings contradict the likeliest, each is estimated robustly, and the likeliest with its
// blunders takes its place: a blunder bends whatever is told to explain it.
Result<void> ChooseRobustly(std::vector<Candidate>& candidates) {
  const auto settle = [](Candidate& one) -> Result<void> {
    Result<RobustEstimate> estimate = EstimateRobustly(one.estimation, &one.squared);
    if (!estimate) return Propagate(std::move(estimate));
    one.estimate = *std::move(estimate);
    return {};
  };
  if (candidates.size() == 1 || !HasFarRow(candidates.front())) return settle(candidates.front());
  for (Candidate& one : candidates) {
    if (auto settled = settle(one); !settled) return settled;
    one.ln_probability = one.ln_prior + LnEvidence(one.estimate.kept, one.estimate.theta) +
                         kLnBlunder * static_cast<double>(one.estimate.rejected.size());
  }
  SortByProbability(candidates);
  return {};
}

// The one reading without which the others ask for an offset that its prior allows: "; without
// reading 0 (302 lx at 0.5 m) they do not, ..."; empty where none or several are.
std::string ReadingThatAsks(const Estimation& stated, const Prepared& prepared,
                            const Observations& observations) {
  constexpr double kNoConflict = 1.0;  // prior standard deviations
  constexpr std::size_t kFewest = 3, kMost = 40;
  const ParameterRule& rule = stated.rules[kDistanceOffset];
  std::string found;
  int lit = 0;
  for (int i = 0; i < prepared.own_rows; ++i) {
    lit += stated.rows[static_cast<std::size_t>(i)].direct_gain > 0.0 ? 1 : 0;
  }
  if (lit < static_cast<int>(kFewest) || stated.rows.size() > kMost) return found;
  for (int i = 0; i < prepared.own_rows; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (!(stated.rows[at].direct_gain > 0.0)) continue;
    Estimation rest = stated;
    rest.rows = Without(stated.rows, {i});
    const Result<Theta> theta = SolveSettled(rest);
    if (!theta) continue;
    const double pull = std::abs((*theta)[kDistanceOffset] - rule.prior_mean);
    if (pull > kNoConflict * rule.prior_sd) continue;
    if (!found.empty()) return "";
    const auto own = static_cast<std::size_t>(prepared.observation[at]);
    found = "; without " + NameOfReading(observations.rows[own]) +
            " they do not, so look at its digits";
  }
  return found;
}

// Between places that are both told no distance is counted from a wrong point: one of them is
// wrong.
tl::unexpected<Error> RefuseOffset(double offset_m, const std::string& odd,
                                   const std::string& light) {
  return Refused("model_misfit", light,
                 "no lamp gives these readings: their light would have to start " +
                     RoundedText(std::abs(offset_m), 3) + " m " +
                     (offset_m < 0.0 ? "before" : "behind") + " the lamp" + odd + ": " +
                     std::string(kAskForPlaces));
}

// Readings that ask for an offset beyond two standard deviations of its prior widen it, and leave
// the other hypotheses out. Refused: model_misfit.
Result<void> WidenOffset(std::vector<Candidate>& candidates, const Prepared& prepared,
                         const ForwardModel& model, const Observations& observations,
                         const std::string& light, Warnings& warnings) {
  Candidate& first = candidates.front();
  ParameterRule& rule = first.estimation.rules[kDistanceOffset];
  if (!rule.free) return {};
  const auto again = [&](const Estimation& estimation) { return EstimateRobustly(estimation); };
  if (first.estimate.bimodal) {
    // Two camps among four readings say nothing of offset and ambient light, however hard they
    // pull.
    rule.free = false;
    if (!prepared.ambient_told) first.estimation.rules[kAmbient] = {};
    Result<RobustEstimate> held = again(first.estimation);
    if (!held) return Propagate(std::move(held));
    first.estimate = *std::move(held);
    return {};
  }
  const auto pull = [&](const Theta& theta) {
    return std::abs(theta[kDistanceOffset] - rule.prior_mean);
  };
  if (pull(first.estimate.theta) <= kPriorConflict * rule.prior_sd) return {};
  const double stated = rule.prior_sd;
  const std::string odd = ReadingThatAsks(first.estimation, prepared, observations);
  rule.prior_sd = 100.0 * stated;
  Result<RobustEstimate> unguided = again(first.estimation);
  if (!unguided) return Propagate(std::move(unguided));
  rule.prior_sd = std::clamp(pull(unguided->theta), kPriorConflict * stated, 100.0 * stated);
  warnings.push_back(
      {"prior_conflict", light,
       "the readings ask for a distance offset of " +
           RoundedText(unguided->theta[kDistanceOffset] * prepared.scales.length_m, 3) +
           " m, more than two standard deviations of its prior (" +
           RoundedText(stated * prepared.scales.length_m, 3) + " m)" + odd +
           "; the prior was widened: check the distances and the lamp's reference point"});
  Result<RobustEstimate> estimate = again(first.estimation);
  if (!estimate) return Propagate(std::move(estimate));
  first.estimate = *std::move(estimate);
  candidates.resize(1);
  // Beyond the deepest fixture there is, a softbox measured from its mount (fixture.h: 0.30 m and
  // four standard deviations of 0.08 m).
  constexpr double kNeverSd = 4.0, kDeepest_m = 0.6;
  const double offset_m = first.estimate.theta[kDistanceOffset] * prepared.scales.length_m;
  if (model.judge_misfit && model.choice.reject && BetweenPlaces(observations) &&
      std::abs(offset_m) > kDeepest_m && pull(first.estimate.theta) > kNeverSd * stated) {
    return RefuseOffset(offset_m, odd, light);
  }
  return {};
}

// Where a reading lies far from the likeliest, what it would be without that reading is in question
// too: every hypothesis.
Result<std::vector<Candidate>> SolveInQuestion(const Prepared& prepared, const ForwardModel& model,
                                               const Observations& observations) {
  std::optional<std::vector<Candidate>> likely = SolveLikely(prepared, model, observations);
  if (likely && !HasFarRow(likely->front())) return *std::move(likely);
  return SolveEach(prepared, model, observations);
}

}  // namespace

Result<std::vector<Candidate>> SolveCandidates(const Prepared& prepared, const ForwardModel& model,
                                               const Observations& observations,
                                               const std::string& light, Warnings& warnings) {
  Result<std::vector<Candidate>> solved = SolveInQuestion(prepared, model, observations);
  if (!solved) return solved;
  if (auto chosen = ChooseRobustly(*solved); !chosen) return Propagate(std::move(chosen));
  if (auto widened = WidenOffset(*solved, prepared, model, observations, light, warnings);
      !widened) {
    return Propagate(std::move(widened));
  }
  return solved;
}

void KeepComparable(std::vector<Candidate>& candidates) {
  const RobustEstimate& first = candidates.front().estimate;
  if (!first.suspicious.empty() || first.bimodal) candidates.resize(1);
  const std::vector<int> rejected = first.rejected;
  for (std::size_t i = 1; i < candidates.size(); ++i) {
    Candidate& one = candidates[i];
    one.estimate = {one.squared, one.estimation, rejected, {}, false};
    if (rejected.empty()) continue;
    one.estimate.kept.rows = Without(one.estimation.rows, rejected);
    const Result<Theta> theta = SolveSettled(one.estimate.kept);
    one.estimate.theta = theta ? *theta : one.squared;
    one.ln_probability = one.ln_prior + LnEvidence(one.estimate.kept, one.estimate.theta);
  }
}

std::vector<double> SharesOf(std::vector<Candidate>& candidates) {
  constexpr double kLeastLikelihood = 1e-4;
  double most = -std::numeric_limits<double>::infinity();
  for (const Candidate& one : candidates) most = std::max(most, one.ln_probability);
  const auto likelihood = [most](const Candidate& one) {
    return std::exp(one.ln_probability - most);
  };
  // The first stays: its rows were looked at.
  const auto gone = std::ranges::remove_if(
      candidates.begin() + 1, candidates.end(),
      [&](const Candidate& one) { return likelihood(one) < kLeastLikelihood; });
  candidates.erase(gone.begin(), gone.end());
  std::vector<double> shares;
  double whole = 0.0;
  for (const Candidate& one : candidates) whole += likelihood(one);
  for (const Candidate& one : candidates) shares.push_back(likelihood(one) / whole);
  return shares;
}

namespace {

// The candidate with ln I also N(sheet), and the density of the sheet's value under it.
double TellIntensity(const SheetIntensity& sheet, Candidate& one) {
  const double variance = one.covariance[kLnIntensity] + sheet.sd * sheet.sd;
  const double off = sheet.ln_cd - one.estimate.theta[kLnIntensity];
  std::array<double, kParameters> gain{};
  for (int i = 0; i < kParameters; ++i) gain[i] = one.covariance[i * kParameters] / variance;
  for (int i = 0; i < kParameters; ++i) {
    one.estimate.theta[i] += gain[i] * off;
    for (int j = 0; j < kParameters; ++j) {
      one.covariance[i * kParameters + j] -= gain[i] * gain[j] * variance;
    }
  }
  one.estimate.theta[kAmbient] = std::max(0.0, one.estimate.theta[kAmbient]);
  return std::exp(-0.5 * off * off / variance) / std::sqrt(2.0 * std::numbers::pi * variance);
}

}  // namespace

WeighedCandidates WithSheet(const SheetIntensity& sheet, const std::vector<Candidate>& candidates,
                            const std::vector<double>& shares) {
  constexpr double kHeld = 0.95;
  constexpr double kLeastWeight = 1e-4;
  static const double kLnReach = std::log(1.2 / 0.05);
  std::vector<std::pair<double, Candidate>> weighed;
  double whole = 0.0, held = 0.0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    Candidate told = candidates[i];
    const double density = TellIntensity(sheet, told);
    weighed.emplace_back(shares[i] * kHeld * density, std::move(told));
    weighed.emplace_back(shares[i] * (1.0 - kHeld) / kLnReach, candidates[i]);
    held += weighed[weighed.size() - 2].first;
    whole += weighed.back().first + weighed[weighed.size() - 2].first;
  }
  std::ranges::stable_sort(weighed, std::ranges::greater(), &std::pair<double, Candidate>::first);
  WeighedCandidates out;
  out.held = held / whole;
  double kept = 0.0;
  for (auto& [weight, one] : weighed) {
    if (weight < kLeastWeight * whole) break;
    out.candidates.push_back(std::move(one));
    out.shares.push_back(weight);
    kept += weight;
  }
  for (double& share : out.shares) share /= kept;
  return out;
}

namespace {

std::array<double, std::size_t{LampInRoom::kCount} * LampInRoom::kCount> CovarianceInRoom(
    const Covariance& whole) {
  constexpr int n = LampInRoom::kCount;
  std::array<double, std::size_t{n} * n> out{};
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) out[i * n + j] = whole[i * kParameters + j];
  }
  return out;
}

}  // namespace

std::vector<LampInRoom> InRoom(const std::vector<Candidate>& candidates,
                               const std::vector<double>& shares) {
  constexpr double kLeastShareTold = 0.01;
  const auto sees_walls = [](const Candidate& one) {
    return one.hypothesis.walls.has_value() && one.estimation.rules[kLnWalls].free;
  };
  const bool walls_shine = sees_walls(candidates.front());
  if (!walls_shine && candidates.size() == 1) return {};
  std::vector<LampInRoom> out;
  double whole = 0.0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& one = candidates[i];
    if (sees_walls(one) != walls_shine) return {};
    if (shares[i] < kLeastShareTold) continue;
    const Theta& theta = one.estimate.theta;
    LampInRoom& told = out.emplace_back();
    told.weight = shares[i];
    told.ln_intensity = theta[kLnIntensity];
    told.distance_offset_m = theta[kDistanceOffset];
    told.ambient_lx = theta[kAmbient];
    told.covariance = CovarianceInRoom(one.covariance);
    whole += shares[i];
    told.width_m = one.hypothesis.width_m;
    told.height_m = one.hypothesis.height_m;
    if (!walls_shine) continue;
    told.ln_b = theta[kLnWalls];
    told.slope = theta[kWallsSlope];
    told.bend = one.hypothesis.walls->bend;
    told.scatter = one.hypothesis.walls->scatter;
  }
  for (LampInRoom& one : out) one.weight /= whole;
  return out;
}

void Mix(const std::vector<Candidate>& candidates, const std::vector<double>& shares,
         LightEstimate& out) {
  constexpr double kTail = 0.025;
  const auto marginal = [&](int k) {
    std::vector<NormalPart> parts;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const Candidate& one = candidates[i];
      parts.push_back({shares[i], one.estimate.theta[k],
                       std::sqrt(std::max(0.0, one.covariance[k * kParameters + k]))});
    }
    return parts;
  };
  const std::vector<NormalPart> ln = marginal(kLnIntensity);
  out.theta = candidates.front().estimate.theta;
  for (const Parameter k : {kLnIntensity, kDistanceOffset}) {
    out.theta[k] = QuantileOf(marginal(k), 0.5);
  }
  out.ln_interval = {QuantileOf(ln, kTail), QuantileOf(ln, 1.0 - kTail)};
  out.covariance = {};
  for (std::size_t n = 0; n < candidates.size(); ++n) {
    const Candidate& one = candidates[n];
    for (int i = 0; i < kParameters; ++i) {
      for (int j = 0; j < kParameters; ++j) {
        out.covariance[i * kParameters + j] +=
            shares[n] *
            (one.covariance[i * kParameters + j] +
             (one.estimate.theta[i] - out.theta[i]) * (one.estimate.theta[j] - out.theta[j]));
      }
    }
  }
  constexpr int kVariance = kLnIntensity * (kParameters + 1);
  const double between = out.covariance[kVariance] - candidates.front().covariance[kVariance];
  if (between > 0.0) out.variance_parts.push_back({"unknown_lamp", between});
}
}  // namespace lightcal::fit
