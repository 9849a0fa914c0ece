// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/candidates.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

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

// Of a lamp that is not built as it was described.
const double kLnUnlikeItsPrior = std::log(0.05);

void SortByProbability(std::vector<Candidate>& candidates) {
  std::vector<std::size_t> order(candidates.size());  // they are long to move about
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::ranges::greater(),
                           [&](std::size_t i) { return candidates[i].ln_probability; });
  std::vector<Candidate> sorted;
  sorted.reserve(order.size());
  for (const std::size_t i : order) sorted.push_back(std::move(candidates[i]));
  candidates = std::move(sorted);
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
  out.reserve(hypotheses.size());
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

// As likely as its readings and the blunders among them make it.
void WeighEstimate(Candidate& one) {
  one.ln_probability = one.ln_prior + LnEvidence(one.estimate.kept, one.estimate.theta) +
                       kLnBlunder * static_cast<double>(one.estimate.rejected.size());
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
    WeighEstimate(one);
  }
  SortByProbability(candidates);
  return {};
}

// The row of the one reading without which the others ask for an offset that its prior allows;
// absent where none or several are.
std::optional<int> ReadingThatAsks(const Estimation& stated, const Prepared& prepared) {
  constexpr std::size_t kFewest = 3, kMost = 40;
  const ParameterRule& rule = stated.rules[kDistanceOffset];
  std::optional<int> found;
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
    if (pull > kPriorConflict * rule.prior_sd) continue;
    if (found) return std::nullopt;
    found = i;
  }
  return found;
}

// Every hypothesis without that row, a blunder.
Result<void> LeaveOut(int row, double offset_m, std::vector<Candidate>& candidates) {
  for (Candidate& one : candidates) {
    Estimation rest = one.estimation;
    rest.rows = Without(one.estimation.rows, {row});
    Result<RobustEstimate> kept = EstimateRobustly(rest);
    if (!kept) return Propagate(std::move(kept));
    for (std::vector<int>* positions : {&kept->rejected, &kept->suspicious}) {
      for (int& position : *positions) position += position >= row ? 1 : 0;
    }
    if (kept->rejected.empty()) kept->offset_of_one_m = offset_m;
    kept->rejected.push_back(row);
    std::ranges::sort(kept->rejected);
    one.estimate = *std::move(kept);
    WeighEstimate(one);
  }
  return {};
}

// Readings that ask for an offset beyond two standard deviations of its prior widen it, and leave
// the other hypotheses out. Where it is one reading that asks, that one may be a blunder as well as
// the lamp unlike its description: both stay, as likely as each makes the readings.
Result<void> WidenOffset(std::vector<Candidate>& candidates, const Prepared& prepared,
                         const Observations& observations, const std::string& light,
                         Warnings& warnings) {
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
  std::optional<int> odd;
  // Readings by positions disagree where the lamp stands elsewhere than was said.
  const bool by_positions =
      std::ranges::any_of(observations.rows, &Observation::measured_from_center);
  if (first.estimate.rejected.empty() && !by_positions) {
    odd = ReadingThatAsks(first.estimation, prepared);
  }
  rule.prior_sd = 100.0 * stated;
  Result<RobustEstimate> unguided = again(first.estimation);
  if (!unguided) return Propagate(std::move(unguided));
  rule.prior_sd = std::clamp(pull(unguided->theta), kPriorConflict * stated, 100.0 * stated);
  std::vector<Candidate> widened = {first};
  Result<RobustEstimate> estimate = again(widened.front().estimation);
  if (!estimate) return Propagate(std::move(estimate));
  widened.front().estimate = *std::move(estimate);
  const double asked_m = unguided->theta[kDistanceOffset] * prepared.scales.length_m;
  if (odd) {
    widened.front().ln_prior += kLnUnlikeItsPrior;
    WeighEstimate(widened.front());
    rule.prior_sd = stated;
    if (auto rest = LeaveOut(*odd, asked_m, candidates); !rest) return Propagate(std::move(rest));
    std::ranges::move(candidates, std::back_inserter(widened));
    SortByProbability(widened);
  }
  candidates = std::move(widened);
  std::string without;
  if (odd) {
    const std::vector<int>& rejected = candidates.front().estimate.rejected;
    if (std::ranges::find(rejected, *odd) != rejected.end()) return {};  // WarnOfRows says why
    const auto own = static_cast<std::size_t>(prepared.observation[static_cast<std::size_t>(*odd)]);
    without = "; without " + NameOfReading(observations.rows[own]) +
              " they do not, so look at its digits";
  }
  warnings.push_back(
      {"prior_conflict", light,
       "the readings ask for a distance offset of " + RoundedText(asked_m, 3) +
           " m, more than two standard deviations of its prior (" +
           RoundedText(stated * prepared.scales.length_m, 3) + " m)" + without +
           "; the prior was widened: check the distances and the lamp's reference point"});
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
  if (auto widened = WidenOffset(*solved, prepared, observations, light, warnings); !widened) {
    return Propagate(std::move(widened));
  }
  return solved;
}

}  // namespace lightcal::fit
