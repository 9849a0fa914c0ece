// SPDX-License-Identifier: Apache-2.0
// Shapes that a beam may have about its axis: I(gamma) = I(0) f(gamma), f(0) = 1. They share one
// struct, so that one problem (beam_problem.h) serves them all. Internal to this room.
//
// All but the even one take the angle and give the intensity that the readings seem to have, seen
// from where the light starts by all else that is known. A lamp is no cos^n, and no curve has its
// corners at nodes, to within what its readings would need to tell by that where it starts.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <type_traits>
#include <vector>

#include "lightcal/fit/beam/spot_model.h"
#include "lightcal/fit/model/parameter.h"

namespace lightcal::fit {

inline constexpr double kQuarterTurn = 0.5 * std::numbers::pi;

enum class BeamFamily : std::uint8_t {
  kEven,            // alike in all directions
  kCosinePower,     // cos^n, n = ln(1/2)/ln cos(h), h the half angle at half of the peak
  kCosineGaussian,  // cos^m exp(-k gamma^2); the cosine makes the share w of what halves it at h
  kPeakedOrFlat,    // exp(-ln 2 (gamma/h)^q): peaked (q 1), Gaussian (2), flat with soft edges (4)
  // Squared linear between the cosines of inner and outer (glTF, Filament, Frostbite), as
  // spot_model.h has it: a flat cone with a penumbra.
  kCone,
  kDomedCone,  // the same times 1 - c (sin(gamma/2)/sin(outer/2))^2
  // f = s ln(1 + exp(g/s)), a line where it shines and an exponential where it goes dark, never
  // negative; g over x = asinh(gamma/`scale`) by nodes `step` apart, cubic between them and linear
  // beyond, level and symmetric about the axis. Its prior is an integrated random walk: the second
  // difference at each node has the standard deviation `bend`. f counts from the readings' largest
  // intensity, so that f(0) need not be 1.
  kSmooth,
};
inline constexpr int kBeamFamilies = 7;
[[nodiscard]] const char* NameOf(BeamFamily family);

// Half angles at half of the peak that lamps are built with, as the logit of their share of 90
// degrees: 20 degrees, two thirds within 8 and 42.
inline constexpr ParameterRule kHalfAngleRule = {true, -1.2, 1.1};

template <class T>
[[nodiscard]] T AngleOf(const T& logit) {
  return 0.99 * kQuarterTurn * LogisticOf(logit);
}
[[nodiscard]] double LogitOfAngle(double radians);

template <class T>
[[nodiscard]] double ScalarOf(const T& x) {
  if constexpr (std::is_arithmetic_v<T>) {
    return x;
  } else {
    return x.a;
  }
}

// An angle from the axis whose sine and cosine are taken once, for as many beams as see it.
template <class T>
struct OffAxis {
  T gamma, sine, cosine;
};
template <class T>
[[nodiscard]] OffAxis<T> OffAxisBy(const T& gamma) {
  using std::cos;
  using std::sin;
  return {gamma, sin(gamma), cos(gamma)};
}

// Where the readings are, seen from `start` metres behind the lamp's place: a plane across the
// axis, or all around at one distance. A point on it under an angle `a` from there is under gamma
// from where the light starts, `offset` behind the lamp's place.
struct ReadFrom {
  double metres = 1.0;  // from there along the axis
  bool plane = true;
  double start = 0.0;
  static constexpr double kMostForward = -0.95;

  // How far behind that the light starts, of the distance.
  template <class T>
  [[nodiscard]] T Relative(const T& offset) const {
    const T relative = (offset - start) / metres;
    return relative > T(kMostForward) ? relative : T(kMostForward);
  }
  template <class T>
  [[nodiscard]] T AngleFromStart(const OffAxis<T>& towards, const T& offset) const {
    using std::asin;
    using std::atan2;
    const T q = Relative(offset);
    if (plane) return atan2((1.0 + q) * towards.sine, towards.cosine);
    return towards.gamma + asin(q * towards.sine);
  }
  // Square of the distance from where the light starts, over that from there.
  template <class T>
  [[nodiscard]] T SquaresRatio(const T& a, const T& offset) const {
    using std::cos;
    using std::sin;
    const T ahead = cos(a);
    const T across = sin(a);
    const T along = ahead + Relative(offset) * (plane ? ahead : T(1.0));
    return across * across + along * along;
  }
};

struct BeamShape {
  static constexpr int kNodes = 20;        // of the smooth curve
  static constexpr int kFew = 3;           // of them are used by all other families
  static constexpr int kNodesOfAngle = 4;  // side by side, that tell the curve at one angle
  static constexpr double kSoft = 0.08;
  // Of f on the axis: most lamps are brightest there, some have a hole.
  static constexpr ParameterRule kAxialPrior = {true, 0.8, 0.6};
  BeamFamily family = BeamFamily::kEven;
  ReadFrom read_from{};
  double scale = 0.3, step = 0.1, bend = 0.1;  // of the smooth curve; scale in rad
  int kink = -1;  // node at which it may turn kKinkBends as much: a sharp peak; -1 none
  static constexpr double kKinkBends = 8.0;

  // Which parameters are free, under which prior.
  [[nodiscard]] std::array<ParameterRule, kNodes> Rules() const;
  // f, gamma in radians within 0 to pi.
  template <class T>
  [[nodiscard]] T Relative(const T& gamma, const T* p) const;
  // I(gamma) of a lamp whose light starts `offset` behind its place, over I(0) as read.
  template <class T>
  [[nodiscard]] T Intensity(const OffAxis<T>& towards, const T& offset, const T* p) const {
    if (family == BeamFamily::kEven) return T(1.0);
    const T a = read_from.AngleFromStart(towards, offset);
    return read_from.SquaresRatio(a, offset) * Relative(a, p);
  }
  // The first of the nodes that tell the smooth curve at an angle, radians.
  [[nodiscard]] std::size_t FirstNode(double gamma) const;
  // Rows about the smoothness of the curve.
  [[nodiscard]] std::size_t PriorRows() const { return family == BeamFamily::kSmooth ? kNodes : 0; }
  template <class T>
  [[nodiscard]] T PriorRow(std::size_t i, const T* p) const;
  [[nodiscard]] double LnPriorScale() const;
  // g of a relative intensity.
  [[nodiscard]] static double LatentOf(double relative);

 private:
  template <class T>
  [[nodiscard]] T Latent(const T& gamma, const T* p) const;
  // Where an angle lies among the nodes.
  template <class T>
  [[nodiscard]] T NodesAlong(const T& gamma) const {
    using std::log;
    using std::sqrt;
    const T u = gamma / scale;
    return log(u + sqrt(1.0 + u * u)) / step;
  }
};

template <class T>
T BeamShape::PriorRow(std::size_t i, const T* p) const {
  if (i == 0) return (p[0] - kAxialPrior.prior_mean) / kAxialPrior.prior_sd;
  const double own = static_cast<int>(i) == kink + 1 ? kKinkBends * bend : bend;
  // Twice as sure at the axis, where the node on the other side moves along.
  if (i == 1) return (p[1] - p[0]) / (0.5 * own);
  return (p[i] - 2.0 * p[i - 1] + p[i - 2]) / own;
}

template <class T>
T BeamShape::Latent(const T& gamma, const T* p) const {
  constexpr int kLast = kNodes - 1;
  const auto node = [p](int k) -> const T& { return p[std::abs(k)]; };
  const T x = NodesAlong(gamma);
  const double whole = std::floor(ScalarOf(x));
  if (!(whole < kLast)) {
    return node(kLast) + (node(kLast) - node(kLast - 1)) * (x - double{kLast});
  }
  const int i = std::max(0, static_cast<int>(whole));
  const T t = x - static_cast<double>(i);
  const T& before = node(i - 1);
  const T& left = node(i);
  const T& right = node(i + 1);
  const T after = i + 2 <= kLast ? node(i + 2) : T(2.0 * right - left);
  // Catmull and Rom's cubic.
  return left + 0.5 * t *
                    ((right - before) + t * ((2.0 * before - 5.0 * left + 4.0 * right - after) +
                                             t * (3.0 * (left - right) + after - before)));
}

template <class T>
T BeamShape::Relative(const T& gamma, const T* p) const {
  using std::cos;
  using std::exp;
  using std::log;
  if (family == BeamFamily::kEven) return T(1.0);
  if (family == BeamFamily::kSmooth) {
    const T g = Latent(gamma, p) / kSoft;
    return ScalarOf(g) > 30.0 ? T(kSoft * g) : T(kSoft * log(1.0 + exp(g)));
  }
  if (!(gamma < kQuarterTurn * 0.9999)) return T(0.0);
  const T h = AngleOf(p[0]);
  if (family == BeamFamily::kCone || family == BeamFamily::kDomedCone) {
    const T inner = h * LogisticOf(p[1]);
    const T s = HalfVersine(gamma);
    const T outer = HalfVersine(h);
    const T cone = SpotProfile(s, HalfVersine(inner), outer, SpotFalloff::kSquaredLinear);
    return family == BeamFamily::kCone ? cone : T(cone * (1.0 - LogisticOf(p[2]) * s / outer));
  }
  if (family == BeamFamily::kPeakedOrFlat) {
    if (!(gamma > 1e-6)) return T(1.0);
    return exp(-std::numbers::ln2 * exp(exp(p[1]) * (log(gamma) - log(h))));
  }
  // A beam so narrow that its cosine is 1 shines along its axis alone.
  const T ln_cosine_of_half = log(cos(h));
  if (!(ln_cosine_of_half < 0.0)) return T(gamma > 0.0 ? 0.0 : 1.0);
  const T cosine = log(cos(gamma)) / ln_cosine_of_half;
  if (family == BeamFamily::kCosinePower) return exp(-std::numbers::ln2 * cosine);
  const T w = LogisticOf(p[1]);
  const T x = gamma / h;
  return exp(-std::numbers::ln2 * (w * cosine + (1.0 - w) * x * x));
}

}  // namespace lightcal::fit
