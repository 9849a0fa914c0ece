// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/beam/beam_profile.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <utility>

#include "lightcal/core/normal_mixture.h"
#include "lightcal/core/standard_normal.h"
#include "lightcal/core/statistics.h"
#include "lightcal/core/units.h"
#include "lightcal/fit/beam/rough_beam.h"
#include "lightcal/fit/beam/solved_beams.h"

namespace lightcal::fit {
namespace {

constexpr double kPi = std::numbers::pi;

constexpr int kDraws = 400;       // in all
constexpr int kPriorDraws = 200;  // of a smooth curve before any reading
constexpr double kRises = 2e-3;   // of the axis: less is level
// 1 sigma of ln I(0): how far lamps stray from any such curve between the readings about it.
constexpr double kShapeSd = 0.012;

// ---- widths and flux of a profile ----

// Fine steps as far as the beam reaches, then one degree.
std::vector<double> AnglesFor(double half_rad) {
  const double half = DegreesFromRadians(Radians(half_rad));
  const double fine = half < 5.0 ? 0.25 : (half < 15.0 ? 0.5 : 1.0);
  constexpr double whole = 90.0;
  std::vector<double> out;
  double at = 0.0;
  for (; at < std::min(whole, std::ceil(4.0 * half)); at += fine) out.push_back(at);
  for (at = std::ceil(at); at <= whole; at += 1.0) out.push_back(at);
  return out;
}

// Full angle, out to where it last falls below that part of the axis (CIE e-ILV 17-27-077: of the
// centre beam intensity, wherever the peak is).
double WidthAt(const std::vector<double>& gamma_deg, const std::vector<double>& candela,
               double level) {
  const auto most = std::ranges::max_element(candela);
  const double threshold = level * candela.front();
  auto last = static_cast<std::size_t>(most - candela.begin());
  for (std::size_t i = last; i < candela.size(); ++i) {
    if (candela[i] >= threshold) last = i;
  }
  if (last + 1 >= candela.size()) return 2.0 * gamma_deg[last];
  const double t = (candela[last] - threshold) / (candela[last] - candela[last + 1]);
  return 2.0 * (gamma_deg[last] + t * (gamma_deg[last + 1] - gamma_deg[last]));
}

// 2 pi int I sin(gamma) dgamma, exact for lines between the nodes.
class FluxThrough {
 public:
  explicit FluxThrough(const std::vector<double>& gamma_deg) {
    for (std::size_t i = 0; i + 1 < gamma_deg.size(); ++i) {
      const double a = gamma_deg[i] * kPi / 180.0;
      const double b = gamma_deg[i + 1] * kPi / 180.0;
      const double to = std::cos(b);
      rings_.push_back({b - a, std::cos(a) - to, std::sin(b) - std::sin(a) - (b - a) * to});
    }
  }
  [[nodiscard]] double Of(const std::vector<double>& candela) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < rings_.size(); ++i) {
      const double slope = (candela[i + 1] - candela[i]) / rings_[i].width;
      sum += candela[i] * rings_[i].even + slope * rings_[i].rising;
    }
    return 2.0 * kPi * sum;
  }

 private:
  struct Ring {
    double width, even, rising;  // of an intensity that is the same, and of its slope
  };
  std::vector<Ring> rings_;
};

// ---- draws ----

constexpr std::uint64_t kSeed = 20240917;

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
                            const std::vector<OffAxis<double>>& angles) {
  std::vector<double> candela(angles.size());
  const double axial = std::exp(p[kBeamLnIntensity]);
  for (std::size_t i = 0; i < candela.size(); ++i) {
    candela[i] = axial * beam.shape.Intensity(angles[i], p[kBeamOffset], p.data() + kBeamCommon);
    // Beyond the last reading that saw light none comes up again.
    if (beam.smooth && i > 0 && angles[i].gamma > beam.outermost)
      candela[i] = std::min(candela[i], candela[i - 1]);
  }
  return candela;
}

// Share of falling curves among what a smooth curve may be before any reading.
double FallingShareOfPrior(const BeamShape& curve) {
  std::mt19937_64 random(kSeed);
  StandardNormal normal;
  int falling = 0;
  std::array<double, BeamShape::kNodes> nodes{};
  std::vector<double> values(nodes.size());
  for (int n = 0; n < kPriorDraws; ++n) {
    nodes[0] = 1.0;
    nodes[1] = 1.0 + 0.5 * curve.bend * normal(random);
    for (std::size_t k = 2; k < nodes.size(); ++k) {
      nodes[k] = 2.0 * nodes[k - 1] - nodes[k - 2] + curve.bend * normal(random);
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
               std::mt19937_64& random, StandardNormal& normal) {
  Drawn out;
  const Eigen::Index n = beam.theta.size();
  const FluxThrough flux(gamma_deg);
  std::vector<OffAxis<double>> angles;
  for (const double degrees : gamma_deg) angles.push_back(OffAxisBy(degrees * kPi / 180.0));
  Eigen::VectorXd z(n);
  for (int i = 0; i < count; ++i) {
    for (Eigen::Index k = 0; k < n; ++k) z[k] = normal(random);
    const Eigen::VectorXd p = beam.theta + beam.root * z;
    BeamDraw draw;
    draw.candela = CurveOf(beam, p, angles);
    draw.axial_cd = draw.candela.front();
    if (!std::isfinite(draw.axial_cd)) continue;
    draw.flux_lm = flux.Of(draw.candela);
    if (!std::isfinite(draw.flux_lm)) continue;
    draw.beam_deg = WidthAt(gamma_deg, draw.candela, 0.5);
    draw.field_deg = WidthAt(gamma_deg, draw.candela, 0.1);
    if (beam.smooth && FallsOnly(draw.candela)) out.falling.push_back(draw);
    out.all.push_back(std::move(draw));
  }
  return out;
}

Uncertain IntervalAbout(double value, const std::vector<BeamDraw>& draws, double BeamDraw::* what) {
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
  return {std::clamp(value, low, high), 0.5 * (high - low), low, high};
}

template <class Of>
double SdOver(const std::vector<BeamDraw>& draws, const Of& of) {
  const auto count = static_cast<double>(draws.size());
  double sum = 0.0;
  double squares = 0.0;
  for (const BeamDraw& draw : draws) sum += of(draw);
  const double mean = sum / count;
  for (const BeamDraw& draw : draws) squares += std::pow(of(draw) - mean, 2.0);
  return std::sqrt(squares / count);
}

// Of beams whose shares need not make 1.
BeamMoments MomentsOf(const std::vector<SolvedBeam>& beams) {
  BeamMoments out{0.0};
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
    out.share += one.share;
  }
  mean /= out.share;
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const Eigen::Vector4d off = means[i] - mean;
    covariance += beams[i].share / out.share * (covariances[i] + off * off.transpose());
  }
  std::copy_n(mean.data(), 4, out.theta.begin());
  std::copy_n(covariance.data(), 16, out.covariance.begin());
  return out;
}

std::vector<BeamMoments> MomentsByOffset(const std::vector<SolvedBeam>& beams) {
  std::map<std::size_t, std::vector<SolvedBeam>> under;
  for (const SolvedBeam& one : beams) under[one.offset].push_back(one);
  std::vector<BeamMoments> out;
  for (const auto& [offset, these] : under) out.push_back(MomentsOf(these));
  std::ranges::stable_sort(out, std::ranges::greater(), &BeamMoments::share);
  return out;
}

}  // namespace

Result<BeamProfile> FitBeamProfile(const BeamReadings& readings, const std::string& light) {
  std::vector<SolvedBeam> beams = SolveBeams(readings);
  if (beams.empty()) {
    return Failed("no_convergence", light, "the solver found no beam; check angles and readings");
  }
  std::mt19937_64 random(kSeed);
  StandardNormal normal;
  std::vector<BeamDraw> draws;
  BeamProfile out;
  out.gamma_deg = AnglesFor(RoughHalfAngle(readings.rows));
  double smooth = 0.0;
  for (const SolvedBeam& one : beams) {
    const int count = std::max(8, static_cast<int>(std::lround(kDraws * one.share)));
    Drawn drawn = DrawFrom(one, out.gamma_deg, count, random, normal);
    const double after = static_cast<double>(drawn.falling.size()) /
                         std::max(1.0, static_cast<double>(drawn.all.size()));
    const bool falls =
        one.smooth && drawn.falling.size() >= 8 && after > FallingShareOfPrior(one.shape);
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
    const double part = SdOver(draws, [&](const BeamDraw& draw) {
      return draw.candela[i] / std::max(draw.candela.front(), 1e-300);
    });
    // Draws of what is hardly seen are skew: their mean far off the axis, where a sphere's most
    // solid angle is, was several percent of the flux too much.
    std::vector<double> here;
    here.reserve(draws.size());
    for (const BeamDraw& draw : draws) here.push_back(draw.candela[i]);
    out.candela.push_back(Median(here));
    out.candela_sd.push_back(SdOver(draws, [&](const BeamDraw& draw) { return draw.candela[i]; }));
    out.part_sd.push_back(part);
  }
  const auto peak =
      static_cast<std::size_t>(std::ranges::max_element(out.candela) - out.candela.begin());
  for (std::size_t i = 0; i < out.gamma_deg.size(); ++i) {
    out.pattern_sd.push_back(SdOver(draws, [&](const BeamDraw& draw) {
      return draw.candela[i] / std::max(draw.candela[peak], 1e-300);
    }));
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
  // Figures of the curve that is written beside them, not medians of their own: one light.
  const double flux_lm = FluxThrough(out.gamma_deg).Of(out.candela);
  out.flux_lm = IntervalAbout(flux_lm, draws, &BeamDraw::flux_lm);
  out.beam_deg =
      IntervalAbout(WidthAt(out.gamma_deg, out.candela, 0.5), draws, &BeamDraw::beam_deg);
  out.field_deg =
      IntervalAbout(WidthAt(out.gamma_deg, out.candela, 0.1), draws, &BeamDraw::field_deg);

  out.whole = MomentsOf(beams);
  out.whole.theta[0] = std::log(middle);
  out.by_offset = MomentsByOffset(beams);
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
