// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/estimate_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/fit/model/parameter.h"
#include "lightcal/fit/model/prepare.h"
#include "lightcal/fit/model/robust.h"
#include "lightcal/fit/model/starts.h"

namespace lightcal::fit {
namespace {

constexpr double kPriorConflict = 2.0;  // prior standard deviations
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

Result<RobustEstimate> EstimateWidening(Prepared& prepared, const std::string& light,
                                        Warnings& warnings) {
  Result<RobustEstimate> estimate = EstimateRobustly(prepared.estimation);
  ParameterRule& rule = prepared.estimation.rules[kDistanceOffset];
  if (!estimate || !rule.free) return estimate;
  if (estimate->bimodal) {
    // Two camps among four readings say nothing of offset and ambient light, however hard they
    // pull.
    rule.free = false;
    if (!prepared.ambient_told) prepared.estimation.rules[kAmbient] = {};
    return EstimateRobustly(prepared.estimation);
  }
  const double pull = std::abs(estimate->theta[kDistanceOffset]) / rule.prior_sd;
  if (pull <= kPriorConflict) return estimate;
  const double stated = rule.prior_sd;
  rule.prior_sd = 100.0 * stated;
  Result<RobustEstimate> unguided = EstimateRobustly(prepared.estimation);
  if (!unguided) return unguided;
  rule.prior_sd = std::clamp(std::abs(unguided->theta[kDistanceOffset]), kPriorConflict * stated,
                             100.0 * stated);
  warnings.push_back(
      {"prior_conflict", light,
       "the readings ask for a distance offset of " +
           RoundedText(unguided->theta[kDistanceOffset] * prepared.scales.length_m, 3) +
           " m, more than two standard deviations of its prior (" +
           RoundedText(stated * prepared.scales.length_m, 3) +
           " m); the prior was widened: check the distances and the lamp's reference point"});
  return EstimateRobustly(prepared.estimation);
}

std::string Plural(int n, const std::string& what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

void WarnOfRows(const RobustEstimate& estimate, const Prepared& prepared,
                const Observations& observations, const std::string& light, Warnings& warnings) {
  const auto describe = [&](int row) {
    const Observation& o = observations.rows[prepared.observation[row]];
    return "reading " + std::to_string(o.index) + " (" + RoundedText(o.measured_lx, 4) + " lx at " +
           RoundedText(o.distance_m, 4) + " m)";
  };
  for (const int row : estimate.rejected) {
    warnings.push_back({"row_rejected", light,
                        describe(row) + " lies beyond 4.7 standard deviations of the others; it "
                                        "carries nothing: read again there"});
  }
  if (estimate.bimodal) {
    warnings.push_back({"bimodal", light,
                        "two of the four readings disagree with the other two; nothing tells which "
                        "are right: read again"});
  }
  for (const int row : estimate.suspicious) {
    warnings.push_back({"suspicious_reading", light,
                        describe(row) + " disagrees with the model; with " +
                            Plural(prepared.lit_rows, "reading") +
                            " none can be rejected: read again"});
  }
}

// chi-squared of the rows alone and the degrees of freedom left.
struct Scatter {
  double chi_squared = 0.0;
  double sum_squared_ln = 0.0;
  int log_rows = 0;
  int rows = 0;
};
Scatter ScatterOf(const Estimation& estimation, const Theta& theta) {
  Scatter out;
  for (const ReadingRow& row : estimation.rows) {
    if (row.form == ReadingRow::Form::kCensored) continue;
    const double r = RowResidual(row, theta);
    out.chi_squared += r * r;
    ++out.rows;
    if (row.form != ReadingRow::Form::kLog) continue;
    out.sum_squared_ln += r * row.sigma * r * row.sigma;
    ++out.log_rows;
  }
  return out;
}

// Which of the parameters the readings decided.
void NameLearned(const Estimation& estimation, const Covariance& covariance, bool distance_law,
                 FitDiagnostics& diagnostics) {
  const auto learned = [&](Parameter k) {
    const ParameterRule& rule = estimation.rules[k];
    if (!rule.free) return false;
    return !(rule.prior_sd > 0.0) ||
           std::sqrt(covariance[k * kParameters + k]) < kLearnedShare * rule.prior_sd;
  };
  diagnostics.learned.emplace_back(distance_law ? "intensity" : "illuminance");
  if (distance_law) {
    (learned(kDistanceOffset) ? diagnostics.learned : diagnostics.prior)
        .emplace_back("distance_offset");
  }
  (learned(kAmbient) ? diagnostics.learned : diagnostics.prior).emplace_back("ambient");
}

void FillDiagnostics(const RobustEstimate& estimate, const Prepared& prepared,
                     const Observations& observations, LightEstimate& out) {
  FitDiagnostics& d = out.diagnostics;
  d.readings = observations.readings;
  d.used = static_cast<int>(estimate.kept.rows.size() + observations.shadow_used.size());
  d.rejected = observations.rejected;
  for (const int row : estimate.rejected) {
    d.rejected.push_back(observations.rows[prepared.observation[row]].index);
  }
  std::sort(d.rejected.begin(), d.rejected.end());
  const Scatter scatter = ScatterOf(estimate.kept, estimate.theta);
  d.degrees_of_freedom = std::max(0, scatter.rows - static_cast<int>(d.learned.size()));
  if (d.degrees_of_freedom > 0) {
    d.chi2_dof = scatter.chi_squared / d.degrees_of_freedom;
    if (scatter.log_rows > 0) d.rms_relative = std::sqrt(scatter.sum_squared_ln / scatter.log_rows);
    if (estimate.kept.choice.leave_one_out) {
      d.leave_one_out = LeaveOneOut(estimate.kept, estimate.theta);
    }
  }
}

// Scatter that sigma explains in fewer than one of twenty sessions widens every row by the Birge
// ratio sqrt(chi2/dof). Widening by every ratio above 1 would make honest intervals too wide.
double BirgeRatio(const Estimation& estimation, const Theta& theta, int dof) {
  if (dof < 1) return 1.0;
  const double chi_squared = ScatterOf(estimation, theta).chi_squared;
  return chi_squared > ChiSquared95(dof) ? std::sqrt(chi_squared / dof) : 1.0;
}

void FillResiduals(const RobustEstimate& estimate, const Prepared& prepared,
                   const Observations& observations, LightEstimate& out) {
  for (std::size_t i = 0; i < prepared.estimation.rows.size(); ++i) {
    const ReadingRow& row = prepared.estimation.rows[i];
    const Observation& o = observations.rows[prepared.observation[i]];
    if (!o.lit) continue;
    const double predicted =
        RowIlluminance(row, estimate.theta[kLnIntensity], estimate.theta[kDistanceOffset],
                       estimate.theta[kAmbient]) *
        prepared.scales.illuminance_lx;
    ResidualRow residual;
    residual.index = o.index;
    if (o.placed) residual.distance_m = o.distance_m;
    residual.measured_lx = o.measured_lx;
    residual.predicted_lx = predicted;
    residual.relative = o.measured_lx / predicted - 1.0;
    residual.sigma_relative = o.measured_lx > 0.0 ? o.sigma_lx / o.measured_lx : 0.0;
    residual.used = std::find(estimate.rejected.begin(), estimate.rejected.end(),
                              static_cast<int>(i)) == estimate.rejected.end();
    out.residuals.push_back(residual);
  }
}

// From the solver's units to cd, m, lx.
void Unscale(const Scales& scales, LightEstimate& out) {
  out.theta[kLnIntensity] += std::log(scales.illuminance_lx) + 2.0 * std::log(scales.length_m);
  out.theta[kDistanceOffset] *= scales.length_m;
  out.theta[kAmbient] *= scales.illuminance_lx;
  const Theta unit = {1.0, scales.length_m, scales.illuminance_lx};
  for (int i = 0; i < kParameters; ++i) {
    for (int j = 0; j < kParameters; ++j) out.covariance[i * kParameters + j] *= unit[i] * unit[j];
  }
  if (!out.sampled) return;
  const double ln_unit = std::log(scales.illuminance_lx) + 2.0 * std::log(scales.length_m);
  for (int k = 0; k < kParameters; ++k) {
    SampledParameter& p = out.sampled->parameters[k];
    const double shift = k == kLnIntensity ? ln_unit : 0.0;
    p = {p.mean * unit[k] + shift, p.sd * unit[k], p.low * unit[k] + shift,
         p.high * unit[k] + shift};
  }
}

// Weighted linear least squares of I alone, E0 from the lamp-off readings: the only estimate that
// stays meaningful when the lamp cannot be told from nothing.
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
  out.diagnostics.used =
      static_cast<int>(prepared.estimation.rows.size() + observations.shadow_used.size());
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
  if (!(linear.value > 2.0 * linear.sd)) {
    return UpperLimit(prepared, linear, observations, model.distance_law, light);
  }
  LightEstimate out;
  const double condition = HoldUndetermined(prepared);
  Result<RobustEstimate> estimate = EstimateWidening(prepared, light, out.warnings);
  if (!estimate) return Propagate(std::move(estimate));
  WarnOfRows(*estimate, prepared, observations, light, out.warnings);
  WarnOfDetermination(std::isfinite(condition) ? condition : 0.0, *estimate, prepared, light,
                      out.warnings);

  UncertaintyInput input;
  input.estimation = &estimate->kept;
  input.theta = estimate->theta;
  input.considered = model.considered;
  for (Consider& influence : input.considered) {
    influence.relative *= std::pow(prepared.scales.length_m, influence.distance_power);
  }
  Result<Covariance> covariance = EstimateCovariance(input);
  if (!covariance) return Propagate(std::move(covariance));
  NameLearned(estimate->kept, *covariance, model.distance_law, out.diagnostics);
  FillDiagnostics(*estimate, prepared, observations, out);
  const auto& rules = estimate->kept.rules;
  const double kept_condition = ScaledCondition(
      estimate->kept, estimate->theta, {true, rules[kDistanceOffset].free, rules[kAmbient].free});
  if (std::isfinite(kept_condition)) out.diagnostics.condition = kept_condition;
  input.row_scale = BirgeRatio(estimate->kept, estimate->theta, out.diagnostics.degrees_of_freedom);
  if (input.row_scale > 1.0) covariance = EstimateCovariance(input);
  if (!covariance) return Propagate(std::move(covariance));
  if (sampling) {
    Result<SampledEstimate> sampled = SampleEstimate(input, *sampling);
    if (!sampled) return Propagate(std::move(sampled));
    out.sampled = *sampled;
  }

  out.variance_parts = VarianceParts(input);
  out.theta = estimate->theta;
  out.covariance = *covariance;
  out.ambient_free = prepared.estimation.rules[kAmbient].free;
  FillResiduals(*estimate, prepared, observations, out);
  Unscale(prepared.scales, out);
  return out;
}

}  // namespace lightcal::fit
