// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/locate/locate.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/locate/locate_refusals.h"
#include "lightcal/fit/locate/located_lamp.h"
#include "lightcal/fit/locate/one_mistake.h"
#include "lightcal/fit/locate/placed_modes.h"

namespace lightcal::fit {
namespace {

constexpr double kLargestCondition = 1000.0;
constexpr double kLargestVagueness = 0.5;  // u95 of the position over the nearest distance

// ---- the answer ----

// ResidualRow::facing_lx, in the solver's unit.
std::optional<double> FacingOf(PlacedRow row, const std::optional<Vec3>& aim, double tilt_rad,
                               const PlacedTheta& theta) {
  if (tilt_rad == 0.0 && !(row.position && (row.normal || aim))) return std::nullopt;
  if (row.face) {  // on its axis, as far away
    row.distance = DistanceOf(row, theta.data()) - theta[kPlacedOffset];
    row.position.reset();
  }
  row.normal.reset();
  row.direct_gain = 1.0;
  double lux = 0.0;
  if (!PlacedIlluminance(row, std::nullopt, theta.data(), &lux)) return std::nullopt;
  return lux;
}

void FillResiduals(const Observations& observations, const PlacedProblem& all, const Kept& kept,
                   LightEstimate& out) {
  const PlacedTheta& theta = kept.solutions.front().theta;
  if (kept.problem.estimation.rules[kPlacedLnWalls].free) {
    out.walls_per_candela.assign(observations.rows.size(), 0.0);
  }
  for (std::size_t i = 0; i < all.estimation.rows.size(); ++i) {
    const PlacedRow& row = all.estimation.rows[i];
    const Observation& o = observations.rows[static_cast<std::size_t>(all.observation[i])];
    double predicted = 0.0;
    if (!(row.direct_gain > 0.0) ||
        !PlacedIlluminance(row, all.estimation.aim, theta.data(), &predicted)) {
      continue;
    }
    predicted *= all.frame.lux;
    if (!out.walls_per_candela.empty() && row.walls) {
      out.walls_per_candela[static_cast<std::size_t>(all.observation[i])] =
          WallsPerCandela(row, DistanceOf(row, theta.data()), theta.data()) /
          (all.frame.length_m * all.frame.length_m);
    }
    ResidualRow residual;
    residual.index = o.index;
    residual.distance_m =
        row.position ? Length(*row.position - LampOf(theta)) * all.frame.length_m : o.distance_m;
    residual.measured_lx = o.measured_lx;
    residual.predicted_lx = predicted;
    residual.facing_lx = FacingOf(row, all.estimation.aim, o.tilt_rad, theta);
    if (residual.facing_lx) *residual.facing_lx *= all.frame.lux;
    residual.relative = o.measured_lx / predicted - 1.0;
    residual.sigma_relative = o.measured_lx > 0.0 ? o.sigma_lx / o.measured_lx : 0.0;
    residual.used = std::ranges::find(kept.rejected, all.observation[i], &LeftOut::observation) ==
                    kept.rejected.end();
    out.residuals.push_back(residual);
  }
}

void FillDiagnostics(const Observations& observations, const Kept& kept, double condition,
                     const PlacedCovariance& covariance, FitDiagnostics& d) {
  const PlacedEstimation& estimation = kept.problem.estimation;
  d.readings = observations.readings;
  d.used = static_cast<int>(estimation.rows.size() + observations.subtracted.size()) -
           kept.problem.card_rows;
  d.rejected = observations.rejected;
  for (const LeftOut& one : kept.rejected) {
    d.rejected.push_back(observations.rows[static_cast<std::size_t>(one.observation)].index);
  }
  std::ranges::sort(d.rejected);
  d.condition = condition;
  d.learned = {"intensity", "position"};
  const double ambient_sd =
      std::sqrt(covariance[kPlacedAmbient * kPlacedParameters + kPlacedAmbient]);
  const bool told = estimation.rules[kPlacedAmbient].free &&
                    (!(estimation.rules[kPlacedAmbient].prior_sd > 0.0) ||
                     ambient_sd < kLearnedShare * estimation.rules[kPlacedAmbient].prior_sd);
  (told ? d.learned : d.prior).emplace_back("ambient");
  const ParameterRule& walls = estimation.rules[kPlacedLnWalls];
  if (walls.free) {
    const double sd = std::sqrt(covariance[kPlacedLnWalls * (kPlacedParameters + 1)]);
    (sd < kLearnedShare * walls.prior_sd ? d.learned : d.prior).emplace_back("room_bounce");
  }
  d.degrees_of_freedom = std::max(0, DegreesOfFreedom(estimation));
  if (d.degrees_of_freedom < 1) return;
  const std::vector<double> residuals = PlacedResiduals(estimation, kept.solutions.front().theta);
  double chi_squared = 0.0;
  double ln_squared = 0.0;
  int log_rows = 0;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    chi_squared += residuals[i] * residuals[i];
    if (estimation.rows[i].form != RowForm::kLog) continue;
    ln_squared += std::pow(residuals[i] * estimation.rows[i].sigma, 2.0);
    ++log_rows;
  }
  d.chi2_dof = chi_squared / d.degrees_of_freedom;
  if (log_rows > 0) d.rms_relative = std::sqrt(ln_squared / log_rows);
}

void WarnOfRows(const Observations& observations, const Kept& kept, const std::string& light,
                LightEstimate& out) {
  for (const LeftOut& one : kept.rejected) {
    const Observation& o = observations.rows[static_cast<std::size_t>(one.observation)];
    out.warnings.push_back(
        {"row_rejected", light,
         "reading " + std::to_string(o.index) + " (" + RoundedText(o.measured_lx, 4) +
             " lx) contradicts the place on which all others agree; it carries "
             "nothing: read again there, and check its position" +
             (one.correction.empty() ? "" : " (" + one.correction + " would agree)")});
  }
  const FitDiagnostics& d = out.diagnostics;
  if (d.chi2_dof && *d.chi2_dof * d.degrees_of_freedom > ChiSquared95(d.degrees_of_freedom)) {
    out.warnings.push_back({"suspicious_reading", light,
                            "the readings scatter more about the position found than their sigma "
                            "explains; the interval is widened: check the positions, the normals "
                            "and light from elsewhere"});
  }
}

// From the frame's units to cd, m, lx.
void FillEstimate(const PlacedFrame& frame, const PlacedTheta& theta,
                  const PlacedCovariance& covariance, LampLocation& out) {
  out.position_m = frame.origin + LampOf(theta) * frame.length_m;
  const double square = frame.length_m * frame.length_m;
  const Eigen::Matrix3d block = PositionBlock(covariance);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) out.covariance_m2[i * 3 + j] = block(i, j) * square;
  }
  LightEstimate& estimate = out.estimate;
  estimate.theta = {theta[kPlacedLnIntensity] + std::log(frame.lux * square), 0.0,
                    theta[kPlacedAmbient] * frame.lux};
  const auto entry = [&](int i, int j) { return covariance[i * kPlacedParameters + j]; };
  const auto at = [&](int i, int j) -> double& { return estimate.covariance[i * kParameters + j]; };
  at(kLnIntensity, kLnIntensity) = entry(kPlacedLnIntensity, kPlacedLnIntensity);
  at(kLnIntensity, kAmbient) = at(kAmbient, kLnIntensity) =
      entry(kPlacedLnIntensity, kPlacedAmbient) * frame.lux;
  at(kAmbient, kAmbient) = entry(kPlacedAmbient, kPlacedAmbient) * frame.lux * frame.lux;
}

Result<void> CheckKind(const Observations& observations, const LightDescription& light) {
  const bool flat = light.kind == LightKind::kDisk || light.kind == LightKind::kRect;
  if (!flat && light.kind != LightKind::kPoint && light.kind != LightKind::kSphere) {
    return Refused("position_unknown", light.name,
                   "readings give position_m, but the lamp has none, and the position of a " +
                       std::string(LightKindName(light.kind)) +
                       " cannot be told from them: its beam has a shape of its own. Add position_m "
                       "to its [[light]], or give distance_m in each reading");
  }
  if (flat && !light.aim) {
    return Refused("aim_unknown", light.name,
                   "a flat lamp's position can be found from readings around it when its aim is "
                   "known: add aim = [x, y, z] (a ceiling panel: [0, 0, -1]) or its position_m");
  }
  const auto lit = [](const Observation& o) { return o.lit; };
  if (std::ranges::none_of(observations.rows, lit)) {
    return Refused("no_valid_readings", light.name,
                   "no reading of the lamp is left; measure illuminance facing it");
  }
  if (std::ranges::none_of(observations.rows,
                           [](const Observation& o) { return o.lit && !o.over_range; })) {
    return Refused("over_range", light.name,
                   "every reading was beyond the meter's range: measure from farther away");
  }
  return {};
}

bool HasDistanceRow(const PlacedEstimation& estimation) {
  return std::ranges::any_of(
      estimation.rows, [](const PlacedRow& row) { return row.direct_gain > 0.0 && !row.position; });
}

double NearestMeter(const PlacedEstimation& estimation, const Vec3& lamp) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const PlacedRow& row : estimation.rows) {
    if (row.position && row.direct_gain > 0.0) {
      nearest = std::min(nearest, Length(*row.position - lamp));
    }
  }
  return nearest;
}

bool TooVague(const PlacedEstimation& estimation, const PlacedTheta& theta,
              const PlacedCovariance& covariance) {
  return !(LargestU95(covariance) < kLargestVagueness * NearestMeter(estimation, LampOf(theta)));
}

// What few readings say of ambient light may be too little beside a position: it is 0 then.
void HoldAmbientIfVague(Kept& kept) {
  ParameterRule& ambient = kept.problem.estimation.rules[kPlacedAmbient];
  if (!ambient.free || kept.problem.ambient_told || kept.solutions.empty()) return;
  const PlacedTheta& theta = kept.solutions.front().theta;
  const PlacedEstimation& estimation = kept.problem.estimation;
  const auto covariance = EstimatePlacedCovariance(estimation, theta, {});
  if (covariance && !TooVague(estimation, theta, *covariance) &&
      PlacedCondition(estimation, theta) <= kLargestCondition) {
    return;
  }
  ambient = {};
  kept.solutions = SearchPlace(kept.problem);
}

std::vector<PlacedSolution> SolutionsOf(const std::vector<PossiblePlace>& places) {
  std::vector<PlacedSolution> out;
  for (const PossiblePlace& place : places) {
    const PlacedMode& best = place.modes.front();
    out.push_back({best.theta, PlacedChiSquared(best.estimation, best.theta)});
  }
  return out;
}

Result<MixedPlace> MixedWith(const std::vector<PlacedMode>& modes,
                             const PlacedUncertainty& uncertainty) {
  std::vector<PlacedCovariance> covariances;
  for (const PlacedMode& one : modes) {
    auto covariance = EstimatePlacedCovariance(one.estimation, one.theta, uncertainty);
    if (!covariance) return Propagate(std::move(covariance));
    covariances.push_back(*covariance);
  }
  return MixOf(modes, covariances);
}

// Of ln I: the likeliest's, what its walls and its pattern add to it, and what not knowing where it
// stands among walls adds to all.
std::vector<VariancePart> PartsOf(const std::vector<PlacedMode>& modes,
                                  const PlacedUncertainty& uncertainty, const MixedPlace& mixed) {
  constexpr int kVariance = kPlacedLnIntensity * (kPlacedParameters + 1);
  const PlacedMode& best = modes.front();
  const auto variance = [&](const PlacedEstimation& estimation,
                            const std::vector<Consider>& considered) {
    const auto some = EstimatePlacedCovariance(
        estimation, best.theta, {uncertainty.row_scale, uncertainty.position_sd, considered});
    return some ? (*some)[kVariance] : -1.0;
  };
  std::vector<VariancePart> parts = VarianceParts("readings_and_place", uncertainty.considered,
                                                  [&](const std::vector<Consider>& considered) {
                                                    return variance(best.estimation, considered);
                                                  });
  if (parts.empty()) return parts;
  PlacedEstimation known = best.estimation;
  const auto part_of = [&](const char* name, int first, int last) {
    if (!known.rules[first].free) return;
    for (int k = first; k <= last; ++k) known.rules[k] = {};
    const double whole = parts.front().variance;
    const double held = std::clamp(variance(known, {}), 0.0, whole);
    parts.front().variance = held;
    parts.push_back({name, whole - held});
  };
  part_of("room_bounce", kPlacedLnWalls, kPlacedWallsSlope);
  part_of("uneven_light", kPlacedGradientX, kPlacedGradientZ);
  const double unknown =
      mixed.covariance[kVariance] - variance(best.estimation, uncertainty.considered);
  if (unknown > 0.0) parts.push_back({"room_bounce", unknown});
  return parts;
}

}  // namespace

bool NeedsLocating(const Observations& observations, const LightDescription& light) {
  return !light.position_m && HasDistanceLaw(light.kind) &&
         std::ranges::any_of(observations.rows, IsPlaced);
}

Result<LampLocation> LocateLamp(const Observations& observations, const LightDescription& light,
                                const ForwardModel& model, const LampLocation* near) {
  if (auto kind = CheckKind(observations, light); !kind) return Propagate(std::move(kind));
  const Vec3* near_m = near != nullptr ? &near->position_m : nullptr;
  PlacedProblem all = PlacedProblemOf(observations, light, model, near_m);
  Kept kept{all, {}, {}};
  if (near != nullptr) kept = WithoutThese(std::move(kept), near->left_out);
  kept.solutions = SearchPlace(kept.problem);
  HoldAmbientIfVague(kept);
  // What a circle leaves open takes up any mistake.
  if (near == nullptr && !NearlyOnOneCircle(kept.problem) && all.lit >= kFewestPlacedReadings) {
    for (bool left_out = true; left_out;) {
      const Result<bool> mistake = LeaveMistakeOut(kept, observations, model.walls, light.name);
      if (!mistake) return tl::unexpected(mistake.error());
      left_out = *mistake;
    }
  }
  if (kept.solutions.empty()) {
    return Refused("no_position", light.name,
                   "no place of the lamp explains these readings: check that each normal points "
                   "to the side of the meter that sees the lamp");
  }
  // One reading more frees again the ambient light that was held for want of it.
  const auto refuse_layout = [&] {
    PlacedProblem asked = kept.problem;
    asked.estimation.rules[kPlacedAmbient] = all.estimation.rules[kPlacedAmbient];
    return RefuseLayout(asked, kept.solutions, light.name);
  };
  if (all.lit < kFewestPlacedReadings) return refuse_layout();
  if (OnOneCircleExactly(kept.problem) && !HasDistanceRow(kept.problem.estimation)) {
    return refuse_layout();
  }
  const std::vector<PossiblePlace> places =
      PossiblePlaces(kept.problem, kept.solutions, model.walls);
  if (places.empty()) return refuse_layout();
  const std::vector<PlacedMode>& modes = places.front().modes;
  kept.problem.estimation = modes.front().estimation;
  kept.solutions = SolutionsOf(places);
  const PlacedEstimation& estimation = kept.problem.estimation;
  const double condition = PlacedCondition(estimation, modes.front().theta);
  if (!(condition <= kLargestCondition)) {
    return refuse_layout();
  }
  if (places.size() > 1) return RefuseMirror(kept.problem, kept.solutions, light.name);

  LampLocation out;
  PlacedUncertainty uncertainty;
  uncertainty.considered = model.considered;
  for (Consider& influence : uncertainty.considered) {
    influence.relative *= std::pow(kept.problem.frame.length_m, influence.distance_power);
  }
  FillDiagnostics(observations, kept, condition, modes.front().covariance,
                  out.estimate.diagnostics);
  WarnOfRows(observations, kept, light.name, out.estimate);
  const FitDiagnostics& d = out.estimate.diagnostics;
  if (d.chi2_dof && *d.chi2_dof * d.degrees_of_freedom > ChiSquared95(d.degrees_of_freedom)) {
    uncertainty.row_scale = std::sqrt(*d.chi2_dof);
  }
  auto mixed = MixedWith(modes, uncertainty);
  if (!mixed) return Propagate(std::move(mixed));
  if (TooVague(estimation, mixed->theta, mixed->covariance)) {
    return refuse_layout();
  }
  out.estimate.variance_parts = PartsOf(modes, uncertainty, *mixed);
  out.estimate.ambient_free = estimation.rules[kPlacedAmbient].free;
  out.left_out = kept.rejected;
  FillResiduals(observations, all, kept, out.estimate);
  FillEstimate(kept.problem.frame, mixed->theta, mixed->covariance, out);
  out.known = LocatedLampOf(kept.problem.frame, modes, *mixed);
  return out;
}

Observations PlaceObservations(Observations observations, const Vec3& lamp_m) {
  for (Observation& o : observations.rows) {
    if (!IsPlaced(o)) continue;
    const Vec3 to_lamp = lamp_m - *o.position_m;
    o.distance_m = Length(to_lamp);
    if (o.normal && o.distance_m > 0.0) {
      o.tilt_rad = std::acos(std::clamp(Dot(to_lamp, *o.normal) / o.distance_m, -1.0, 1.0));
    }
  }
  return observations;
}

}  // namespace lightcal::fit
