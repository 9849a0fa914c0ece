// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/beam/beam_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units.h"
#include "lightcal/fit/beam/beam_profile.h"
#include "lightcal/fit/beam/beam_rows.h"
#include "lightcal/fit/beam/known_beam.h"
#include "lightcal/fit/beam/rough_beam.h"
#include "lightcal/fit/beam/spot_beam.h"
#include "lightcal/fit/model/misfit.h"

namespace lightcal::fit {
namespace {

constexpr double kLeastSpan = 5.0 * kRadiansPerDegree;
constexpr double kFarFromAxis = 10.0 * kRadiansPerDegree;
constexpr double kDarkEnd = 1e-3;  // of the peak: where a table ends
constexpr double kUnlikely = 1e-5;
constexpr double kHardlyEven = 0.01;
constexpr double kConeStands = 0.05;  // a spot's cone, until the readings are as much against it

Result<IntensityTable> TableOfProfile(const BeamProfile& profile, const std::string& light) {
  IntensityGrid grid;
  grid.horizontal_deg = {0.0};
  const double peak = *std::ranges::max_element(profile.candela);
  std::size_t last = profile.candela.size() - 1;
  while (last > 2 && profile.candela[last] < kDarkEnd * peak) --last;
  last = std::min(last + 1, profile.candela.size() - 1);
  for (std::size_t i = 0; i <= last; ++i) {
    grid.vertical_deg.push_back(profile.gamma_deg[i]);
    grid.candela.push_back(std::max(0.0, profile.candela[i]));
  }
  return IntensityTable::Make(std::move(grid), light);
}

// Of the variance of ln I(0): what is left of it where those of profile.theta are known.
double VarianceShare(const BeamProfile& profile, std::vector<Eigen::Index> known) {
  const Eigen::Map<const Eigen::Matrix4d> whole(profile.whole.covariance.data());
  std::erase_if(known, [&](Eigen::Index k) { return !(whole(k, k) > 0.0); });
  if (known.empty()) return 1.0;
  const Eigen::MatrixXd among = whole(known, known);
  const Eigen::VectorXd with = whole(known, 0);
  const double told = with.dot(among.completeOrthogonalDecomposition().solve(with));
  return std::clamp(1.0 - told / whole(0, 0), 0.0, 1.0);
}

// As VarianceParts of the other fits: what the variance gains as each is let in.
void AddParts(const BeamProfile& profile, LightEstimate& out) {
  constexpr Eigen::Index kOffset = 1;
  constexpr Eigen::Index kWalls = 2;
  constexpr Eigen::Index kSlope = 3;
  const double whole = out.covariance[0];
  const double with_offset = VarianceShare(profile, {kWalls, kSlope});
  const double readings = std::min(with_offset, VarianceShare(profile, {kOffset, kWalls, kSlope}));
  out.variance_parts.push_back({"readings", readings * whole});
  out.variance_parts.push_back({"distance_offset", (with_offset - readings) * whole});
  if (with_offset < 1.0) out.variance_parts.push_back({"room_bounce", (1.0 - with_offset) * whole});
}

void AddInfluences(const ForwardModel& model, const BeamRows& rows, LightEstimate& out) {
  double ln = 0.0;
  int count = 0;
  for (const BeamRow& row : rows.readings.rows) {
    if (!row.lit) continue;
    ln += 0.5 * std::log(Dot(row.from_lamp, row.from_lamp));
    ++count;
  }
  const double distance = std::exp(ln / std::max(1, count));
  for (const Consider& influence : model.considered) {
    const double sd = influence.relative * std::pow(distance, influence.distance_power);
    out.variance_parts.push_back({influence.name, sd * sd});
    out.covariance[0] += sd * sd;
  }
}

// What a row's direct light would be at the peak of the beam, the meter facing the lamp.
double FacingDirect(const BeamRow& row, const BeamProfile& profile, double peak_cd) {
  const Vec3 aim{profile.aim[0], profile.aim[1], 1.0};
  const Vec3 from = row.from_lamp + aim * (profile.whole.theta[1] / Length(aim));
  return peak_cd / Dot(from, from);
}

// On its axis, among its walls if any shine.
LampInRoom InRoom(const BeamMoments& part, const std::optional<WallPrior>& walls,
                  double ambient_lx) {
  LampInRoom one;
  one.weight = part.share;
  one.ln_intensity = part.theta[0];
  one.distance_offset_m = part.theta[1];
  one.ambient_lx = ambient_lx;
  if (walls) {
    one.ln_b = part.theta[2];
    one.slope = part.theta[3];
    one.bend = walls->bend;
    one.scatter = walls->scatter;
  }
  constexpr std::array<std::size_t, 4> kPlaces = {0, 1, 3, 4};  // of (ln I, d0, E0, ln b, slope)
  for (std::size_t i = 0; i < kPlaces.size(); ++i) {
    for (std::size_t j = 0; j < kPlaces.size(); ++j) {
      one.covariance[kPlaces[i] * LampInRoom::kCount + kPlaces[j]] =
          part.covariance[i * kPlaces.size() + j];
    }
  }
  return one;
}

// Of the peak, as skew as that of the axis and as much wider as the peak is less sure.
LnInterval IntervalOfPeak(const Uncertain& axial, double ln_peak, double wider) {
  return {ln_peak - wider * std::log(axial.value / *axial.low),
          ln_peak + wider * std::log(*axial.high / axial.value)};
}

void FillEstimate(const Observations& observations, const BeamRows& rows,
                  const BeamProfile& profile, LightEstimate& out) {
  constexpr std::array<int, 4> kPlaces = {kLnIntensity, kDistanceOffset, kLnWalls, kWallsSlope};
  for (std::size_t i = 0; i < kPlaces.size(); ++i) {
    out.theta[static_cast<std::size_t>(kPlaces[i])] = profile.whole.theta[i];
    for (std::size_t j = 0; j < kPlaces.size(); ++j) {
      out.covariance[static_cast<std::size_t>(kPlaces[i] * kParameters + kPlaces[j])] =
          profile.whole.covariance[i * kPlaces.size() + j];
    }
  }
  const auto most = std::ranges::max_element(profile.candela);
  const auto peak = static_cast<std::size_t>(most - profile.candela.begin());
  const double sd = peak == 0 ? profile.axial_sd_ln : profile.candela_sd[peak] / *most;
  out.theta[kLnIntensity] = std::log(*most);
  out.covariance[0] = sd * sd;
  out.ln_interval =
      IntervalOfPeak(profile.axial_cd, out.theta[kLnIntensity], sd / profile.axial_sd_ln);
  out.theta[kAmbient] = AmbientOfOff(observations);
  // Without walls one normal needs no list.
  if (rows.readings.walls || profile.by_offset.size() > 1) {
    for (const BeamMoments& part : profile.by_offset) {
      out.in_room.push_back(InRoom(part, rows.readings.walls, out.theta[kAmbient]));
    }
  }

  FitDiagnostics& d = out.diagnostics;
  d.readings = observations.readings;
  d.rejected = observations.rejected;
  d.used = static_cast<int>(observations.subtracted.size());
  d.learned = {"intensity", "beam"};
  d.prior = {};
  const double offset_sd = std::sqrt(std::max(0.0, profile.whole.covariance[5]));
  const bool offset_learned = !rows.readings.offsets.empty() &&
                              offset_sd < kLearnedShare * MatchedOffset(rows.readings.offsets).sd_m;
  (offset_learned ? d.learned : d.prior).emplace_back("distance_offset");
  if (rows.readings.walls) {
    const bool learned = std::sqrt(std::max(0.0, profile.whole.covariance[10])) <
                         kLearnedShare * rows.readings.walls->sd_ln_b;
    (learned ? d.learned : d.prior).emplace_back("room_bounce");
  }
  double squares = 0.0;
  int lit = 0;
  out.walls_per_candela.assign(observations.rows.size(), 0.0);
  for (std::size_t i = 0; i < rows.readings.rows.size(); ++i) {
    const BeamRow& row = rows.readings.rows[i];
    if (!row.lit) continue;
    const Observation& o = observations.rows[rows.observation[i]];
    ResidualRow residual;
    residual.index = o.index;
    residual.distance_m = o.distance_m;
    residual.measured_lx = o.measured_lx;
    residual.predicted_lx = profile.predicted_lx[i] + (o.measured_lx - row.measured);
    if (row.normal || row.gain != 1.0 || o.position_m || o.off_axis_rad != 0.0) {
      residual.facing_lx = residual.predicted_lx - (profile.predicted_lx[i] - profile.walls_lx[i]) +
                           FacingDirect(row, profile, *most);
    }
    const double ratio = row.measured / std::max(profile.predicted_lx[i], 1e-300);
    residual.relative = ratio - 1.0;
    residual.sigma_relative = o.measured_lx > 0.0 ? o.sigma_lx / o.measured_lx : 0.0;
    out.residuals.push_back(residual);
    out.walls_per_candela[rows.observation[i]] = profile.walls_lx[i] / *most;
    ++d.used;
    if (row.form != RowForm::kLog) continue;
    squares += (ratio - 1.0) * (ratio - 1.0);
    ++lit;
  }
  d.degrees_of_freedom = static_cast<int>(profile.degrees_of_freedom);
  if (d.degrees_of_freedom <= 0) return;
  d.chi2_dof = profile.chi2 / profile.degrees_of_freedom;
  if (lit > 0) d.rms_relative = std::sqrt(squares / lit);
}

}  // namespace

bool NeedsProfile(const Observations& observations, const LightDescription& light) {
  const bool spot = light.kind == LightKind::kSpot;
  if ((!spot && light.kind != LightKind::kPoint) || light.outer || light.distribution) return false;
  const auto stated = [](const Observation& o) { return o.lit && o.off_axis_rad != 0.0; };
  if (std::ranges::any_of(observations.rows, stated)) return true;
  if (!light.position_m) return false;
  const auto placed = std::ranges::count_if(observations.rows, LitAndPlaced);
  if (!light.aim) return placed >= kFewestForBeam;
  double widest = 0.0;
  for (const Observation& o : observations.rows) {
    if (!LitAndPlaced(o)) continue;
    const Vec3 from = *o.position_m - *light.position_m;
    widest =
        std::max(widest, std::acos(std::clamp(Dot(from, *light.aim) / Length(from), -1.0, 1.0)));
  }
  return placed >= 2 && widest > (spot ? 0.0 : kLeastSpan);
}

Radians RoughBeam(const Observations& observations, const LightDescription& light) {
  if (light.beam) return *light.beam;
  return Radians(2.0 * RoughHalfAngle(RowsOfBeam(observations, light, nullptr).readings.rows));
}

Result<BeamLight> FitBeamLight(const Observations& observations, const LightDescription& light,
                               const ForwardModel& model) {
  BeamRows rows = RowsOfBeam(observations, light, &model);
  Result<BeamProfile> fitted = FitBeamProfile(rows.readings, light.name);
  if (!fitted) {
    const std::vector<RoughPoint> curve = RoughCurve(rows.readings.rows);
    if (!curve.empty() && curve.front().gamma > kFarFromAxis) {
      return NothingNearAxis(curve.front().gamma, std::nullopt, light.name);
    }
    return Propagate(std::move(fitted));
  }
  BeamProfile& profile = *fitted;
  if (auto known = CheckKnownBeam(rows, profile, light.name); !known) {
    return Propagate(std::move(known));
  }
  auto table = TableOfProfile(profile, light.name);
  if (!table) return Propagate(std::move(table));
  BeamLight out{*std::move(table), {}, {}, {}, {}, Radians(0.0), false, false, false, {}, {}};
  out.even = profile.family == "even";
  double even = 0.0;
  for (const BeamFamilyShare& one : profile.families) {
    if (one.name == "even") even = one.share;
    if (one.name == "cone") out.flat_cone = one.share > kConeStands;
  }
  out.surely_a_beam =
      even < kHardlyEven && (profile.family != "smooth" || profile.monotone_share > 0.5);
  FillEstimate(observations, rows, profile, out.estimate);
  const double birge =
      std::sqrt(std::max(1.0, profile.chi2 / std::max(1.0, profile.degrees_of_freedom)));
  const double dof = profile.degrees_of_freedom;
  const bool contradict = dof > 0.5 && ChiSquaredTail(profile.chi2, dof) < kUnlikely;
  double factor = 1.0;
  if (contradict) {
    if (birge > 5.0 && !out.even) {
      return Refused("beam_unlike", light.name,
                     "the readings lie on no curve about the axis, " + RoundedText(birge, 2) +
                         " times farther off than the meter's own scatter: check {light.aim} and "
                         "the angles, or the beam is not round: photograph it on a wall instead");
    }
    factor = birge;
    out.estimate.warnings.push_back(
        {"beam_uneven", light.name,
         "the readings lie " + RoundedText(birge, 2) +
             " times farther off any curve about the axis than the meter scatters; the intervals "
             "are wider by that: check the aim, or the beam is not round"});
  }
  for (double& c : out.estimate.covariance) c *= factor * factor;
  for (LampInRoom& one : out.estimate.in_room) {
    for (double& c : one.covariance) c *= factor * factor;
  }
  const std::size_t nodes = out.table.grid().vertical_deg.size();
  for (std::size_t i = 0; i < nodes; ++i) {
    const auto from = profile.pattern_sd.begin() + static_cast<std::ptrdiff_t>(i);
    const bool last = i + 1 == nodes;
    out.pattern_sd.push_back(factor *
                             (last ? *std::max_element(from, profile.pattern_sd.end()) : *from));
  }
  out.gamma_deg = profile.gamma_deg;
  for (const double sd : profile.part_sd) out.part_sd.push_back(factor * sd);
  AddParts(profile, out.estimate);
  const double own = out.estimate.covariance[0];
  AddInfluences(model, rows, out.estimate);
  const double added = std::sqrt(std::max(0.0, out.estimate.covariance[0] - own));
  for (LampInRoom& one : out.estimate.in_room) one.covariance[0] += added * added;
  WidenPeak(factor, added, out.estimate);
  out.flux_lm = profile.flux_lm;
  WidenInLn(out.flux_lm, factor, added);
  out.beam.axial = profile.axial_cd;
  WidenInLn(*out.beam.axial, factor, added);
  if (!out.even) {
    out.beam.beam_deg = profile.beam_deg;
    out.beam.field_deg = profile.field_deg;
    WidenInLn(*out.beam.beam_deg, factor, 0.0);
    WidenInLn(*out.beam.field_deg, factor, 0.0);
  }
  bool smooth = false;
  for (const BeamFamilyShare& one : profile.families) {
    out.beam.families.push_back({one.name, one.share, one.leave_one_out});
    smooth = smooth || one.name == "smooth";
  }
  if (smooth) out.beam.falling_share = profile.monotone_share;
  if (rows.placed) {
    const Vec3 aim = rows.frame.x * profile.aim[0] + rows.frame.y * profile.aim[1] + rows.frame.z;
    out.aim = aim * (1.0 / Length(aim));
    out.aim_sd = Radians(factor * std::max(profile.aim_sd[0], profile.aim_sd[1]));
  }
  return out;
}

void WidenPeak(double factor, double relative_sd, LightEstimate& estimate) {
  LnInterval& ln = *estimate.ln_interval;
  const double middle = estimate.theta[kLnIntensity];
  Uncertain peak{1.0, 0.0, std::exp(ln.low - middle), std::exp(ln.high - middle)};
  WidenInLn(peak, factor, relative_sd);
  ln = {middle + std::log(*peak.low), middle + std::log(*peak.high)};
}

void FillBeamLight(BeamLight&& found, FittedLight& out) {
  out.kind = LightKind::kPhotometric;
  out.flux_lm = found.flux_lm;
  const double relative = 0.5 * (*found.flux_lm.high - *found.flux_lm.low) / found.flux_lm.value;
  out.distribution = MeasuredDistribution{std::move(found.table)};
  out.distribution->pattern_sd = std::move(found.pattern_sd);
  double peak = 0.0;
  if (out.intensity_cd) peak = out.intensity_cd->u95 / out.intensity_cd->value / kZ95;
  out.distribution->budget.push_back({"readings", peak, relative / kZ95});
  out.beam = std::move(found.beam);
  if (!found.aim) return;
  out.aim = found.aim;
  out.aim_u95_deg = kZ95 * DegreesFromRadians(found.aim_sd);
}

}  // namespace lightcal::fit
