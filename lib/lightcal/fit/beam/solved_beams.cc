// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/beam/solved_beams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "lightcal/fit/beam/rough_beam.h"
#include "lightcal/light/fixture.h"

namespace lightcal::fit {
namespace {

constexpr std::size_t kRefined = 3;   // of each family's starts
constexpr int kRounds = 3;            // of settling what the walls scatter
constexpr double kLeastShare = 3e-3;  // of the mixture
constexpr int kFewestForCurve = 4;
constexpr int kStarts = 4;               // until where the light starts is near enough
constexpr double kNearEnough = 5e-3;     // of the distance
constexpr double kOneSurface = 1.2;      // farthest over nearest reading of it
constexpr double kForemostStart = -0.8;  // of the nearest distance
constexpr double kAnyBend = 4.0;         // one of kBends
constexpr double kDark = 0.01;           // of the peak
constexpr int kBeamParameters = kBeamCommon + BeamShape::kNodes;  // of any family
// Standard deviations of the smooth curve's second derivative, over (half angle)^-1.5.
constexpr std::array<double, 4> kBends = {0.6, 1.5, 4.0, 10.0};

// ---- one family under one offset ----

// 1 sigma, lux, of what an angle or a place that is not quite what it says does to a row: from both
// sides of it, so that an edge and a peak count as well as a slope.
template <class P>
double ByAngle(const P& problem, const BeamRow& row, double seen, const double* p) {
  if (!row.lit || !(row.angle_sd > 0.0)) return 0.0;
  const double more = problem.Illuminance(TurnedAway(row, row.angle_sd), p) - seen;
  const double less = problem.Illuminance(TurnedAway(row, -row.angle_sd), p) - seen;
  return std::sqrt(0.5 * (more * more + less * less));
}

// What the rows' sigmas are by the lamp as it stands: with the scatter of the walls' light and of
// where the meter stood.
template <class P>
void SettleBeam(P& problem, const double* p) {
  for (BeamRow& row : problem.rows) {
    if (!row.walls && !(row.angle_sd > 0.0)) continue;
    const double seen = problem.Illuminance(row, p);
    const double whole = row.form == RowForm::kLinear ? 1.0 : seen;
    if (!(whole > 0.0)) continue;
    const double scatter = row.walls ? row.walls->scatter * problem.Walls(row, p) : 0.0;
    row.sigma =
        std::hypot(row.own_sigma, std::hypot(scatter, ByAngle(problem, row, seen, p)) / whole);
  }
}

// But for what is the same of all.
template <class P>
double MinusLnPosterior(const P& problem, const ValuesOf<P>& p) {
  double out = HalfChiSquaredOf(problem, p);
  for (const BeamRow& row : problem.rows) out += std::log(row.sigma);
  return out;
}

template <class P>
std::optional<ValuesOf<P>> SolveBeam(P& problem, ValuesOf<P> p) {
  for (int i = 0; i < kRounds; ++i) {
    SettleBeam(problem, p.data());
    const auto found = SolveTiny(problem, p);
    if (!found) return std::nullopt;
    const bool same = i > 0 && std::abs((*found)[kBeamLnIntensity] - p[kBeamLnIntensity]) < 1e-3;
    p = *found;
    if (same) break;
  }
  return Polish(problem, p);
}

double NearestOf(const std::vector<BeamRow>& rows) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const BeamRow& row : rows) nearest = std::min(nearest, Length(row.from_lamp));
  return nearest;
}

// ln I by weighted mean, all else held.
template <class P>
void StartStrength(const P& problem, ValuesOf<P>& p) {
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

// Those that its family has not are 0.
template <class P>
Eigen::VectorXd OverAll(const ValuesOf<P>& p) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(kBeamParameters);
  std::ranges::copy(p, out.data());
  return out;
}

template <class P>
std::optional<SolvedBeam> SolveFamilyOf(const BeamReadings& readings, const OffsetPart* offset,
                                        double weight, const BeamShape& shape, double ln_peak,
                                        const std::vector<std::vector<double>>& starts) {
  P problem;
  problem.shape = shape;
  problem.rows = readings.rows;
  problem.sheet = readings.sheet;
  problem.least_offset = kLeastOffset * NearestOf(problem.rows);
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
  std::copy_n(shape_rules.begin(), P::kCount - kBeamCommon, problem.rules.begin() + kBeamCommon);

  std::vector<std::pair<double, ValuesOf<P>>> tried;
  for (const std::vector<double>& of_shape : starts) {
    ValuesOf<P> start{};
    for (int k = 0; k < kBeamCommon; ++k) start[k] = problem.rules[k].prior_mean;
    std::copy(of_shape.begin(), of_shape.end(), start.begin() + kBeamCommon);
    if (!smooth) StartStrength(problem, start);
    SettleBeam(problem, start.data());
    tried.emplace_back(MinusLnPosterior(problem, start), start);
  }
  std::ranges::sort(tried, {}, &std::pair<double, ValuesOf<P>>::first);
  tried.resize(std::min(tried.size(), kRefined));
  std::optional<ValuesOf<P>> best;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [rough, start] : tried) {
    const auto found = SolveBeam(problem, start);
    if (!found) continue;
    SettleBeam(problem, found->data());
    const double at = MinusLnPosterior(problem, *found);
    if (!(at < least)) continue;
    least = at;
    best = found;
  }
  if (!best) return std::nullopt;
  SettleBeam(problem, best->data());
  const Linearised<P> at = Linearise(problem, *best);
  const auto covariance = CovarianceAt(problem, at);
  if (!covariance || !covariance->allFinite()) return std::nullopt;

  SolvedBeam out;
  out.shape = shape;
  out.smooth = smooth;
  out.theta = OverAll<P>(*best);
  out.covariance = Eigen::MatrixXd::Zero(kBeamParameters, kBeamParameters);
  out.covariance.topLeftCorner<P::kCount, P::kCount>() = *covariance;
  out.ln_probability = std::log(weight * (offset != nullptr ? offset->weight : 1.0)) -
                       MinusLnPosterior(problem, *best) - shape.LnPriorScale();
  const auto triangle = FreeTriangle(problem, at);
  for (int k = 0; k < P::kCount; ++k) {
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
  out.axial = Eigen::VectorXd::Zero(kBeamParameters);
  out.axial[kBeamLnIntensity] = 1.0;
  double squares_ratio = 1.0;
  const ReadFrom& from = shape.read_from;
  if (shape.family != BeamFamily::kEven) {
    squares_ratio = from.SquaresRatio(0.0, out.theta[kBeamOffset]);
    out.ln_axial += std::log(squares_ratio);
    out.axial[kBeamOffset] = 2.0 / (std::sqrt(squares_ratio) * from.metres);
  }
  if (smooth) {
    const double f = shape.Relative(0.0, best->data() + kBeamCommon);
    out.ln_axial += std::log(f);
    out.axial[kBeamCommon] = -std::expm1(-f / BeamShape::kSoft) / f;
  }
  for (std::size_t i = 0; smooth && i < problem.rows.size(); ++i) {
    const BeamRow& row = problem.rows[i];
    const double candela = row.measured / TowardsOf(row, best->data()).per_candela;
    if (row.lit && candela > kDark * squares_ratio * std::exp(out.theta[kBeamLnIntensity])) {
      out.outermost = std::max(out.outermost, out.gamma_rad[i]);
    }
  }
  out.leave_one_out = lit > 0 ? std::sqrt(squares / lit) : 0.0;
  return out;
}

std::optional<SolvedBeam> SolveFamily(const BeamReadings& readings, const OffsetPart* offset,
                                      double weight, const BeamShape& shape, double ln_peak,
                                      const std::vector<std::vector<double>>& starts) {
  return shape.family == BeamFamily::kSmooth
             ? SolveFamilyOf<BeamProblem<BeamShape::kNodes>>(readings, offset, weight, shape,
                                                             ln_peak, starts)
             : SolveFamilyOf<BeamProblem<BeamShape::kFew>>(readings, offset, weight, shape, ln_peak,
                                                           starts);
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

// Of free parameters only: the others' rows are zero.
Eigen::MatrixXd RootOf(const Eigen::MatrixXd& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(covariance);
  return axes.eigenvectors() * axes.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

double OutermostOf(const std::vector<SheetRow>& sheet) {
  double out = 0.0;
  for (const SheetRow& row : sheet) out = std::max(out, row.gamma);
  return out;
}

// The same readings of a lamp whose place is where its light starts, but for what is left.
BeamReadings SeenFrom(BeamReadings readings, double start) {
  for (BeamRow& row : readings.rows) row.from_lamp[2] += start;
  for (OffsetPart& part : readings.offsets) part.mean_m -= start;
  return readings;
}

// Metres behind the lamp's place that a free curve, seen from `start`, leaves the light to start
// at.
std::optional<double> NextStart(const BeamReadings& stated, const OffsetPart& any, double start) {
  const BeamReadings seen = SeenFrom(stated, start);
  const std::vector<RoughPoint> rough = RoughCurve(seen.rows);
  if (rough.empty()) return std::nullopt;
  RoughSmooth smooth = SmoothThrough(rough, RoughHalfAngle(seen.rows), OutermostOf(seen.sheet),
                                     SurfaceOf(seen.rows).from);
  smooth.shape.bend = kAnyBend * std::pow(smooth.shape.step, 1.5);
  const OffsetPart left{1.0, any.mean_m - start, any.sd_m};
  const auto solved =
      SolveFamily(seen, &left, 1.0, smooth.shape, std::log(smooth.peak_cd), {smooth.nodes});
  if (!solved) return std::nullopt;
  return start + solved->theta[kBeamOffset];
}

// Metres behind the lamp's place where its light starts, by the fixture and by distances, none of
// it by the beam's shape.
double StartOf(const BeamReadings& stated) {
  if (stated.offsets.empty()) return 0.0;
  const OffsetPart any = MatchedOffset(stated.offsets);
  const double foremost = kForemostStart * NearestOf(stated.rows);
  const double usual = std::max(foremost, any.mean_m);
  const ReadingSurface surface = SurfaceOf(stated.rows);
  if (surface.spread < kOneSurface) return usual;
  std::vector<double> begun = {usual};
  for (const OffsetPart& part : stated.offsets) begun.push_back(std::max(foremost, part.mean_m));
  for (double start : begun) {
    std::optional<double> next;
    for (int i = 0; i < kStarts; ++i) {
      next = NextStart(stated, any, start);
      if (!next) break;
      next = std::max(foremost, *next);
      if (std::abs(*next - start) < kNearEnough * surface.from.metres) return *next;
      start = *next;
    }
    if (next) return *next;
  }
  return usual;
}

}  // namespace

std::vector<SolvedBeam> SolveBeams(const BeamReadings& stated) {
  const double start = StartOf(stated);
  const BeamReadings readings = SeenFrom(stated, start);
  const double half = RoughHalfAngle(readings.rows);
  const std::vector<RoughPoint> rough = RoughCurve(readings.rows);
  const ReadFrom from = SurfaceOf(readings.rows).from;
  const RoughSmooth smooth = SmoothThrough(rough, half, OutermostOf(readings.sheet), from);
  BeamShape curve = smooth.shape;
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
  std::vector<const OffsetPart*> offsets;
  for (const OffsetPart& part : readings.offsets) offsets.push_back(&part);
  if (offsets.empty()) offsets.push_back(nullptr);
  for (std::size_t at = 0; at < offsets.size(); ++at) {
    const OffsetPart* offset = offsets[at];
    const auto add = [&out, at](std::optional<SolvedBeam>&& solved) {
      if (!solved) return;
      solved->offset = at;
      out.push_back(*std::move(solved));
    };
    if (readings.may_be_even) {
      add(SolveFamily(readings, offset, 2.0, {BeamFamily::kEven, from}, 0.0, {{}}));
    }
    add(SolveFamily(readings, offset, 1.0, {BeamFamily::kCosinePower, from}, 0.0, one));
    add(SolveFamily(readings, offset, 1.0, {BeamFamily::kCosineGaussian, from}, 0.0, two));
    add(SolveFamily(readings, offset, 1.0, {BeamFamily::kPeakedOrFlat, from}, 0.0, powers));
    add(SolveFamily(readings, offset, 0.5, {BeamFamily::kCone, from}, 0.0, cones));
    add(SolveFamily(readings, offset, 0.5, {BeamFamily::kDomedCone, from}, 0.0, domes));
    // A free curve through three angles says nothing of what lies between.
    if (DistinctAngles(rough) < kFewestForCurve) continue;
    for (const double bend : kBends) {
      curve.bend = bend * std::pow(curve.step, 1.5);
      curve.kink = -1;
      add(SolveFamily(readings, offset, 0.5, curve, std::log(smooth.peak_cd), {smooth.nodes}));
      for (const int kink : kinks) {
        curve.kink = kink;
        const double weight = 0.5 / static_cast<double>(kinks.size());
        add(SolveFamily(readings, offset, weight, curve, std::log(smooth.peak_cd), {smooth.nodes}));
      }
    }
  }
  for (SolvedBeam& beam : out) {  // as stated again
    beam.theta[kBeamOffset] += start;
    beam.shape.read_from.start = start;
  }
  if (!out.empty()) ShareOut(out);
  for (SolvedBeam& beam : out) beam.root = RootOf(beam.covariance);
  return out;
}

}  // namespace lightcal::fit
