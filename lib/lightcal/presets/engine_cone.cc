// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/engine_cone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <tuple>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/punctual_light.h"

namespace lightcal {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2.0;
// Godot's: at 90 degrees some versions of 4 cull a spot by the tangent of that angle, negative in
// single precision (light_get_aabb), and a shadow's camera has no width; 89 leaves 1.7 % of a
// cosine's rim.
constexpr double kWidestPower = 89.0 * kRadiansPerDegree;
constexpr double kHardShare = 0.9999;  // the inner angle of an edge, over the outer
constexpr double kNoShare = 1e-4;      // below it no person types an inner angle
constexpr double kDark = 1e-3;         // of the axial intensity: where a beam ends
constexpr double kBeyond = 5.0 * kRadiansPerDegree;
constexpr double kLeastRim = 1e-4;  // Godot's shader takes no smaller u
constexpr int kBeamSteps = 300, kRestSteps = 60, kTurns = 24;

double WidestOf(EngineConeLaw law) {
  return law == EngineConeLaw::kPower ? kWidestPower : kRightAngle;
}

double Clamped(double v) { return std::clamp(v, 0.0, 1.0); }
double SmoothStepOf(double t) { return t * t * (3.0 - 2.0 * t); }

// Of a cone, once for all angles.
struct ConeTerms {
  EngineConeLaw law;
  double inner, outer, cosine_outer, span, power, axis;
};

ConeTerms TermsOf(EngineConeLaw law, double inner, double outer, double power) {
  const double cosine = std::cos(outer);
  return {law,
          inner,
          outer,
          cosine,
          std::max(1e-12, std::cos(inner) - cosine),
          power,
          law == EngineConeLaw::kPower ? 1.0 - std::pow(kLeastRim, power) : 1.0};
}

double FactorAt(const ConeTerms& cone, double angle, double cosine) {
  const double t = Clamped((cosine - cone.cosine_outer) / cone.span);
  const double s = Clamped((cone.outer - angle) / std::max(1e-9, cone.outer - cone.inner));
  switch (cone.law) {
    case EngineConeLaw::kSquared:
      return t * t;
    case EngineConeLaw::kSmooth:
      return SmoothStepOf(t);
    case EngineConeLaw::kSmoothTimesCosine:
      return SmoothStepOf(t) * std::max(0.0, cosine);
    case EngineConeLaw::kSmoothInAngle:
      return SmoothStepOf(s);
    case EngineConeLaw::kLinearInAngle:
      return s;
    case EngineConeLaw::kPower:
      break;
  }
  const double u = (1.0 - cosine) / std::max(1e-12, 1.0 - cone.cosine_outer);
  return u < 1.0 ? (1.0 - std::pow(std::max(u, kLeastRim), cone.power)) / cone.axis : 0.0;
}

// ---- the search ----

// (outer, the other): inner over outer, or the logarithm of the power.
using ConePlace = std::array<double, 2>;

ConeTerms TermsAt(EngineConeLaw law, const ConePlace& at) {
  const double outer = std::clamp(at[0], 1e-3, WidestOf(law));
  if (law == EngineConeLaw::kPower) {
    return TermsOf(law, 0.0, outer, std::exp(std::clamp(at[1], -1.4, 4.6)));
  }
  const double share = at[1] < kNoShare ? 0.0 : std::min(at[1], kHardShare);
  return TermsOf(law, outer * share, outer, 1.0);
}

struct Sample {
  double angle, cosine, weight, mean, least, most;
};

std::vector<Sample> SamplesOf(const BeamProfile& beam) {
  std::vector<Sample> samples;
  const std::size_t n = beam.angle_rad.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = beam.angle_rad[i];
    const double step = beam.angle_rad[std::min(i + 1, n - 1)] - beam.angle_rad[i == 0 ? 0 : i - 1];
    samples.push_back({angle, std::cos(angle), 0.5 * step * std::sin(angle), beam.mean[i],
                       beam.least[i], beam.most[i]});
  }
  return samples;
}

struct ConeErrors {
  double worst = 0.0, at = 0.0, flux = 1.0;
};

ConeErrors ErrorsOf(const std::vector<Sample>& samples, const ConeTerms& cone) {
  ConeErrors out;
  double ours = 0.0, theirs = 0.0;
  for (const Sample& s : samples) {
    const double got = FactorAt(cone, s.angle, s.cosine);
    const double off = std::max(std::abs(got - s.least), std::abs(got - s.most));
    if (off > out.worst) {
      out.worst = off;
      out.at = s.angle;
    }
    ours += s.weight * got;
    theirs += s.weight * s.mean;
  }
  out.flux = theirs > 0.0 ? ours / theirs : 1.0;
  return out;
}

double CostOf(const std::vector<Sample>& samples, EngineConeLaw law, const ConePlace& at) {
  constexpr double kFluxFirst = 50.0;
  // Only there the angles are what was asked for.
  const double outside =
      std::max(0.0, at[0] - WidestOf(law)) + std::max(0.0, 0.005 - at[0]) +
      (law == EngineConeLaw::kPower ? std::max(0.0, std::abs(at[1] - 1.6) - 3.0)
                                    : std::max(0.0, -at[1]) + std::max(0.0, at[1] - kHardShare));
  const ConeErrors errors = ErrorsOf(samples, TermsAt(law, at));
  return errors.worst + kFluxFirst * std::max(0.0, std::abs(errors.flux - 1.0) - kConeFluxError) +
         10.0 * outside;
}

// Nelder and Mead's simplex from one place, until it is too small to be told in a file's digits.
template <class Cost>
std::pair<double, ConePlace> Descend(const Cost& cost, const ConePlace& from,
                                     const ConePlace& step) {
  constexpr int kMoves = 120;
  constexpr double kSmall = 1e-9;
  std::array<std::pair<double, ConePlace>, 3> simplex;
  for (std::size_t i = 0; i < 3; ++i) {
    ConePlace at = from;
    if (i > 0) at[i - 1] += step[i - 1];
    simplex[i] = {cost(at), at};
  }
  const auto by_cost = [](const auto& a, const auto& b) { return a.first < b.first; };
  for (int move = 0; move < kMoves; ++move) {
    std::ranges::sort(simplex, by_cost);
    auto& worst = simplex[2];
    double extent = 0.0;
    for (std::size_t k = 0; k < 2; ++k) {
      extent = std::max({extent, std::abs(simplex[1].second[k] - simplex[0].second[k]),
                         std::abs(worst.second[k] - simplex[0].second[k])});
    }
    if (extent < kSmall) break;
    const auto beyond = [&](double t) {
      ConePlace at{};
      for (std::size_t k = 0; k < 2; ++k) {
        const double middle = 0.5 * (simplex[0].second[k] + simplex[1].second[k]);
        at[k] = middle + t * (worst.second[k] - middle);
      }
      return std::pair(cost(at), at);
    };
    auto tried = beyond(-1.0);
    if (tried.first < simplex[0].first) tried = std::min(tried, beyond(-2.0), by_cost);
    if (tried.first >= simplex[1].first) tried = std::min(tried, beyond(0.5), by_cost);
    if (tried.first < worst.first) {
      worst = tried;
      continue;
    }
    for (std::size_t i = 1; i < 3; ++i) {
      for (std::size_t k = 0; k < 2; ++k) {
        simplex[i].second[k] = 0.5 * (simplex[i].second[k] + simplex[0].second[k]);
      }
      simplex[i].first = cost(simplex[i].second);
    }
  }
  std::ranges::sort(simplex, by_cost);
  return simplex[0];
}

double EndOf(const BeamProfile& beam) {
  double end = beam.angle_rad[1];
  for (std::size_t i = 0; i < beam.angle_rad.size(); ++i) {
    if (beam.most[i] > kDark) end = beam.angle_rad[i];
  }
  return end;
}

// Every fourth sample, with the weight of the four: enough to find the valley.
std::vector<Sample> Thinned(const std::vector<Sample>& samples) {
  constexpr std::size_t kEvery = 4;
  std::vector<Sample> few;
  for (std::size_t i = 0; i < samples.size(); i += kEvery) {
    few.push_back(samples[i]);
    for (std::size_t j = i + 1; j < std::min(i + kEvery, samples.size()); ++j) {
      few.back().weight += samples[j].weight;
    }
  }
  return few;
}

ConePlace BestPlace(EngineConeLaw law, const BeamProfile& beam,
                    const std::vector<Sample>& samples) {
  constexpr int kOuters = 20, kOthers = 10;
  constexpr std::size_t kSeeds = 3;
  const double widest = std::min(WidestOf(law), 1.3 * EndOf(beam));
  const std::vector<Sample> few = Thinned(samples);
  const auto roughly = [&](const ConePlace& at) { return CostOf(few, law, at); };
  const auto cost = [&](const ConePlace& at) { return CostOf(samples, law, at); };
  std::vector<std::pair<double, ConePlace>> tried;
  for (int i = 1; i <= kOuters; ++i) {
    for (int j = 0; j < kOthers; ++j) {
      const double part = (j + 0.5) / kOthers;
      const ConePlace at = {widest * i / kOuters,
                            law == EngineConeLaw::kPower ? -1.2 + 5.0 * part : part};
      tried.emplace_back(roughly(at), at);
    }
  }
  std::ranges::partial_sort(tried, tried.begin() + kSeeds);
  const ConePlace first = {widest / kOuters, 0.08};
  auto valley = tried.front();
  for (std::size_t i = 0; i < kSeeds; ++i) {
    valley = std::min(valley, Descend(roughly, tried[i].second, first));
  }
  auto best = Descend(cost, valley.second, {0.3 * first[0], 0.02});
  // Once more: a worst error has edges, on which a simplex may lie down too early.
  best = std::min(best, Descend(cost, best.second, {-0.3 * first[0], -0.02}));
  return best.second;
}

EngineCone JudgedCone(const ConeTerms& terms, const std::vector<Sample>& samples) {
  const ConeErrors errors = ErrorsOf(samples, terms);
  return {terms.law,          {Radians(terms.inner), Radians(terms.outer)},
          terms.power,        errors.worst,
          Radians(errors.at), errors.flux};
}

}  // namespace

BeamProfile ProfileOf(const SpotCone& cone) {
  BeamProfile beam;
  beam.squared = cone;
  constexpr int kEdgeSteps = 100;
  const double end = std::min(std::numbers::pi, cone.outer.value() + kBeyond);
  const double step = end / (2 * kBeamSteps);
  for (int i = 0; i <= 2 * kBeamSteps; ++i) beam.angle_rad.push_back(step * i);
  // An edge falls within few of these.
  const double inner = std::min(cone.inner, cone.outer).value();
  const double edge = cone.outer.value() - inner;
  if (edge < kEdgeSteps * step) {
    for (int i = 0; i <= kEdgeSteps; ++i) beam.angle_rad.push_back(inner + edge * i / kEdgeSteps);
    std::ranges::sort(beam.angle_rad);
    const auto same = std::ranges::unique(beam.angle_rad);
    beam.angle_rad.erase(same.begin(), same.end());
  }
  for (const double angle : beam.angle_rad) {
    beam.mean.push_back(SpotAttenuation(Radians(angle), cone, SpotFalloff::kSquaredLinear));
  }
  beam.least = beam.most = beam.mean;
  return beam;
}

BeamProfile LambertianProfile() {
  BeamProfile beam;
  beam.lambertian = true;
  for (int i = 0; i <= 2 * kBeamSteps; ++i) {
    const double angle = (kRightAngle + kBeyond) * i / (2 * kBeamSteps);
    beam.angle_rad.push_back(angle);
    beam.mean.push_back(std::max(0.0, std::cos(angle)));
  }
  beam.least = beam.most = beam.mean;
  return beam;
}

std::optional<BeamProfile> ProfileOf(const IntensityTable& table) {
  const double axial = table.Towards({0.0, 0.0, -1.0}).value();
  if (!(axial > 0.0)) return std::nullopt;
  BeamProfile beam;
  const auto add = [&](double gamma) {
    double mean = 0.0, least = 1e300, most = 0.0;
    for (int j = 0; j < kTurns; ++j) {
      const double c = 2.0 * std::numbers::pi * j / kTurns;
      const double part = table
                              .Towards({std::sin(gamma) * std::cos(c),
                                        std::sin(gamma) * std::sin(c), -std::cos(gamma)})
                              .value() /
                          axial;
      mean += part / kTurns;
      least = std::min(least, part);
      most = std::max(most, part);
    }
    beam.angle_rad.push_back(gamma);
    beam.mean.push_back(mean);
    beam.least.push_back(least);
    beam.most.push_back(most);
  };
  // Where it ends, to two degrees; then fine within and coarse beyond.
  for (int i = 0; i <= 90; ++i) add(2.0 * kRadiansPerDegree * i);
  const double end = std::min(std::numbers::pi, EndOf(beam) + kBeyond);
  beam = {};
  for (int i = 0; i <= kBeamSteps; ++i) add(end * i / kBeamSteps);
  if (end < std::numbers::pi) {
    for (int i = 1; i <= kRestSteps; ++i) add(end + (std::numbers::pi - end) * i / kRestSteps);
  }
  return beam;
}

double ConeFactor(const EngineCone& cone, Radians from_axis) {
  return FactorAt(TermsOf(cone.law, cone.cone.inner.value(), cone.cone.outer.value(), cone.power),
                  from_axis.value(), std::cos(from_axis.value()));
}

double AxisFactor(const EngineCone& cone) {
  return TermsOf(cone.law, cone.cone.inner.value(), cone.cone.outer.value(), cone.power).axis;
}

namespace {

// Absent: the law has none.
std::optional<ConeTerms> TermsOfLambertian(EngineConeLaw law) {
  switch (law) {
    case EngineConeLaw::kSquared:
      return TermsOf(law, std::acos(kLambertianInnerCosine), kRightAngle, 1.0);
    case EngineConeLaw::kSmoothTimesCosine:
      return TermsOf(law, kHardShare * kRightAngle, kRightAngle, 1.0);
    case EngineConeLaw::kPower:
      return TermsOf(law, 0.0, kWidestPower, 1.0);
    default:
      return std::nullopt;
  }
}

}  // namespace

EngineCone RefitCone(EngineConeLaw law, const BeamProfile& beam) {
  const std::vector<Sample> samples = SamplesOf(beam);
  if (beam.lambertian) {
    if (const auto closed = TermsOfLambertian(law)) return JudgedCone(*closed, samples);
  }
  if (!beam.squared && !beam.lambertian) {
    return JudgedCone(TermsAt(law, BestPlace(law, beam, samples)), samples);
  }
  const double inner = beam.lambertian ? 0.0 : beam.squared->inner.value();
  const double outer = beam.lambertian ? 0.0 : beam.squared->outer.value();  // 0: the cosine
  if (law == EngineConeLaw::kSquared) return JudgedCone(TermsOf(law, inner, outer, 1.0), samples);
  // Flat lamps without number stand for the same cone in engines of few laws: each is searched
  // once.
  static std::mutex mutex;
  static std::map<std::tuple<EngineConeLaw, double, double>, ConePlace> found;
  const std::tuple key(law, inner, outer);
  const std::lock_guard lock(mutex);
  auto known = found.find(key);
  if (known == found.end()) known = found.emplace(key, BestPlace(law, beam, samples)).first;
  return JudgedCone(TermsAt(law, known->second), samples);
}

EngineCone RefitCone(EngineConeLaw law, const BeamProfile& beam, double inner_share) {
  constexpr int kTried = 400;
  const std::vector<Sample> samples = SamplesOf(beam);
  const double widest = std::min(kRightAngle, 1.3 * EndOf(beam));
  std::pair<double, ConePlace> best{1e300, {widest, inner_share}};
  for (int i = 1; i <= kTried; ++i) {
    const ConePlace at = {widest * i / kTried, inner_share};
    best = std::min(best, std::pair(CostOf(samples, law, at), at));
  }
  return JudgedCone(TermsAt(law, best.second), samples);
}

EngineCone JudgeCone(EngineConeLaw law, const SpotCone& cone, const BeamProfile& beam) {
  return JudgedCone(TermsOf(law, cone.inner.value(), cone.outer.value(), 1.0), SamplesOf(beam));
}

namespace {

constexpr double kNothing = 1e-3;

std::string OffAxisText(double worst, Radians at, std::string_view of) {
  return "off the axis within " + RoundedText(100.0 * worst, 2) + " % of the " + std::string(of) +
         " intensity (at " + RoundedText(DegreesFromRadians(at), 2) + " degrees)";
}

}  // namespace

std::string ErrorOffAxis(double worst, Radians at, std::string_view of) {
  return worst < kNothing ? std::string() : OffAxisText(worst, at, of);
}

std::string ConeErrorText(const EngineCone& cone) {
  const double flux = cone.flux - 1.0;
  if (cone.worst < kNothing && std::abs(flux) < kNothing) return {};
  return OffAxisText(cone.worst, cone.worst_at, "axial") + ", flux " +
         RoundedText(100.0 * std::abs(flux), 2) + (flux < 0.0 ? " % low" : " % high");
}

}  // namespace lightcal
