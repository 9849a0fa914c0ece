// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/beam/solved_beams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace lightcal::fit {
namespace {

constexpr std::size_t kRefined = 3;   // of each family's starts
constexpr int kRounds = 3;            // of settling what the walls scatter
constexpr double kReach = 1.25;       // nodes beyond the outermost reading
constexpr double kLeastShare = 3e-3;  // of the mixture
constexpr int kFewestForCurve = 4;
constexpr double kDark = 0.01;    // of the peak
constexpr double kHollow = 1.15;  // peak over axis, of a lamp that is brighter beside it
// Standard deviations of the smooth curve's second derivative, over (half angle)^-1.5.
constexpr std::array<double, 4> kBends = {0.6, 1.5, 4.0, 10.0};

using BeamValues = ValuesOf<BeamProblem>;

// ---- one family under one offset ----

void SettleBeam(BeamProblem& problem, const double* p) {
  for (BeamRow& row : problem.rows) {
    if (!row.walls) continue;
    const double scatter = row.walls->scatter * problem.Walls(row, p);
    const double whole = row.form == RowForm::kLinear ? 1.0 : problem.Illuminance(row, p);
    if (whole > 0.0) row.sigma = std::hypot(row.own_sigma, scatter / whole);
  }
}

std::optional<BeamValues> SolveBeam(BeamProblem& problem, BeamValues p) {
  for (int i = 0; i < kRounds; ++i) {
    SettleBeam(problem, p.data());
    const auto found = SolveTiny(problem, p);
    if (!found) return std::nullopt;
    const bool same = i > 0 && std::abs((*found)[kBeamLnIntensity] - p[kBeamLnIntensity]) < 1e-3;
    p = *found;
    if (same || !problem.rules[kBeamLnWalls].free) break;
  }
  return Polish(problem, p);
}

// ln I by weighted mean, all else held.
void StartStrength(const BeamProblem& problem, BeamValues& p) {
  p[kBeamLnIntensity] = 0.0;
  double aa = 0.0;
  double am = 0.0;
  for (const BeamRow& row : problem.rows) {
    const double sigma = row.form == RowForm::kLinear ? row.sigma : row.sigma * row.measured;
    const double a = problem.Illuminance(row, p.data()) / sigma;
    aa += a * a;
    am += a * row.measured / sigma;
  }
  p[kBeamLnIntensity] = aa > 0.0 && am > 0.0 ? std::log(am / aa) : 0.0;
}

std::optional<SolvedBeam> SolveFamily(const BeamReadings& readings, const OffsetPart* offset,
                                      double weight, const BeamShape& shape, double ln_peak,
                                      const std::vector<std::vector<double>>& starts) {
  BeamProblem problem;
  problem.shape = shape;
  problem.rows = readings.rows;
  problem.sheet = readings.sheet;
  const bool smooth = shape.family == BeamFamily::kSmooth;
  problem.rules[kBeamLnIntensity] = {!smooth, smooth ? ln_peak : 0.0, 0.0};
  if (offset != nullptr) problem.rules[kBeamOffset] = {true, offset->mean_m, offset->sd_m};
  problem.rules[kBeamAimX] = readings.aim[0];
  problem.rules[kBeamAimY] = readings.aim[1];
  if (readings.walls) {
    problem.rules[kBeamLnWalls] = {true, readings.walls->ln_b, readings.walls->sd_ln_b};
    problem.rules[kBeamWallsSlope] = {true, readings.walls->slope, readings.walls->sd_slope};
  }
  const auto shape_rules = shape.Rules();
  std::copy(shape_rules.begin(), shape_rules.end(), problem.rules.begin() + kBeamCommon);

  std::vector<std::pair<double, BeamValues>> tried;
  for (const std::vector<double>& of_shape : starts) {
    BeamValues start{};
    for (int k = 0; k < kBeamCommon; ++k) start[k] = problem.rules[k].prior_mean;
    std::copy(of_shape.begin(), of_shape.end(), start.begin() + kBeamCommon);
    if (!smooth) StartStrength(problem, start);
    tried.emplace_back(HalfChiSquaredOf(problem, start), start);
  }
  std::ranges::sort(tried, {}, &std::pair<double, BeamValues>::first);
  tried.resize(std::min(tried.size(), kRefined));
  std::optional<BeamValues> best;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [rough, start] : tried) {
    const auto found = SolveBeam(problem, start);
    if (!found) continue;
    const double half = HalfChiSquaredOf(problem, *found);
    if (!(half < least)) continue;
    least = half;
    best = found;
  }
  if (!best) return std::nullopt;
  SettleBeam(problem, best->data());
  const Linearised<BeamProblem> at = Linearise(problem, *best);
  const auto covariance = CovarianceAt(problem, at);
  if (!covariance || !covariance->allFinite()) return std::nullopt;

  SolvedBeam out;
  out.shape = shape;
  out.smooth = smooth;
  out.theta = Eigen::Map<const Eigen::VectorXd>(best->data(), BeamProblem::kCount);
  out.covariance = *covariance;
  // Free parameters only: the others' rows are zero.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(out.covariance);
  out.root = axes.eigenvectors() * axes.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  out.ln_probability = std::log(weight * (offset != nullptr ? offset->weight : 1.0)) -
                       HalfChiSquaredOf(problem, *best) - shape.LnPriorScale();
  for (const BeamRow& row : problem.rows) {
    out.ln_probability -= std::log(row.sigma);
  }
  const auto triangle = FreeTriangle(problem, at);
  for (int k = 0; k < BeamProblem::kCount; ++k) {
    if (!problem.rules[k].free) continue;
    out.ln_probability -= std::log(std::abs(triangle(k, k)));
    if (problem.rules[k].prior_sd > 0.0) out.ln_probability -= std::log(problem.rules[k].prior_sd);
  }
  if (!std::isfinite(out.ln_probability)) return std::nullopt;

  double squares = 0.0;
  int lit = 0;
  for (std::size_t i = 0; i < problem.rows.size(); ++i) {
    const auto j = at.jacobian.row(static_cast<Eigen::Index>(i));
    const double leverage = std::min(0.999, (j * *covariance * j.transpose())(0, 0));
    const double residual = at.residual[static_cast<Eigen::Index>(i)];
    out.chi2 += residual * residual;
    out.told += leverage;
    if (problem.rows[i].lit) {
      // Over the standard deviation of what the others predict for it.
      squares += residual * residual / (1.0 - leverage);
      ++lit;
    }
    const BeamRow& row = problem.rows[i];
    out.predicted_lx.push_back(problem.Illuminance(row, best->data()));
    out.walls_lx.push_back(problem.Walls(row, best->data()));
    out.gamma_rad.push_back(TowardsOf(row, best->data()).gamma);
  }
  out.ln_axial = out.theta[kBeamLnIntensity];
  out.axial = Eigen::VectorXd::Zero(BeamProblem::kCount);
  out.axial[kBeamLnIntensity] = 1.0;
  if (smooth) {
    const double f = shape.Relative(0.0, best->data() + kBeamCommon);
    out.ln_axial += std::log(f);
    out.axial[kBeamCommon] = -std::expm1(-f / BeamShape::kSoft) / f;
  }
  for (std::size_t i = 0; smooth && i < problem.rows.size(); ++i) {
    const BeamRow& row = problem.rows[i];
    const double candela = row.measured / TowardsOf(row, best->data()).per_candela;
    if (row.lit && candela > kDark * std::exp(ln_peak)) {
      out.outermost = std::max(out.outermost, out.gamma_rad[i]);
    }
  }
  out.leave_one_out = lit > 0 ? std::sqrt(squares / lit) : 0.0;
  return out;
}

// ---- what the readings look like as they stand ----

// Candela that a row asks for, and its angle; the axis as it was stated.
struct RoughPoint {
  double gamma = 0.0, candela = 0.0;
};
std::vector<RoughPoint> RoughCurve(const std::vector<BeamRow>& rows) {
  const std::array<double, kBeamCommon> as_stated{};
  std::vector<RoughPoint> curve;
  for (const BeamRow& row : rows) {
    if (!row.lit) continue;
    const auto towards = TowardsOf(row, as_stated.data());
    if (!(towards.per_candela > 0.0)) continue;
    curve.push_back({towards.gamma, std::max(0.0, row.measured / towards.per_candela)});
  }
  std::ranges::sort(curve, {}, &RoughPoint::gamma);
  return curve;
}

int DistinctAngles(const std::vector<RoughPoint>& curve) {
  constexpr double kApart = 0.5 * std::numbers::pi / 180.0;
  int count = 0;
  double last = -1.0;
  for (const RoughPoint& point : curve) {
    if (point.gamma < last + kApart) continue;
    last = point.gamma;
    ++count;
  }
  return count;
}

double RoughAt(const std::vector<RoughPoint>& curve, double gamma) {
  if (gamma <= curve.front().gamma) return curve.front().candela;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    if (gamma > curve[i].gamma) continue;
    const double span = curve[i].gamma - curve[i - 1].gamma;
    const double t = span > 0.0 ? (gamma - curve[i - 1].gamma) / span : 1.0;
    return curve[i - 1].candela + t * (curve[i].candela - curve[i - 1].candela);
  }
  return -1.0;
}

// Nodes where a curve may turn sharply: of a lamp that is brightest beside its axis (lenses that
// throw light sideways) those between the readings on both sides of the peak, else the axis itself
// (mirrors and lenses before a small source).
std::vector<int> KinksOf(const std::vector<RoughPoint>& curve, const BeamShape& shape) {
  const auto most = std::ranges::max_element(curve, {}, &RoughPoint::candela);
  std::vector<int> nodes;
  if (most + 1 == curve.end()) return nodes;
  if (most->candela < kHollow * curve.front().candela) return {0};
  for (int k = 2; k < BeamShape::kNodes - 1; ++k) {
    const double gamma = shape.scale * std::sinh(k * shape.step);
    if (gamma > (most - 1)->gamma && gamma < (most + 1)->gamma) nodes.push_back(k);
  }
  return nodes;
}

void ShareOut(std::vector<SolvedBeam>& beams) {
  double most = -std::numeric_limits<double>::infinity();
  for (const SolvedBeam& one : beams) most = std::max(most, one.ln_probability);
  double whole = 0.0;
  for (SolvedBeam& one : beams) whole += one.share = std::exp(one.ln_probability - most);
  std::erase_if(beams, [&](const SolvedBeam& one) { return one.share < kLeastShare * whole; });
  whole = 0.0;
  for (const SolvedBeam& one : beams) whole += one.share;
  for (SolvedBeam& one : beams) one.share /= whole;
  std::ranges::stable_sort(beams, std::ranges::greater(), &SolvedBeam::share);
}

}  // namespace

double RoughHalfAngle(const std::vector<BeamRow>& rows) {
  const std::vector<RoughPoint> curve = RoughCurve(rows);
  if (curve.empty()) return 0.35;
  const auto most = std::ranges::max_element(curve, {}, &RoughPoint::candela);
  for (auto i = most + 1; i < curve.end(); ++i) {
    if (i->candela > 0.5 * most->candela) continue;
    const double t = ((i - 1)->candela - 0.5 * most->candela) / ((i - 1)->candela - i->candela);
    return std::max(0.005, (i - 1)->gamma + t * (i->gamma - (i - 1)->gamma));
  }
  // Nothing was seen to fall so far: as a Gaussian through the last.
  const RoughPoint& last = curve.back();
  const double fallen = std::log(most->candela / std::max(last.candela, 1e-300));
  const double farther = std::sqrt(std::numbers::ln2 / std::max(fallen, 0.05));
  return std::clamp(farther * last.gamma, 0.02, 1.3);
}

std::vector<SolvedBeam> SolveBeams(const BeamReadings& readings) {
  const double half = RoughHalfAngle(readings.rows);
  const std::vector<RoughPoint> rough = RoughCurve(readings.rows);
  double peak = 0.0;
  double outermost = 0.0;
  for (const RoughPoint& point : rough) {
    peak = std::max(peak, point.candela);
    outermost = std::max(outermost, point.gamma);
  }
  for (const SheetRow& row : readings.sheet) outermost = std::max(outermost, row.gamma);
  BeamShape curve{BeamFamily::kSmooth};
  curve.scale = half;
  const double reach = std::clamp(std::max(kReach * outermost, 2.0 * half), 0.01, kQuarterTurn);
  curve.step = std::asinh(reach / half) / (BeamShape::kNodes - 1);
  std::vector<double> nodes;
  for (int k = 0; k < BeamShape::kNodes; ++k) {
    const double seen = RoughAt(rough, half * std::sinh(k * curve.step));
    // Beyond the readings on down from the last.
    nodes.push_back(seen >= 0.0 ? BeamShape::LatentOf(seen / peak)
                                : nodes.back() - 0.2 * curve.step);
  }
  const std::vector<int> kinks = rough.empty() ? std::vector<int>{} : KinksOf(rough, curve);
  std::vector<std::vector<double>> one, two, cones;
  for (const double factor : {0.7, 1.0, 1.4}) {
    const double logit = LogitOfAngle(std::min(factor * half, 1.5));
    one.push_back({logit});
    for (const double other : {-1.0, 1.5}) two.push_back({logit, other});
    for (const double inner : {-1.5, 0.5, 2.0, 4.0}) cones.push_back({logit, inner});
  }
  std::vector<std::vector<double>> domes = cones;
  for (std::vector<double>& at : domes) at.push_back(-2.5);
  std::vector<std::vector<double>> powers;
  for (const std::vector<double>& at : one) {
    for (const double q : {0.3, 0.9, 1.6}) powers.push_back({at[0], q});
  }
  std::vector<SolvedBeam> out;
  const auto add = [&out](std::optional<SolvedBeam>&& solved) {
    if (solved) out.push_back(*std::move(solved));
  };
  std::vector<const OffsetPart*> offsets;
  for (const OffsetPart& part : readings.offsets) offsets.push_back(&part);
  if (offsets.empty()) offsets.push_back(nullptr);
  for (const OffsetPart* offset : offsets) {
    if (readings.may_be_even) {
      add(SolveFamily(readings, offset, 2.0, {BeamFamily::kEven}, 0.0, {{}}));
    }
    add(SolveFamily(readings, offset, 1.0, {BeamFamily::kCosinePower}, 0.0, one));
    add(SolveFamily(readings, offset, 1.0, {BeamFamily::kCosineGaussian}, 0.0, two));
    add(SolveFamily(readings, offset, 1.0, {BeamFamily::kPeakedOrFlat}, 0.0, powers));
    add(SolveFamily(readings, offset, 0.5, {BeamFamily::kCone}, 0.0, cones));
    add(SolveFamily(readings, offset, 0.5, {BeamFamily::kDomedCone}, 0.0, domes));
    // A free curve through three angles says nothing of what lies between.
    if (DistinctAngles(rough) < kFewestForCurve) continue;
    for (const double bend : kBends) {
      curve.bend = bend * std::pow(curve.step, 1.5);
      curve.kink = -1;
      add(SolveFamily(readings, offset, 0.5, curve, std::log(peak), {nodes}));
      for (const int kink : kinks) {
        curve.kink = kink;
        const double weight = 0.5 / static_cast<double>(kinks.size());
        add(SolveFamily(readings, offset, weight, curve, std::log(peak), {nodes}));
      }
    }
  }
  if (!out.empty()) ShareOut(out);
  return out;
}

}  // namespace lightcal::fit
