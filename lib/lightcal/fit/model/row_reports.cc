// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/row_reports.h"

#include <algorithm>
#include <cmath>

#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal::fit {
namespace {

std::string Plural(int n, const std::string& what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
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

// measured/predicted - 1; a finite number too where the model sends no light at all, as beyond the
// edge of a cone.
double RelativeTo(double predicted, double measured) {
  constexpr double kMost = 1e6;
  if (std::abs(predicted) * kMost > std::abs(measured)) return measured / predicted - 1.0;
  return measured == 0.0 ? 0.0 : std::copysign(kMost, measured);
}

// ResidualRow::facing_lx, in the solver's unit.
std::optional<double> FacingOf(ReadingRow row, const Observation& o, const Theta& theta) {
  if (o.tilt_rad == 0.0 && !o.off_axis && o.table_part == 1.0) return std::nullopt;
  constexpr double kAlike = 1e-9;
  const double turned = RowIlluminance(row, theta.data());
  row.off_axis.reset();
  row.by_aim.reset();
  row.direct_gain = 1.0;
  const double facing = RowIlluminance(row, theta.data());
  return std::abs(facing - turned) > kAlike * facing ? std::optional(facing) : std::nullopt;
}

bool ReadAlike(const Observation& a, const Observation& b) {
  return a.distance_m == b.distance_m && a.position_m == b.position_m && a.normal == b.normal &&
         a.tilt_rad == b.tilt_rad && a.off_axis_rad == b.off_axis_rad && a.lit == b.lit &&
         a.behind_card == b.behind_card && a.instrument == b.instrument;
}

// The rows read where `row` was by its meter, itself among them; none where they agree within what
// that meter repeats: then no model is needed to tell what is wrong.
std::vector<const Observation*> Unrepeated(const std::vector<Observation>& rows,
                                           const Observation& row) {
  constexpr double kSigmas = 4.0;
  std::vector<const Observation*> there;
  bool apart = false;
  for (const Observation& other : rows) {
    if (!ReadAlike(row, other)) continue;
    there.push_back(&other);
    apart = apart || std::abs(row.measured_lx - other.measured_lx) >
                         kSigmas * std::hypot(SigmaThere_lx(row), SigmaThere_lx(other));
  }
  if (!apart) there.clear();
  return there;
}

// "60.00", or "160.0 less 100.0" of a difference, which no meter showed.
std::string WhatItShowed(const Observation& row) {
  if (row.measured_lx == row.raw_lx) return RoundedText(row.measured_lx, 4);
  return RoundedText(row.raw_lx, 4) + " less " + RoundedText(row.raw_lx - row.measured_lx, 4);
}

std::string SayUnrepeated(const std::vector<const Observation*>& there) {
  return "at " + RoundedText(there.front()->distance_m, 4) + " m the same meter read " +
         Joined(there, ", ", [](const Observation* o) { return WhatItShowed(*o); }) +
         " lx (readings " +
         Joined(there, ", ", [](const Observation* o) { return std::to_string(o->index); }) +
         "): farther apart than it repeats. The lamp was still warming up, its battery or its "
         "mains "
         "sank, or the head was held otherwise: let it burn ten minutes and read again";
}

}  // namespace

std::optional<std::string> FirstUnrepeated(const Observations& observations) {
  constexpr double kMostOfOneLamp = 1.3;  // that it rises as it warms up
  for (const Observation& one : observations.rows) {
    if (!one.lit) continue;
    const auto there = Unrepeated(observations.rows, one);
    if (there.empty()) continue;
    const auto [least, most] =
        std::ranges::minmax(there, {}, [](const Observation* o) { return o->measured_lx; });
    if (most->measured_lx < kMostOfOneLamp * least->measured_lx) return SayUnrepeated(there);
  }
  return std::nullopt;
}

void WarnOfRows(const RobustEstimate& estimate, const Prepared& prepared,
                const Observations& observations, const std::string& light, Warnings& warnings) {
  const auto describe = [&](int row) {
    const Observation& o = observations.rows[prepared.observation[row]];
    if (row >= prepared.own_rows) {
      return "what was read behind the card at " + RoundedText(o.distance_m, 4) + " m (" +
             RoundedText(o.card_lx, 4) + " lx)";
    }
    return "reading " + std::to_string(o.index) + " (" + RoundedText(o.measured_lx, 4) + " lx at " +
           RoundedText(o.distance_m, 4) + " m)";
  };
  for (const int row : estimate.rejected) {
    const std::string why =
        estimate.offset_of_one_m
            ? " alone asks for a distance offset of " + RoundedText(*estimate.offset_of_one_m, 3) +
                  " m, more than this lamp's; it carries nothing: look at its digits, or read "
                  "again there"
            : " lies beyond 4.7 standard deviations of the others; it carries nothing: read again "
              "there";
    warnings.push_back({"row_rejected", light, describe(row) + why});
  }
  if (estimate.bimodal) {
    warnings.push_back({"bimodal", light,
                        "two of the four readings disagree with the other two; nothing tells which "
                        "are right: read again"});
  }
  std::vector<const Observation*> told;
  const auto tell_unrepeated = [&](const Observation& one) {
    if (std::ranges::find(told, &one) != told.end()) return true;
    const auto there = Unrepeated(observations.rows, one);
    if (there.empty()) return false;
    told.insert(told.end(), there.begin(), there.end());
    warnings.push_back({"suspicious_reading", light, SayUnrepeated(there)});
    return true;
  };
  for (const int row : estimate.suspicious) {
    if (tell_unrepeated(observations.rows[prepared.observation[row]])) continue;
    warnings.push_back({"suspicious_reading", light,
                        describe(row) + " disagrees with the model; with " +
                            Plural(prepared.lit_rows, "reading") +
                            " none can be rejected: read again"});
  }
  // Readings of one place share its distance's error, which their contrast does not have.
  constexpr std::size_t kFew = 12;
  if (!estimate.rejected.empty() || observations.rows.size() > kFew) return;
  for (const Observation& one : observations.rows) {
    if (one.lit && one.by_distance > 0.0) (void)tell_unrepeated(one);
  }
}

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
  if (learned(kAimX) || learned(kAimY)) diagnostics.learned.emplace_back("aim");
  if (learned(kLnScale)) diagnostics.learned.emplace_back("instrument_scale");
  if (std::ranges::any_of(estimation.rows, &ReadingRow::data_sheet)) {
    diagnostics.prior.emplace_back("data_sheet");
  }
  if (!estimation.rules[kLnWalls].free) return;
  (learned(kLnWalls) ? diagnostics.learned : diagnostics.prior).emplace_back("room_bounce");
}

void FillDiagnostics(const RobustEstimate& estimate, const Prepared& prepared,
                     const Observations& observations, LightEstimate& out) {
  FitDiagnostics& d = out.diagnostics;
  d.readings = observations.readings;
  d.used = prepared.own_rows + static_cast<int>(observations.subtracted.size());
  d.rejected = observations.rejected;
  for (const int row : estimate.rejected) {
    if (row >= prepared.own_rows) continue;
    --d.used;
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

double BirgeRatio(const Estimation& estimation, const Theta& theta, int dof) {
  if (dof < 1) return 1.0;
  const double chi_squared = ScatterOf(estimation, theta).chi_squared;
  return chi_squared > ChiSquared95(dof) ? std::sqrt(chi_squared / dof) : 1.0;
}

void FillResiduals(const RobustEstimate& estimate, const Estimation& all, const Prepared& prepared,
                   const Observations& observations, LightEstimate& out) {
  for (std::size_t i = 0; i < all.rows.size(); ++i) {
    const ReadingRow& row = all.rows[i];
    const Observation& o = observations.rows[prepared.observation[i]];
    if (static_cast<int>(i) >= prepared.own_rows || !o.lit) continue;
    const double predicted =
        RowIlluminance(row, estimate.theta.data()) * prepared.scales.illuminance_lx;
    ResidualRow residual;
    residual.index = o.index;
    if (o.placed) residual.distance_m = o.distance_m;
    residual.measured_lx = o.measured_lx;
    residual.predicted_lx = predicted;
    if (row.walls) {
      residual.walls_lx = std::exp(estimate.theta[kLnIntensity]) *
                          WallsPerCandela(row, estimate.theta.data()) *
                          ScaleOfRow(row, estimate.theta.data()) * prepared.scales.illuminance_lx;
    }
    residual.facing_lx = FacingOf(row, o, estimate.theta);
    if (residual.facing_lx) *residual.facing_lx *= prepared.scales.illuminance_lx;
    residual.relative = RelativeTo(predicted, o.measured_lx);
    residual.sigma_relative = o.measured_lx > 0.0 ? o.sigma_lx / o.measured_lx : 0.0;
    residual.used = std::find(estimate.rejected.begin(), estimate.rejected.end(),
                              static_cast<int>(i)) == estimate.rejected.end();
    out.residuals.push_back(residual);
  }
}

}  // namespace lightcal::fit
