// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/beam/beam_profile.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <utility>

#include "lightcal/core/statistics.h"
#include "lightcal/fit/beam/beam_problem.h"
#include "lightcal/fit/model/hypotheses.h"

namespace lightcal::fit {
namespace {

constexpr double kPi = std::numbers::pi;

using BeamValues = ValuesOf<BeamProblem>;
constexpr int kDraws = 400;           // in all
constexpr int kPriorDraws = 200;      // of a smooth curve before any reading
constexpr std::size_t kRefined = 3;   // of each family's starts
constexpr int kRounds = 3;            // of settling what the walls scatter
constexpr double kReach = 1.25;       // nodes beyond the outermost reading
constexpr double kLeastShare = 3e-3;  // of the mixture
constexpr int kFewestForCurve = 4;
constexpr double kDark = 0.01;   // of the peak
constexpr double kRises = 2e-3;  // of the axis: less is level
// 1 sigma of ln I(0): how far lamps stray from any such curve between the readings about it.
constexpr double kShapeSd = 0.012;
// Standard deviations of the smooth curve's second derivative, over (half angle)^-1.5.
constexpr std::array<double, 4> kBends = {0.6, 1.5, 4.0, 10.0};

// ---- one family under one offset ----

struct SolvedBeam {
  BeamShape shape;
  bool smooth = false;
  double outermost = 0.0;  // rad, of the readings that saw light; of a smooth curve
  double ln_axial = 0.0;
  Eigen::VectorXd axial;  // how ln I(0) goes with theta
  double ln_probability = -std::numeric_limits<double>::infinity();
  double share = 0.0;
  Eigen::VectorXd theta;
  Eigen::MatrixXd covariance;
  Eigen::MatrixXd root;  // covariance = root root'
  double chi2 = 0.0, told = 0.0, leave_one_out = 0.0;
  double monotone = 1.0;  // of its prior's draws
  std::vector<double> predicted_lx, walls_lx, gamma_rad;
};

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
  constexpr double kApart = 0.5 * kPi / 180.0;
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

// ---- widths and flux of a profile ----

// Fine steps as far as the beam reaches, then one degree.
std::vector<double> AnglesFor(double half_rad) {
  const double half = half_rad * 180.0 / kPi;
  const double fine = half < 5.0 ? 0.25 : (half < 15.0 ? 0.5 : 1.0);
  constexpr double whole = 90.0;
  std::vector<double> out;
  double at = 0.0;
  for (; at < std::min(whole, std::ceil(4.0 * half)); at += fine) out.push_back(at);
  for (at = std::ceil(at); at <= whole; at += 1.0) out.push_back(at);
  return out;
}

// Full angle, out to where it last falls below.
double WidthAt(const std::vector<double>& gamma_deg, const std::vector<double>& candela,
               double level) {
  const auto most = std::ranges::max_element(candela);
  const double threshold = level * *most;
  auto last = static_cast<std::size_t>(most - candela.begin());
  for (std::size_t i = last; i < candela.size(); ++i) {
    if (candela[i] >= threshold) last = i;
  }
  if (last + 1 >= candela.size()) return 2.0 * gamma_deg[last];
  const double t = (candela[last] - threshold) / (candela[last] - candela[last + 1]);
  return 2.0 * (gamma_deg[last] + t * (gamma_deg[last + 1] - gamma_deg[last]));
}

// 2 pi int I sin(gamma) dgamma, exact for lines between the nodes.
double FluxOf(const std::vector<double>& gamma_deg, const std::vector<double>& candela) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < candela.size(); ++i) {
    const double a = gamma_deg[i] * kPi / 180.0;
    const double b = gamma_deg[i + 1] * kPi / 180.0;
    const double slope = (candela[i + 1] - candela[i]) / (b - a);
    sum += candela[i] * (std::cos(a) - std::cos(b)) +
           slope * (std::sin(b) - std::sin(a) - (b - a) * std::cos(b));
  }
  return 2.0 * kPi * sum;
}

// ---- draws ----

class Normals {
 public:
  double operator()() {
    const double u = (static_cast<double>(random_() >> 11) + 0.5) * 0x1p-53;
    const double v = (static_cast<double>(random_() >> 11) + 0.5) * 0x1p-53;
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * kPi * v);
  }

 private:
  std::mt19937_64 random_{20240917};
};

// Never rises from the axis outwards.
bool FallsOnly(const std::vector<double>& candela) {
  double least = candela.front();
  for (const double value : candela) {
    if (value > least + kRises * candela.front()) return false;
    least = std::min(least, value);
  }
  return true;
}

std::vector<double> CurveOf(const SolvedBeam& beam, const Eigen::VectorXd& p,
                            const std::vector<double>& gamma_deg) {
  std::vector<double> candela(gamma_deg.size());
  const double axial = std::exp(p[kBeamLnIntensity]);
  for (std::size_t i = 0; i < candela.size(); ++i) {
    const double gamma = gamma_deg[i] * kPi / 180.0;
    candela[i] = axial * beam.shape.Relative(gamma, p.data() + kBeamCommon);
    // Beyond the last reading that saw light none comes up again.
    if (beam.smooth && i > 0 && gamma > beam.outermost)
      candela[i] = std::min(candela[i], candela[i - 1]);
  }
  return candela;
}

// Share of falling curves among what a smooth curve may be before any reading.
double FallingShareOfPrior(const BeamShape& curve) {
  Normals normal;
  int falling = 0;
  std::array<double, BeamShape::kNodes> nodes{};
  std::vector<double> values(nodes.size());
  for (int n = 0; n < kPriorDraws; ++n) {
    nodes[0] = 1.0;
    nodes[1] = 1.0 + 0.5 * curve.bend * normal();
    for (std::size_t k = 2; k < nodes.size(); ++k) {
      nodes[k] = 2.0 * nodes[k - 1] - nodes[k - 2] + curve.bend * normal();
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = curve.Relative(curve.scale * std::sinh(curve.step * static_cast<double>(i)),
                                 nodes.data());
    }
    falling += FallsOnly(values) ? 1 : 0;
  }
  return (falling + 0.5) / (kPriorDraws + 1.0);
}

struct Drawn {
  std::vector<BeamDraw> all, falling;
};

Drawn DrawFrom(const SolvedBeam& beam, const std::vector<double>& gamma_deg, int count,
               Normals& normal) {
  Drawn out;
  const Eigen::Index n = beam.theta.size();
  Eigen::VectorXd z(n);
  for (int i = 0; i < count; ++i) {
    for (Eigen::Index k = 0; k < n; ++k) z[k] = normal();
    const Eigen::VectorXd p = beam.theta + beam.root * z;
    BeamDraw draw;
    draw.candela = CurveOf(beam, p, gamma_deg);
    draw.axial_cd = draw.candela.front();
    if (!std::isfinite(draw.axial_cd)) continue;
    draw.flux_lm = FluxOf(gamma_deg, draw.candela);
    if (!std::isfinite(draw.flux_lm)) continue;
    draw.beam_deg = WidthAt(gamma_deg, draw.candela, 0.5);
    draw.field_deg = WidthAt(gamma_deg, draw.candela, 0.1);
    if (beam.smooth && FallsOnly(draw.candela)) out.falling.push_back(draw);
    out.all.push_back(std::move(draw));
  }
  return out;
}

Uncertain IntervalOf(const std::vector<BeamDraw>& draws, double BeamDraw::*what) {
  std::vector<double> values;
  values.reserve(draws.size());
  for (const BeamDraw& draw : draws) values.push_back(draw.*what);
  std::ranges::sort(values);
  const auto at = [&](double q) {
    const double x = q * static_cast<double>(values.size() - 1);
    const auto i = static_cast<std::size_t>(x);
    if (i + 1 >= values.size()) return values.back();
    return values[i] + (x - static_cast<double>(i)) * (values[i + 1] - values[i]);
  };
  const double low = at(0.025);
  const double high = at(0.975);
  return {at(0.5), 0.5 * (high - low), low, high};
}

std::vector<SolvedBeam> SolveAll(const BeamReadings& readings) {
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
      auto solved = SolveFamily(readings, offset, 0.5, curve, std::log(peak), {nodes});
      if (!solved) continue;
      solved->monotone = FallingShareOfPrior(curve);
      out.push_back(*std::move(solved));
    }
  }
  return out;
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

Result<BeamProfile> FitBeamProfile(const BeamReadings& readings, const std::string& light) {
  std::vector<SolvedBeam> beams = SolveAll(readings);
  if (beams.empty()) {
    return Failed("no_convergence", light, "the solver found no beam; check angles and readings");
  }
  ShareOut(beams);
  Normals normal;
  std::vector<BeamDraw> draws;
  BeamProfile out;
  out.gamma_deg = AnglesFor(RoughHalfAngle(readings.rows));
  double smooth = 0.0;
  for (const SolvedBeam& one : beams) {
    const int count = std::max(8, static_cast<int>(std::lround(kDraws * one.share)));
    Drawn drawn = DrawFrom(one, out.gamma_deg, count, normal);
    const double after = static_cast<double>(drawn.falling.size()) /
                         std::max(1.0, static_cast<double>(drawn.all.size()));
    const bool falls = one.smooth && drawn.falling.size() >= 8 && after > one.monotone;
    if (one.smooth) {
      smooth += one.share;
      out.monotone_share += falls ? one.share : 0.0;
    }
    std::ranges::move(falls ? drawn.falling : drawn.all, std::back_inserter(draws));
  }
  if (smooth > 0.0) out.monotone_share /= smooth;
  for (const SolvedBeam& one : beams) {
    const auto known = std::ranges::find(out.families, std::string(NameOf(one.shape.family)),
                                         &BeamFamilyShare::name);
    if (known != out.families.end()) {
      known->share += one.share;
    } else {
      out.families.push_back({NameOf(one.shape.family), one.share, one.leave_one_out});
    }
  }
  std::ranges::stable_sort(out.families, std::ranges::greater(), &BeamFamilyShare::share);
  out.family = out.families.front().name;

  for (std::size_t i = 0; i < out.gamma_deg.size(); ++i) {
    double sum = 0.0;
    double squares = 0.0;
    for (const BeamDraw& draw : draws) sum += draw.candela[i];
    const double mean = sum / static_cast<double>(draws.size());
    for (const BeamDraw& draw : draws) squares += std::pow(draw.candela[i] - mean, 2.0);
    out.candela.push_back(mean);
    out.candela_sd.push_back(std::sqrt(squares / static_cast<double>(draws.size())));
  }
  std::vector<NormalPart> ln;
  for (const SolvedBeam& one : beams) {
    ln.push_back({one.share, one.ln_axial,
                  std::hypot(kShapeSd, std::sqrt(one.axial.dot(one.covariance * one.axial)))});
  }
  out.axial_cd = UncertainFromLogMixture(ln);
  const double middle = out.axial_cd.value;
  out.axial_sd_ln = std::log(*out.axial_cd.high / *out.axial_cd.low) / (2.0 * kZ95);
  const double scale = middle / out.candela.front();
  for (double& value : out.candela) value *= scale;
  out.flux_lm = IntervalOf(draws, &BeamDraw::flux_lm);
  out.beam_deg = IntervalOf(draws, &BeamDraw::beam_deg);
  out.field_deg = IntervalOf(draws, &BeamDraw::field_deg);

  // ln I(0), d0, ln b, slope of each as a linear map of its parameters.
  std::vector<Eigen::Vector4d> means;
  std::vector<Eigen::Matrix4d> covariances;
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();
  for (const SolvedBeam& one : beams) {
    Eigen::MatrixXd map = Eigen::MatrixXd::Zero(4, one.theta.size());
    map.row(0) = one.axial.transpose();
    map(1, kBeamOffset) = map(2, kBeamLnWalls) = map(3, kBeamWallsSlope) = 1.0;
    means.emplace_back(one.ln_axial, one.theta[kBeamOffset], one.theta[kBeamLnWalls],
                       one.theta[kBeamWallsSlope]);
    covariances.emplace_back(map * one.covariance * map.transpose());
    mean += one.share * means.back();
  }
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const Eigen::Vector4d off = means[i] - mean;
    covariance += beams[i].share * (covariances[i] + off * off.transpose());
  }
  mean[0] = std::log(middle);
  std::copy_n(mean.data(), 4, out.theta.begin());
  std::copy_n(covariance.data(), 16, out.covariance.begin());
  for (std::size_t k = 0; k < 2; ++k) {
    const auto at = static_cast<Eigen::Index>(kBeamAimX + k);
    double variance = 0.0;
    for (const SolvedBeam& one : beams) out.aim[k] += one.share * one.theta[at];
    for (const SolvedBeam& one : beams) {
      variance += one.share * (one.covariance(at, at) + std::pow(one.theta[at] - out.aim[k], 2.0));
    }
    out.aim_sd[k] = std::sqrt(variance);
  }
  SolvedBeam& first = beams.front();
  out.predicted_lx = std::move(first.predicted_lx);
  out.walls_lx = std::move(first.walls_lx);
  out.gamma_rad = std::move(first.gamma_rad);
  out.chi2 = first.chi2;
  out.degrees_of_freedom = std::max(0.0, static_cast<double>(readings.rows.size()) - first.told);
  return out;
}

}  // namespace lightcal::fit
