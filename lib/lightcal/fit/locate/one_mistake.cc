// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/locate/one_mistake.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/locate/mistyped.h"
#include "lightcal/fit/locate/placed_modes.h"
#include "lightcal/fit/locate/placed_starts.h"
#include "lightcal/fit/model/evidence.h"
#include "lightcal/fit/model/misfit.h"
#include "lightcal/fit/model/uneven_light.h"

namespace lightcal::fit {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();
constexpr double kMistaken = 0.15;  // sessions that hold a mistake
// Those that hold light which nobody read with the lamp off, of dark ones and of ones outdoors.
constexpr double kOtherLight = 0.03, kOtherLightOutdoors = 0.5;
constexpr double kUneven = 0.5;     // points of no stated fixture that shine as a bulb does
constexpr double kThoughtOf = 0.1;  // of chi-squared, below which a mistake is thought of
// Of a reading that is wrong in no way people are known to be: ln of its density is as of any value
// within a factor of e^6, sqrt(2 pi) as evidence.h leaves it out.
constexpr double kLnOfAnything = -0.873;
constexpr double kOtherShare = 0.2;      // of mistakes that mistyped.cc does not know
constexpr double kHopeless = 40.0;       // of chi-squared beyond the best
constexpr double kAboutMeters = 3.0;     // 1 sigma of the lamp's place, in extents of the layout
constexpr double kLnIntensity_sd = 1.5;  // and its mean, of the mean lux times extent squared
constexpr double kSure = 100.0, kClear = 20.0;
constexpr double kAsRead = 0.8;  // probability that noise has to have, to be answered
constexpr std::size_t kMostNamed = 3;

// How far sigmas may be understated, and how often they are.
struct Understated {
  double factor, share;
};
constexpr std::array<Understated, 3> kUnderstated = {{{1.0, 0.75}, {2.0, 0.2}, {4.0, 0.05}}};

// ln(e^a + e^b).
double LnSum(double a, double b) {
  const double most = std::max(a, b);
  return std::isfinite(most) ? most + std::log(std::exp(a - most) + std::exp(b - most)) : most;
}

int FreeParameters(const PlacedEstimation& estimation) {
  return 4 + (estimation.rules[kPlacedAmbient].free ? 1 : 0) +
         (estimation.rules[kPlacedOffset].free ? 1 : 0);
}

PlacedProblem Without(const PlacedProblem& problem, std::size_t row) {
  PlacedProblem out = problem;
  const auto at = static_cast<std::ptrdiff_t>(row);
  out.estimation.rows.erase(out.estimation.rows.begin() + at);
  out.observation.erase(out.observation.begin() + at);
  --out.lit;
  return out;
}

// ---- what readings say for an explanation ----

// Whether other light may take up what contradicts.
bool MayTakeOtherLight(const PlacedProblem& problem) {
  return problem.estimation.rules[kPlacedAmbient].free && !problem.ambient_told;
}

PlacedProblem InTheDark(PlacedProblem problem) {
  problem.estimation.rules[kPlacedAmbient] = {};
  return problem;
}

// A lamp stands about the meters and gives about what they read: priors, so that what is open can
// be compared, and a lamp that is dark beside other light has no more room than another.
void AddModes(PlacedProblem problem, const std::vector<PlacedSolution>& near, double share,
              const std::vector<WallHypothesis>& walls, std::vector<PlacedMode>& out) {
  const Layout layout = LayoutOf(problem.estimation.rows);
  for (int k = 0; k < 3; ++k) {
    problem.estimation.rules[kPlacedX + k] = {true, layout.middle[k], kAboutMeters * layout.extent};
  }
  ParameterRule& intensity = problem.estimation.rules[kPlacedLnIntensity];
  if (!(intensity.prior_sd > 0.0)) {
    intensity = {true, kLnIntensity_sd + 2.0 * std::log(layout.extent), kLnIntensity_sd};
  }
  std::vector<PlacedTheta> starts;
  for (const PlacedSolution& one : near) {
    if (one.chi_squared > near.front().chi_squared + kHopeless) break;
    starts.push_back(one.theta);
    if (!problem.estimation.rules[kPlacedAmbient].free) {
      starts.back()[kPlacedAmbient] = problem.ambient_start;
    }
  }
  const std::vector<PlacedSolution> solutions = SolveFrom(problem.estimation, starts);
  if (solutions.empty()) return;
  for (PossiblePlace& place : PossiblePlaces(problem, solutions, walls)) {
    for (PlacedMode& mode : place.modes) {
      mode.ln_probability += std::log(share);
      out.push_back(std::move(mode));
    }
  }
}

// With other light and without, even and not, each from the solutions that it has.
std::vector<PlacedMode> ModesOf(const PlacedProblem& problem,
                                const std::vector<PlacedSolution>& near,
                                const std::vector<WallHypothesis>& walls) {
  std::vector<PlacedMode> out;
  double rest = 1.0;
  if (MayTakeOtherLight(problem)) {
    const bool outdoors = problem.estimation.rules[kPlacedLnWalls].free;
    const double share = outdoors ? kOtherLightOutdoors : kOtherLight;
    AddModes(problem, near, share, walls, out);
    rest -= share;
  }
  const PlacedProblem dark = MayTakeOtherLight(problem) ? InTheDark(problem) : problem;
  if (!dark.estimation.aim && !dark.estimation.rules[kPlacedGradientX].free) {
    LightDescription bulb;
    bulb.kind = LightKind::kPoint;
    bulb.fixture = Fixture::kBulb;
    // A lamp that nobody called a bulb may shine as unevenly as one (uneven_light.h).
    if (const auto sd = GradientOf(bulb)) {
      PlacedProblem uneven = dark;
      AddGradient(*sd, uneven);
      AddModes(std::move(uneven), near, rest * kUneven, walls, out);
      rest *= 1.0 - kUneven;
    }
  }
  AddModes(dark, near, rest, walls, out);
  return out;
}

// A mode's evidence were every sigma so many times as large.
double LnEvidenceAt(const PlacedMode& mode, double factor) {
  if (factor == 1.0) return mode.ln_probability;
  PlacedEstimation wider = mode.estimation;
  for (PlacedRow& row : wider.rows) {
    row.sigma *= factor;
    row.own_sigma *= factor;
  }
  return mode.ln_probability + LnEvidenceOf(wider, mode.theta) -
         LnEvidenceOf(mode.estimation, mode.theta);
}

// The readings of a mode and one more, where it lies within ten deviations of what they foretell.
std::optional<PlacedMode> WithReading(const PlacedMode& mode, PlacedRow row) {
  constexpr double kFar = 100.0;  // squared
  PlacedEstimation one{{std::move(row)}, mode.estimation.aim};
  if (mode.walls) SetWalls(*mode.walls, one);
  SettleScatter(one, mode.theta);
  PlacedTheta gradient{};
  const double residual = DifferentiateAt(one, 0, mode.theta.data(), gradient.data());
  double spread = 1.0;
  for (int i = 0; i < kPlacedParameters; ++i) {
    for (int j = 0; j < kPlacedParameters; ++j) {
      spread += gradient[i] * gradient[j] * mode.covariance[i * kPlacedParameters + j];
    }
  }
  if (!(residual * residual < kFar * spread)) return std::nullopt;
  PlacedMode out = mode;
  out.estimation.rows.push_back(one.rows.front());
  const auto theta = SolvePlaced(out.estimation, mode.theta);
  if (!theta) return std::nullopt;
  out.theta = *theta;
  out.ln_probability +=
      LnEvidenceOf(out.estimation, *theta) - LnEvidenceOf(mode.estimation, mode.theta);
  return out;
}

double LnOfAll(const std::vector<PlacedMode>& modes) {
  double ln = kImpossible;
  for (const auto& [factor, share] : kUnderstated) {
    for (const PlacedMode& mode : modes) {
      ln = LnSum(ln, std::log(share) + LnEvidenceAt(mode, factor));
    }
  }
  return ln;
}

PlacedRow Corrected(PlacedRow row, const Correction& correction, const PlacedFrame& frame) {
  row.position = (correction.position_m - frame.origin) * (1.0 / frame.length_m);
  row.measured *= correction.lux_factor;
  return row;
}

// ---- the suspects ----

struct Suspect {
  std::size_t row = 0;
  double ln = kImpossible;
  std::string correction;  // that holds most of it
};

// How usual a meter's place is among these, beside their middle: a student's normal in space.
double UsualPlace(const Layout& layout, const Vec3& place) {
  constexpr double kSpread = 1.5;  // in their extents
  const double far = Length(place - layout.middle) / (kSpread * layout.extent);
  return std::pow(1.0 + far * far, -2.0);
}

Suspect Suspected(const PlacedProblem& problem, std::size_t row, const Observation& reading,
                  const std::vector<PlacedMode>& others) {
  constexpr double kMean = 0.4;  // of UsualPlace
  Suspect out{row, std::log(kOtherShare) + kLnOfAnything + LnOfAll(others), {}};
  const PlacedRow& typed = problem.estimation.rows[row];
  if (!IsPlaced(reading) || others.empty()) return out;
  const Layout layout = LayoutOf(others.front().estimation.rows);
  const double as_typed = UsualPlace(layout, *typed.position);
  out.ln += std::log(kMean / as_typed);
  double likeliest = kImpossible;
  for (const Correction& correction : CorrectionsOf(reading)) {
    const PlacedRow corrected = Corrected(typed, correction, problem.frame);
    std::vector<PlacedMode> all;
    for (const PlacedMode& mode : others) {
      if (auto with = WithReading(mode, corrected)) all.push_back(*std::move(with));
    }
    const double usual = UsualPlace(layout, *corrected.position) / as_typed;
    const double ln = std::log(correction.share * usual) + LnOfAll(all);
    out.ln = LnSum(out.ln, ln);
    if (ln > likeliest) {
      likeliest = ln;
      out.correction = correction.text;
    }
  }
  if (likeliest < out.ln - std::log(2.0)) out.correction.clear();
  return out;
}

bool MayBeMistaken(const PlacedRow& row) {
  return row.direct_gain > 0.0 && row.form == RowForm::kLog;
}

// Those without which the others agree best, the likeliest first.
std::vector<Suspect> SuspectsOf(const Kept& kept, const Observations& observations,
                                const std::vector<WallHypothesis>& walls) {
  struct Rest {
    std::size_t row;
    PlacedProblem problem;
    std::vector<PlacedSolution> solutions;
  };
  std::vector<Rest> rests;
  double least = std::numeric_limits<double>::infinity();
  const std::vector<PlacedRow>& rows = kept.problem.estimation.rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!MayBeMistaken(rows[i])) continue;
    Rest rest{i, Without(kept.problem, i), {}};
    rest.solutions = SearchPlace(rest.problem);
    if (rest.solutions.empty()) continue;
    least = std::min(least, rest.solutions.front().chi_squared);
    rests.push_back(std::move(rest));
  }
  const auto each = static_cast<double>(std::ranges::count_if(rows, MayBeMistaken));
  std::vector<Suspect> out;
  for (const Rest& rest : rests) {
    if (rest.solutions.front().chi_squared > least + kHopeless) continue;
    const auto at = static_cast<std::size_t>(kept.problem.observation[rest.row]);
    out.push_back(Suspected(kept.problem, rest.row, observations.rows[at],
                            ModesOf(rest.problem, rest.solutions, walls)));
    out.back().ln += std::log(kMistaken / each);
  }
  std::ranges::stable_sort(out, std::ranges::greater(), &Suspect::ln);
  return out;
}

// ---- what is said ----

std::string ReadingText(const Observation& o) {
  std::string text = "reading " + std::to_string(o.index) + " (" + RoundedText(o.raw_lx, 4) + " lx";
  if (!o.position_m) return text + ")";
  const auto coordinate = [&](std::size_t k) {
    return ShortestText(std::round(1000.0 * (*o.position_m)[k]) / 1000.0);
  };
  return text + " at [" + coordinate(0) + ", " + coordinate(1) + ", " + coordinate(2) + "])";
}

tl::unexpected<Error> RefuseMistake(const Kept& kept, std::span<const Suspect> named,
                                    const Observations& observations, const std::string& light) {
  const auto reading = [&](const Suspect& one) {
    const auto at = static_cast<std::size_t>(kept.problem.observation[one.row]);
    return ReadingText(observations.rows[at]) +
           (one.correction.empty() ? "" : " (" + one.correction + " would agree)");
  };
  std::string text;
  if (named.empty()) {
    text =
        "the readings contradict one another, and too few are right to tell which is wrong: check "
        "how each place, normal and lux value was written down, or read two places more";
  } else if (named.size() == 1) {
    text =
        reading(named.front()) +
        " contradicts the others: check how its place, its normal and its lux value were written "
        "down, or read there again";
  } else {
    for (std::size_t i = 0; i < named.size(); ++i) {
      text += (i == 0 ? "" : i + 1 < named.size() ? ", " : " or ") + reading(named[i]);
    }
    text +=
        " contradicts the others, and they cannot tell which: check how these places and lux "
        "values were written down, or read there again";
  }
  if (MayTakeOtherLight(kept.problem))
    text += "; if other light shines, read once with the lamp off";
  return Refused("model_misfit", light, "no lamp gives these readings: " + text);
}

bool ContradictEachOther(const Kept& kept) {
  const bool open = MayTakeOtherLight(kept.problem);
  const PlacedProblem asked = open ? InTheDark(kept.problem) : kept.problem;
  const std::vector<PlacedSolution> solutions = open ? SearchPlace(asked) : kept.solutions;
  const int dof = DegreesOfFreedom(asked.estimation);
  return dof >= 1 &&
         (solutions.empty() || ChiSquaredTail(solutions.front().chi_squared, dof) < kThoughtOf);
}

}  // namespace

Kept WithoutThese(Kept kept, const std::vector<LeftOut>& left_out) {
  for (const LeftOut& one : left_out) {
    const auto row = std::ranges::find(kept.problem.observation, one.observation);
    if (row == kept.problem.observation.end()) continue;
    const auto at = static_cast<std::size_t>(row - kept.problem.observation.begin());
    kept.problem = Without(kept.problem, at);
    kept.rejected.push_back(one);
  }
  return kept;
}

int DegreesOfFreedom(const PlacedEstimation& estimation) {
  const auto rows = std::ranges::count_if(
      estimation.rows, [](const PlacedRow& row) { return row.form != RowForm::kCensored; });
  return static_cast<int>(rows) - FreeParameters(estimation) +
         (estimation.rules[kPlacedAmbient].prior_sd > 0.0 ? 1 : 0) +
         (estimation.rules[kPlacedOffset].free ? 1 : 0);
}

Result<bool> LeaveMistakeOut(Kept& kept, const Observations& observations,
                             const std::vector<WallHypothesis>& walls, const std::string& light) {
  if (!ContradictEachOther(kept)) return false;
  const std::vector<Suspect> suspects = SuspectsOf(kept, observations, walls);
  const double none =
      std::log1p(-kMistaken) + LnOfAll(ModesOf(kept.problem, kept.solutions, walls));
  double all = none;
  for (const Suspect& one : suspects) all = LnSum(all, one.ln);
  if (suspects.empty() || none - all >= std::log(kAsRead)) return false;
  const auto held_by = [&](std::size_t count) {
    double part = 0.0;
    for (std::size_t i = 0; i < count; ++i) part += std::exp(suspects[i].ln - all);
    return part;
  };
  const PlacedEstimation& estimation = kept.problem.estimation;
  // What an uneven lamp may take up is no proof that the rest agree.
  const int taken_up = estimation.rules[kPlacedGradientX].free ? 3 : 0;
  const Suspect& first = suspects.front();
  if (DegreesOfFreedom(estimation) - taken_up >= 2 && held_by(1) > kSure / (kSure + 1.0)) {
    Kept rest{Without(kept.problem, first.row), {}, kept.rejected};
    rest.solutions = SearchPlace(rest.problem);
    const int dof = std::max(1, DegreesOfFreedom(rest.problem.estimation));
    if (!rest.solutions.empty() && rest.solutions.front().chi_squared <= ChiSquared95(dof)) {
      rest.rejected.push_back({kept.problem.observation[first.row], first.correction});
      kept = std::move(rest);
      return true;
    }
  }
  std::size_t count = 1;
  while (count < suspects.size() && held_by(count) < kClear / (kClear + 1.0)) ++count;
  const bool few = count <= kMostNamed && held_by(count) >= kClear / (kClear + 1.0);
  if (!few && kept.solutions.empty()) return false;  // no place at all says more
  return RefuseMistake(kept, std::span(suspects).first(few ? count : 0), observations, light);
}

}  // namespace lightcal::fit
