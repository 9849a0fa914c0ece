// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/beam_ensemble.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <numbers>
#include <utility>
#include <vector>

#include "lightcal/core/uncertain.h"

namespace lightcal {
namespace {

constexpr double kSpillShare = 1.0 / 3.0;  // of the flux, in the widest beam-only member

// 2 pi int_0^{pi/2} f(t) sin t dt, composite Simpson.
double SolidAngle(const std::function<double(double)>& relative_intensity) {
  constexpr int kSteps = 2000;
  const double h = 0.5 * std::numbers::pi / kSteps;
  double sum = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const int weight = (i == 0 || i == kSteps) ? 1 : (i % 2 == 1 ? 4 : 2);
    sum += weight * relative_intensity(i * h) * std::sin(i * h);
  }
  return 2.0 * std::numbers::pi * sum * h / 3.0;
}

BeamSolidAngles Range(std::initializer_list<double> members) {
  return {Steradians(std::min(members)), Steradians(std::max(members))};
}

// n of the cos^n that halves at `half`.
double CosineExponent(double half) { return std::log(0.5) / std::log(std::cos(half)); }

BeamSolidAngles FromBeam(double half) {
  const double exponent = CosineExponent(half);
  const double uniform = 2.0 * std::numbers::pi * (1.0 - std::cos(half));
  const double cosine = 2.0 * std::numbers::pi / (exponent + 1.0);
  const double gaussian = SolidAngle(
      [half](double t) { return std::exp(-std::numbers::ln2 * (t / half) * (t / half)); });
  return Range({uniform, cosine, gaussian, cosine / (1.0 - kSpillShare)});
}

using Shape = std::function<double(double)>;

std::array<Shape, 3> ShapesThrough(double half, double tenth) {
  const double ratio = std::log(tenth / half);
  const double p = std::log(std::numbers::ln10 / std::numbers::ln2) / ratio;
  const double q = std::log(9.0) / ratio;
  return {[=](double t) { return std::exp(-std::numbers::ln2 * std::pow(t / half, p)); },
          [=](double t) { return 1.0 / (1.0 + std::pow(t / half, q)); },
          [=](double t) { return std::clamp(0.5 - 0.4 * (t - half) / (tenth - half), 0.0, 1.0); }};
}

BeamSolidAngles FromBeamAndField(double half, double tenth) {
  const auto shapes = ShapesThrough(half, tenth);
  return Range({SolidAngle(shapes[0]), SolidAngle(shapes[1]), SolidAngle(shapes[2])});
}

// As much of b beside a as makes the solid angle `wanted`.
RelativeIntensity Mixed(Shape a, double of_a, Shape b, double of_b, double wanted) {
  const double share = of_b > of_a ? std::clamp((wanted - of_a) / (of_b - of_a), 0.0, 1.0) : 0.0;
  return [a = std::move(a), b = std::move(b), share](Radians theta) {
    const double t = theta.value();
    if (t > 0.5 * std::numbers::pi) return 0.0;
    return (1.0 - share) * a(t) + share * b(t);
  };
}

}  // namespace

Result<BeamSolidAngles> BeamEnsemble(Radians beam, std::optional<Radians> field) {
  const double half = 0.5 * beam.value();
  if (!(half > 0.0) || !(half < RadiansFromDegrees(85.0).value())) {
    return Refused("bad_beam", "beam_deg", "the beam angle must lie between 0 and 170 degrees");
  }
  if (!field) return FromBeam(half);
  const double tenth = 0.5 * field->value();
  if (!(tenth > half) || !(tenth <= 0.5 * std::numbers::pi)) {
    return Refused("bad_beam", "field_deg",
                   "the field angle (10 % of the peak) must exceed the beam angle (50 %) and stay "
                   "within 180 degrees");
  }
  return FromBeamAndField(half, tenth);
}

std::optional<RelativeIntensity> BeamOf(Radians beam, std::optional<Radians> field,
                                        Steradians flux_per_candela) {
  if (!BeamEnsemble(beam, field)) return std::nullopt;
  const double half = 0.5 * beam.value(), wanted = flux_per_candela.value();
  if (field) {
    auto shapes = ShapesThrough(half, 0.5 * field->value());
    std::ranges::sort(shapes, {}, &SolidAngle);
    const double least = SolidAngle(shapes[0]), most = SolidAngle(shapes[2]);
    return Mixed(std::move(shapes[0]), least, std::move(shapes[2]), most, wanted);
  }
  const double c = std::cos(half);
  const double exponent = CosineExponent(half);
  return Mixed([=](double t) { return std::pow(std::max(0.0, std::cos(t)), exponent); },
               2.0 * std::numbers::pi / (exponent + 1.0),
               [=](double t) { return 0.5 + 0.5 * std::max(0.0, (std::cos(t) - c) / (1.0 - c)); },
               std::numbers::pi * (1.0 + 0.5 * (1.0 - c)), wanted);
}

RelativeIntensity DoubtOfBeams(Radians beam, std::optional<Radians> field,
                               RelativeIntensity drawn) {
  const double half = 0.5 * beam.value();
  std::vector<Shape> members;
  if (field) {
    for (Shape& shape : ShapesThrough(half, 0.5 * field->value())) {
      members.push_back(std::move(shape));
    }
  } else {
    const double n = CosineExponent(half);
    members = {[half](double t) { return t < half ? 1.0 : 0.0; },
               [half](double t) { return std::exp2(-(t / half) * (t / half)); },
               [n](double t) { return std::pow(std::max(0.0, std::cos(t)), n); }};
    if (const auto widest = BeamOf(beam, field, FromBeam(half).most)) {
      members.emplace_back([widest = *widest](double t) { return widest(Radians(t)); });
    }
  }
  return [members = std::move(members), drawn = std::move(drawn)](Radians theta) {
    double farthest = 0.0;
    for (const Shape& member : members) {
      farthest = std::max(farthest, std::abs(member(theta.value()) - drawn(theta)));
    }
    return farthest / kZ95;
  };
}

}  // namespace lightcal
