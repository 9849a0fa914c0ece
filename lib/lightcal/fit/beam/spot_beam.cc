// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/beam/spot_beam.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "lightcal/fit/beam/spot_model.h"
#include "lightcal/fit/estimate_light.h"
#include "lightcal/fit/model/least_squares.h"

namespace lightcal::fit {
namespace {

constexpr double kHalfPi = 0.5 * std::numbers::pi;
constexpr double kDarkShare = 0.002;  // of the beam's peak: what a meter still sees in the dark
constexpr std::size_t kStartsTried = 12;
constexpr double kBeamSpread = 1.5;

using Parameters = std::array<double, kSpotParameters>;

double Logit(double x) { return std::log(x / (1.0 - x)); }

// A least-squares problem (least_squares.h): r = (m - E)/sigma.
struct Beam {
  SourceFrame frame;
  std::vector<SpotReading> readings;
  std::array<ParameterRule, kSpotParameters> rules;
  Parameters held{};

  static constexpr int kCount = kSpotParameters;
  [[nodiscard]] std::size_t RowCount() const { return readings.size(); }
  [[nodiscard]] Bounds BoundsOf(int k) const {
    // Beyond these the angles' logits only run away.
    return k == kSpotOuter || k == kSpotInner ? Bounds{-7.0, 7.0} : Bounds{};
  }
  template <class T>
  [[nodiscard]] bool Residual(std::size_t i, const T* p, T* residual) const {
    *residual = (readings[i].measured - SpotIlluminance(readings[i], p)) / readings[i].sigma;
    return true;
  }
};

double AmbientOf(const Observations& observations) {
  double sum = 0.0;
  int count = 0;
  for (const Observation& row : observations.rows) {
    if (row.lit) continue;
    sum += row.measured_lx;
    ++count;
  }
  return count > 0 ? sum / count : 0.0;
}

// Candela that a reading asks for if the beam were full there.
double Strength(const SpotReading& reading) {
  const double r2 = Dot(reading.from_lamp, reading.from_lamp);
  const double facing = -Dot(reading.from_lamp, reading.normal) / std::sqrt(r2);
  return facing > 0.0 ? reading.measured * r2 / facing : 0.0;
}

Beam BeamOf(const Observations& observations, const LightDescription& light) {
  const double ambient = AmbientOf(observations);
  Vec3 middle{};
  double nearest = std::numeric_limits<double>::infinity();
  double peak = 0.0;
  Beam beam;
  for (const Observation& row : observations.rows) {
    if (!LitAndPlaced(row)) continue;
    const Vec3 from = *row.position_m - *light.position_m;
    const double distance = Length(from);
    SpotReading reading{from, row.normal.value_or(from * (-1.0 / distance)),
                        row.measured_lx - (row.differenced ? 0.0 : ambient), row.sigma_lx};
    const double strength = std::max(0.0, Strength(reading));
    middle = middle + from * (strength / distance);
    peak = std::max(peak, strength);
    nearest = std::min(nearest, distance);
    beam.readings.push_back(reading);
  }
  const double length = Length(middle);
  const Vec3 aim = light.aim ? *light.aim : middle * (1.0 / (length > 0.0 ? length : 1.0));
  beam.frame = SourceFrame::Facing(aim);
  for (SpotReading& reading : beam.readings) {
    const double r2 = Dot(reading.from_lamp, reading.from_lamp);
    reading.sigma = std::hypot(reading.sigma, kDarkShare * peak / r2);
    reading.from_lamp = beam.frame.Of(reading.from_lamp);
    reading.normal = beam.frame.Of(reading.normal);
  }
  const double aim_sd = light.aim ? std::tan(RadiansFromDegrees(kAimSigmaDegrees).value()) : 0.0;
  beam.rules[kSpotLnIntensity] = {true};
  const OffsetPart offset = MatchedOffset(OffsetParts(light.fixture));
  beam.rules[kSpotOffset] = {true, offset.mean_m, offset.sd_m};
  beam.rules[kSpotOuter] = {!light.outer};
  beam.rules[kSpotInner] = {!light.inner};
  beam.rules[kSpotAimX] = beam.rules[kSpotAimY] = {true, 0.0, aim_sd};
  if (light.outer) {
    beam.held[kSpotOuter] = Logit(std::min(light.outer->value() / kHalfPi, 1.0 - 1e-9));
    if (light.inner) {
      beam.held[kSpotInner] = Logit(std::clamp(*light.inner / *light.outer, 1e-6, 1.0 - 1e-6));
    }
  }
  return beam;
}

// ln I by weighted linear least squares, all else held.
void FitStrength(const Beam& beam, Parameters& p) {
  p[kSpotLnIntensity] = 0.0;
  double aa = 0.0;
  double am = 0.0;
  for (const SpotReading& reading : beam.readings) {
    const double a = SpotIlluminance(reading, p.data()) / reading.sigma;
    aa += a * a;
    am += a * reading.measured / reading.sigma;
  }
  p[kSpotLnIntensity] = aa > 0.0 && am > 0.0 ? std::log(am / aa) : -700.0;
}

struct Start {
  Parameters p{};
  double chi_squared = 0.0;
};

// Cones from 3 degrees to 85, soft to hard, with the aim as it is and a little to every side.
std::vector<Start> Starts(const Beam& beam, bool aim_stated) {
  std::vector<Start> starts;
  constexpr int kAngles = 24;
  constexpr std::array<double, 4> kShares = {0.15, 0.5, 0.75, 0.95};
  const double reach = aim_stated ? 0.05 : 0.2;
  for (int i = 0; i < kAngles; ++i) {
    const double outer = 0.05 * std::pow(1.48 / 0.05, i / (kAngles - 1.0));
    for (const double share : kShares) {
      for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
          Start start;
          start.p = beam.held;
          if (beam.rules[kSpotOuter].free) start.p[kSpotOuter] = Logit(outer / kHalfPi);
          if (beam.rules[kSpotInner].free) start.p[kSpotInner] = Logit(share);
          start.p[kSpotAimX] = reach * x * outer * 4.0;
          start.p[kSpotAimY] = reach * y * outer * 4.0;
          FitStrength(beam, start.p);
          start.chi_squared = 2.0 * HalfChiSquaredOf(beam, start.p);
          starts.push_back(start);
        }
      }
    }
  }
  const std::size_t kept = std::min(kStartsTried, starts.size());
  std::partial_sort(starts.begin(), starts.begin() + static_cast<std::ptrdiff_t>(kept),
                    starts.end(),
                    [](const Start& a, const Start& b) { return a.chi_squared < b.chi_squared; });
  starts.resize(kept);
  return starts;
}

bool Refine(const Beam& beam, Start& start) {
  const auto found = SolveInFullBy(beam, start.p, {.parameter_tolerance = 1e-8}, "cone");
  if (!found) return false;
  start = {*found, 2.0 * HalfChiSquaredOf(beam, *found)};
  return std::isfinite(start.chi_squared);
}

using Information = SquareOf<Beam>;

Information InformationAt(const Beam& beam, const Parameters& p) {
  Information information = NormalEquationsAt(beam, p).normal;
  for (int k = 0; k < kSpotParameters; ++k) {
    // A logit nothing determines is still within ten.
    if (!(beam.rules[k].prior_sd > 0.0)) information(k, k) += 0.01;
    if (!beam.rules[k].free) Hold(information, k);
  }
  return information;
}

// The covariance averaged over the estimate's own spread (itself and kBeamSpread standard
// deviations to both sides along each axis). A reading on the edge of the inner cone tells much on
// one side of it and nothing on the other, so that the curvature at the estimate alone may claim
// four times too much.
Information SpreadCovariance(const Beam& beam, const Parameters& p) {
  const Information at = InformationAt(beam, p);
  const Eigen::SelfAdjointEigenSolver<Information> axes(at);
  Information sum = at.inverse();
  int count = 1;
  for (int k = 0; k < kSpotParameters; ++k) {
    const double sd = kBeamSpread / std::sqrt(axes.eigenvalues()[k]);
    for (const double side : {-1.0, 1.0}) {
      Parameters moved = p;
      for (int j = 0; j < kSpotParameters; ++j) {
        if (beam.rules[j].free) moved[j] += side * sd * axes.eigenvectors()(j, k);
      }
      const Information there = InformationAt(beam, moved).inverse();
      if (!there.allFinite()) continue;
      sum += there;
      ++count;
    }
  }
  return sum / count;
}

}  // namespace

bool NeedsBeam(const Observations& observations, const LightDescription& light) {
  if (light.kind != LightKind::kSpot || !light.position_m) return false;
  if (light.outer && light.inner && light.aim) return false;
  return std::count_if(observations.rows.begin(), observations.rows.end(), LitAndPlaced) >=
         kFewestForBeam;
}

LightDescription WithBeam(const LightDescription& light, const SpotBeam& beam) {
  LightDescription out = light;
  out.inner = beam.inner;
  out.outer = beam.outer;
  out.aim = beam.aim;
  return out;
}

void FillBeam(const SpotBeam& beam, const LightDescription& light, FittedLight& out) {
  out.inner_deg = DegreesFromRadians(beam.inner);
  out.outer_deg = DegreesFromRadians(beam.outer);
  if (!light.inner) out.inner_u95_deg = kZ95 * DegreesFromRadians(beam.inner_sd);
  if (!light.outer) out.outer_u95_deg = kZ95 * DegreesFromRadians(beam.outer_sd);
  out.aim = beam.aim;
  out.aim_u95_deg = kZ95 * DegreesFromRadians(beam.aim_sd);
}

Result<SpotBeam> FitSpotBeam(const Observations& observations, const LightDescription& light) {
  const Beam beam = BeamOf(observations, light);
  std::vector<Start> starts = Starts(beam, light.aim.has_value());
  const Start* best = nullptr;
  for (Start& start : starts) {
    if (!Refine(beam, start)) continue;
    if (best == nullptr || start.chi_squared < best->chi_squared) best = &start;
  }
  if (best == nullptr) {
    return Refused("beam_unknown", light.name,
                   "no cone fits the readings; give outer_deg, or read across the beam's edge");
  }
  const Parameters& p = best->p;
  const Information spread = SpreadCovariance(beam, p);
  const int free = static_cast<int>(std::ranges::count(beam.rules, true, &ParameterRule::free));
  const int dof = static_cast<int>(beam.readings.size()) - (free - 1);
  const double birge = dof > 0 ? std::max(1.0, best->chi_squared / dof) : 1.0;
  const Information covariance = spread * birge;
  const double x = LogisticOf(p[kSpotOuter]);
  const double share = LogisticOf(p[kSpotInner]);
  SpotBeam out;
  out.outer = Radians(kHalfPi * x);
  out.inner = Radians(kHalfPi * x * share);
  // d(outer)/dp = outer (1 - x), d(inner)/dp = inner {1 - x, 1 - share}.
  const double per_outer = 1.0 - x;
  const double per_share = 1.0 - share;
  const double oo = covariance(kSpotOuter, kSpotOuter) * (beam.rules[kSpotOuter].free ? 1.0 : 0.0);
  const double ii = covariance(kSpotInner, kSpotInner) * (beam.rules[kSpotInner].free ? 1.0 : 0.0);
  const double oi = covariance(kSpotOuter, kSpotInner);
  out.outer_sd = out.outer * (per_outer * std::sqrt(oo));
  out.inner_sd = out.inner * std::sqrt(per_outer * per_outer * oo + per_share * per_share * ii +
                                       2.0 * per_outer * per_share * oi);
  if (!(out.outer_sd < out.outer / 3.0)) {
    return Refused("beam_unknown", light.name,
                   "the readings do not tell where the cone ends; give outer_deg, or read across "
                   "the beam's edge as well");
  }
  const Vec3 aim = beam.frame.x * p[kSpotAimX] + beam.frame.y * p[kSpotAimY] + beam.frame.z;
  out.aim = aim * (1.0 / Length(aim));
  out.aim_sd = Radians(
      std::sqrt(std::max(covariance(kSpotAimX, kSpotAimX), covariance(kSpotAimY, kSpotAimY))));
  const Eigen::Matrix2d cone_known = InformationAt(beam, p).topLeftCorner<2, 2>().inverse() * birge;
  out.ln_intensity_extra_variance =
      std::max(0.0, covariance(kSpotLnIntensity, kSpotLnIntensity) - cone_known(0, 0));
  return out;
}

}  // namespace lightcal::fit
