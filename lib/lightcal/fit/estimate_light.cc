// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/estimate_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/fit/model/candidates.h"
#include "lightcal/fit/model/data_sheet.h"
#include "lightcal/fit/model/misfit.h"
#include "lightcal/fit/model/parameter.h"
#include "lightcal/fit/model/prepare.h"
#include "lightcal/fit/model/robust.h"
#include "lightcal/fit/model/row_reports.h"
#include "lightcal/fit/model/starts.h"
#include "lightcal/fit/model/weighed_candidates.h"

namespace lightcal::fit {
namespace {

constexpr double kConditionFull = 100.0;
constexpr double kConditionPriors = 1000.0;

// Holds parameters at their priors where the readings alone say next to nothing of them.
double HoldUndetermined(Prepared& prepared) {
  auto& rules = prepared.estimation.rules;
  const auto condition = [&] {
    const Theta at = ClosedFormStart(prepared.estimation, 0.0);
    return ScaledCondition(prepared.estimation, at,
                           {true, rules[kDistanceOffset].free, rules[kAmbient].free});
  };
  double k = condition();
  if (k > kConditionPriors && rules[kAmbient].free && !prepared.ambient_told) {
    rules[kAmbient] = {};
    k = condition();
  }
  if (k > kConditionPriors && rules[kDistanceOffset].free) {
    rules[kDistanceOffset].free = false;
    k = condition();
  }
  return k;
}

double LnUnitOfIntensity(const Scales& scales) {
  return std::log(scales.illuminance_lx) + 2.0 * std::log(scales.length_m);
}

// From the solver's units to cd, m, lx.
void Unscale(const Scales& scales, LightEstimate& out) {
  const double ln_unit = LnUnitOfIntensity(scales);
  out.theta[kLnIntensity] += ln_unit;
  out.theta[kDistanceOffset] *= scales.length_m;
  out.theta[kAmbient] *= scales.illuminance_lx;
  const Theta unit = {1.0, scales.length_m, scales.illuminance_lx, 1.0, 1.0, 1.0, 1.0, 1.0};
  for (int i = 0; i < kParameters; ++i) {
    for (int j = 0; j < kParameters; ++j) out.covariance[i * kParameters + j] *= unit[i] * unit[j];
  }
  for (LampInRoom& one : out.in_room) {
    one.ln_intensity += ln_unit;
    one.distance_offset_m *= scales.length_m;
    one.ambient_lx *= scales.illuminance_lx;
    for (int i = 0; i < LampInRoom::kCount; ++i) {
      for (int j = 0; j < LampInRoom::kCount; ++j) {
        one.covariance[i * LampInRoom::kCount + j] *= unit[i] * unit[j];
      }
    }
  }
  for (auto* interval : {&out.ln_interval, &out.ln_by_readings}) {
    if (!*interval) continue;
    (*interval)->low += ln_unit;
    (*interval)->high += ln_unit;
  }
  if (!out.sampled) return;
  for (int k = 0; k < kParameters; ++k) {
    SampledParameter& p = out.sampled->parameters[k];
    const double shift = k == kLnIntensity ? ln_unit : 0.0;
    p = {p.mean * unit[k] + shift, p.sd * unit[k], p.low * unit[k] + shift,
         p.high * unit[k] + shift};
  }
}

// Weighted linear least squares of I alone, E0 from the lamp-off readings: the only estimate that
// stays meaningful when the lamp cannot be told from nothing.
constexpr double kDarkerThanDark = 4.0;  // standard deviations below no light at all
struct LinearIntensity {
  double value = 0.0;
  double sd = std::numeric_limits<double>::infinity();
};
LinearIntensity IntensityAboveAmbient(const Prepared& prepared) {
  double aa = 0.0, ab = 0.0, bb = 0.0, am = 0.0, bm = 0.0;
  for (const ReadingRow& row : prepared.estimation.rows) {
    if (row.form == ReadingRow::Form::kCensored) continue;
    const double sigma = row.form == ReadingRow::Form::kLog ? row.sigma * row.measured : row.sigma;
    const double a = row.direct_gain > 0.0 ? LuxPerCandela(row, 0.0) / sigma : 0.0;
    const double b = prepared.ambient_told ? row.ambient_gain / sigma : 0.0;
    aa += a * a;
    ab += a * b;
    bb += b * b;
    am += a * row.measured / sigma;
    bm += b * row.measured / sigma;
  }
  const double reduced = bb > 0.0 ? aa - ab * ab / bb : aa;
  if (!(reduced > 0.0)) return {};
  return {(bb > 0.0 ? am - ab * bm / bb : am) / reduced, 1.0 / std::sqrt(reduced)};
}

LightEstimate UpperLimit(const Prepared& prepared, const LinearIntensity& intensity,
                         const Observations& observations, bool distance_law,
                         const std::string& light) {
  LightEstimate out;
  const double cd =
      prepared.scales.illuminance_lx * prepared.scales.length_m * prepared.scales.length_m;
  out.upper_limit = cd * (std::max(0.0, intensity.value) + kZ95 * intensity.sd);
  out.diagnostics.readings = observations.readings;
  out.diagnostics.rejected = observations.rejected;
  out.diagnostics.used = prepared.own_rows + static_cast<int>(observations.subtracted.size());
  out.diagnostics.prior = {distance_law ? "intensity" : "illuminance"};
  if (distance_law) out.diagnostics.prior.emplace_back("distance_offset");
  out.diagnostics.prior.emplace_back("ambient");
  out.warnings.push_back({"upper_limit", light,
                          "the lamp's light cannot be told from the rest; only an upper limit is "
                          "given: measure nearer or in the dark"});
  return out;
}

void WarnOfDetermination(double condition, const RobustEstimate& estimate, const Prepared& prepared,
                         const std::string& light, Warnings& warnings) {
  if (condition > kConditionFull) {
    warnings.push_back({"prior_dominated", light,
                        "the distances lie too close together to tell the offset and the ambient "
                        "light; their priors decide: add a distance several times farther"});
  }
  const double d0 = estimate.theta[kDistanceOffset];
  if (prepared.estimation.rules[kDistanceOffset].free &&
      d0 <= prepared.estimation.least_distance_offset * (1.0 - 1e-6)) {
    warnings.push_back(
        {"bound_active", light,
         "the distance offset reached its bound of -0.9 times the shortest distance; "
         "check the distances"});
  }
}

// The part of all that the walls may be that throws back so much of a candela, or more.
double ShareOfRooms(const std::vector<WallHypothesis>& walls, double distance_m,
                    double lux_per_candela) {
  const double x = std::log(distance_m / kWallReference_m);
  double share = 0.0, whole = 0.0;
  for (const WallHypothesis& one : walls) {
    const WallPrior& prior = one.prior;
    const double sd = std::hypot(prior.sd_ln_b, prior.sd_slope * x, prior.scatter);
    const double z = std::log(lux_per_candela / WallsPerCandela(prior, distance_m)) / sd;
    share += one.weight * 0.5 * std::erfc(z / std::numbers::sqrt2);
    whole += one.weight;
  }
  return whole > 0.0 ? share / whole : 1.0;
}

// A card that takes little away, where walls would have to throw back what one room in a thousand
// does, did not shade the meter.
void WarnOfCards(const Candidate& likeliest, const std::vector<WallHypothesis>& walls,
                 const Prepared& prepared, const Observations& observations,
                 const std::string& light, Warnings& warnings) {
  constexpr double kTakesLittle = 0.5;  // of the reading is left behind the card
  constexpr double kNoRoom = 1e-3;
  const Theta& theta = likeliest.estimate.theta;
  const double candela = std::exp(theta[kLnIntensity] + LnUnitOfIntensity(prepared.scales));
  const double ambient_lx = theta[kAmbient] * prepared.scales.illuminance_lx;
  for (const Observation& row : observations.rows) {
    if (!row.lit || !row.differenced || row.card_lx < kTakesLittle * row.raw_lx) continue;
    const double left_lx = LeftByCard_lx(row) - (row.ambient_subtracted ? 0.0 : ambient_lx);
    if (!(left_lx > 0.0)) continue;
    if (ShareOfRooms(walls, row.distance_m, left_lx / candela) >= kNoRoom) continue;
    warnings.push_back({"card_missed", light,
                        "reading " + std::to_string(row.index) + ": behind the card " +
                            RoundedText(row.card_lx, 3) + " of " + RoundedText(row.raw_lx, 3) +
                            " lx were left, more than walls throw back in all but one room of a "
                            "thousand: did the card shade the whole meter? Read it again with the "
                            "meter in the card's shadow"});
    return;
  }
}

// Walls that the readings' fall asks for and no ordinary room has: a distance or a digit may be
// wrong instead.
void WarnOfWalls(const Candidate& likeliest, const std::vector<WallHypothesis>& walls,
                 const Prepared& prepared, const Observations& observations,
                 const std::string& light, Warnings& warnings) {
  constexpr double kFewRooms = 0.01;
  const Theta& theta = likeliest.estimate.theta;
  const ReadingRow* farthest = nullptr;
  std::size_t at = 0;
  for (int i = 0; i < prepared.own_rows; ++i) {
    const ReadingRow& row = likeliest.estimation.rows[static_cast<std::size_t>(i)];
    if (!row.walls || !(row.direct_gain > 0.0)) continue;
    if (farthest != nullptr && !(row.walls->x > farthest->walls->x)) continue;
    farthest = &row;
    at = static_cast<std::size_t>(prepared.observation[static_cast<std::size_t>(i)]);
  }
  if (farthest == nullptr || !likeliest.estimation.rules[kLnWalls].free) return;
  const Observation& told = observations.rows[at];
  const double per_candela = WallsPerCandela(*farthest, theta.data()) /
                             (prepared.scales.length_m * prepared.scales.length_m);
  if (ShareOfRooms(walls, told.distance_m, per_candela) >= kFewRooms) return;
  const double candela = std::exp(theta[kLnIntensity] + LnUnitOfIntensity(prepared.scales));
  warnings.push_back(
      {"walls_implausible", light,
       "by the way the readings fall " + RoundedText(per_candela * candela, 2) + " of the " +
           RoundedText(told.raw_lx, 3) + " lx at " + RoundedText(told.distance_m, 3) +
           " m came off the walls, as in less than one ordinary room of a hundred: look at the "
           "digits and the distances, or read there behind a card too"});
}

// Whether a data sheet that agrees takes more than a twentieth off the readings' interval.
bool TellsMore(const SheetIntensity& sheet, const LightEstimate& read) {
  constexpr double kLeastPart = 1.0 / 3.0;
  return SdOf(read.covariance, kLnIntensity) > kLeastPart * sheet.sd;
}

// The mixture as the lamp's data sheet leaves it. What the readings left open shrinks alike.
void TellBySheet(const SheetIntensity& sheet, const WeighedCandidates& told, LightEstimate& out) {
  constexpr int kOfIntensity = kLnIntensity * kParameters + kLnIntensity;
  const double before = out.covariance[kOfIntensity];
  const double half = kZ95 * std::sqrt(before);
  out.ln_by_readings = out.ln_interval.value_or(
      LnInterval{out.theta[kLnIntensity] - half, out.theta[kLnIntensity] + half});
  std::vector<VariancePart> parts = std::move(out.variance_parts);
  out.variance_parts.clear();
  out.diagnostics.prior.emplace_back("data_sheet");
  out.covariance = told.candidates.front().covariance;
  Mix(told.candidates, told.shares, out);
  out.in_room = InRoom(told.candidates, told.shares);
  const double after = out.covariance[kOfIntensity];
  const double part_left = sheet.sd * sheet.sd / (before + sheet.sd * sheet.sd);
  const double left = told.held * part_left * part_left + (1.0 - told.held);
  double whole = 0.0;
  for (VariancePart& part : parts) whole += part.variance *= left;
  if (after > whole) parts.push_back({"data_sheet", after - whole});
  out.variance_parts = std::move(parts);
}

std::vector<double> WallsBesideObservations(const Candidate& likeliest, const Prepared& prepared,
                                            const Observations& observations) {
  if (!likeliest.estimation.rules[kLnWalls].free) return {};
  std::vector<double> out(observations.rows.size(), 0.0);
  const double square = prepared.scales.length_m * prepared.scales.length_m;
  for (std::size_t i = 0; i < static_cast<std::size_t>(prepared.own_rows); ++i) {
    const ReadingRow& row = likeliest.estimation.rows[i];
    out[static_cast<std::size_t>(prepared.observation[i])] =
        WallsPerCandela(row, likeliest.estimate.theta.data()) / square;
  }
  return out;
}

}  // namespace

Result<LightEstimate> EstimateLight(const Observations& observations, const ForwardModel& model,
                                    const std::string& light,
                                    const std::optional<SamplingRule>& sampling) {
  Prepared prepared = Prepare(observations, model);
  if (prepared.lit_rows == 0) {
    return Refused("no_valid_readings", light,
                   "no reading of the lamp is left; measure illuminance facing it");
  }
  const bool any_in_range =
      std::any_of(observations.rows.begin(), observations.rows.end(),
                  [](const Observation& o) { return o.lit && !o.over_range; });
  if (!any_in_range) {
    return Refused("over_range", light,
                   "every reading was beyond the meter's range: measure from farther away");
  }
  const LinearIntensity linear = IntensityAboveAmbient(prepared);
  if (linear.value < -kDarkerThanDark * linear.sd) {
    return Refused("dark_above_lit", light,
                   "more light was read with the lamp off or behind a card than with it on: were "
                   "the two taken for one another, or did daylight change between them? Read both "
                   "again, one after the other");
  }
  if (!(linear.value > 2.0 * linear.sd)) {
    return UpperLimit(prepared, linear, observations, model.distance_law, light);
  }
  LightEstimate out;
  const double condition = HoldUndetermined(prepared);
  Result<std::vector<Candidate>> solved =
      SolveCandidates(prepared, model, observations, light, out.warnings);
  if (!solved) return Propagate(std::move(solved));
  std::vector<Candidate>& candidates = *solved;
  if (model.distance_law && model.judge_misfit && model.choice.reject) {
    const Candidate& first = candidates.front();
    if (auto fits = CheckMisfit(first.estimate, first.estimation, prepared, observations, light,
                                out.warnings);
        !fits) {
      return Propagate(std::move(fits));
    }
  }
  WarnOfCards(candidates.front(), model.walls, prepared, observations, light, out.warnings);
  WarnOfWalls(candidates.front(), model.walls, prepared, observations, light, out.warnings);
  KeepComparable(candidates);
  const std::vector<double> shares = SharesOf(candidates);
  Candidate& likeliest = candidates.front();
  const RobustEstimate& estimate = likeliest.estimate;
  WarnOfRows(estimate, prepared, observations, light, out.warnings);
  WarnOfDetermination(std::isfinite(condition) ? condition : 0.0, estimate, prepared, light,
                      out.warnings);

  UncertaintyInput input;
  input.estimation = &estimate.kept;
  input.theta = estimate.theta;
  input.considered = model.considered;
  for (Consider& influence : input.considered) {
    influence.relative *= std::pow(prepared.scales.length_m, influence.distance_power);
  }
  Result<Covariance> covariance = EstimateCovariance(input);
  if (!covariance) return Propagate(std::move(covariance));
  NameLearned(estimate.kept, *covariance, model.distance_law, out.diagnostics);
  FillDiagnostics(estimate, prepared, observations, out);
  const auto& rules = estimate.kept.rules;
  const double kept_condition = ScaledCondition(
      estimate.kept, estimate.theta, {true, rules[kDistanceOffset].free, rules[kAmbient].free});
  if (std::isfinite(kept_condition)) out.diagnostics.condition = kept_condition;
  input.row_scale = BirgeRatio(estimate.kept, estimate.theta, out.diagnostics.degrees_of_freedom);
  for (Candidate& one : candidates) {
    UncertaintyInput of_one = input;
    of_one.estimation = &one.estimate.kept;
    of_one.theta = one.estimate.theta;
    covariance = EstimateCovariance(of_one);
    if (!covariance) return Propagate(std::move(covariance));
    one.covariance = *covariance;
  }
  // A card that missed the meter is cause enough.
  const bool card_missed =
      std::ranges::find(out.warnings, "card_missed", &Warning::code) != out.warnings.end();
  if (model.distance_law && model.judge_misfit && model.choice.reject && !card_missed) {
    const FoundOffset found{estimate.theta[kDistanceOffset] * prepared.scales.length_m,
                            SdOf(likeliest.covariance, kDistanceOffset) * prepared.scales.length_m};
    if (auto starts =
            CheckOffset(found, model, prepared.distances, observations, light, out.warnings);
        !starts) {
      return Propagate(std::move(starts));
    }
  }
  if (sampling) {
    Result<SampledEstimate> sampled = SampleEstimate(input, *sampling);
    if (!sampled) return Propagate(std::move(sampled));
    out.sampled = *sampled;
  }

  out.variance_parts = VarianceParts(input);
  out.theta = estimate.theta;
  out.covariance = likeliest.covariance;
  if (candidates.size() > 1) Mix(candidates, shares, out);
  out.in_room = InRoom(candidates, shares);
  std::optional<SheetIntensity> sheet = model.sheet;
  if (sheet) sheet->ln_cd -= LnUnitOfIntensity(prepared.scales);
  std::optional<WeighedCandidates> told;
  if (sheet && Agrees(*sheet, out.theta[kLnIntensity], SdOf(out.covariance, kLnIntensity))) {
    told = WithSheet(*sheet, candidates, shares);
    out.sheet_held = told->held;
  }
  if (told && TellsMore(*sheet, out)) {
    TellBySheet(*sheet, *told, out);
  } else if (out.sampled && out.ln_interval) {
    // What sampling found of the likeliest, on the mixture's ends.
    const SampledParameter& ln = out.sampled->parameters[kLnIntensity];
    const double half = kZ95 * std::sqrt(likeliest.covariance[kLnIntensity]);
    out.ln_interval->low += ln.low - (estimate.theta[kLnIntensity] - half);
    out.ln_interval->high += ln.high - (estimate.theta[kLnIntensity] + half);
  }
  out.ambient_free = prepared.estimation.rules[kAmbient].free;
  out.walls_per_candela = WallsBesideObservations(likeliest, prepared, observations);
  FillResiduals(estimate, likeliest.estimation, prepared, observations, out);
  Unscale(prepared.scales, out);
  return out;
}

Result<void> CheckKnown(const LightEstimate& estimate, const std::string& light) {
  // Such an interval says nothing, and its ends overflow.
  constexpr double kMostSdOfLn = 3.5;
  const bool holds = estimate.upper_limit ? std::isfinite(*estimate.upper_limit)
                                          : std::isnormal(std::exp(estimate.theta[kLnIntensity]));
  if (!holds) {
    return Refused("out_of_range", light,
                   "illuminance and distance give an intensity that no number can hold; check "
                   "their units");
  }
  if (estimate.upper_limit) return {};
  if (SdOf(estimate.covariance, kLnIntensity) < kMostSdOfLn) return {};
  return Refused("underdetermined", light,
                 "the readings leave its strength open by more than a factor of 1000 each way: at "
                 "such distances an error of a centimetre decides; measure from farther away");
}

}  // namespace lightcal::fit
