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

// n of the cos^n that halves at `half`.
double CosineExponent(double half) { return std::log(0.5) / std::log(std::cos(half)); }

using Shape = std::function<double(double)>;  // of the angle from the axis; 1 on it

struct Member {
  Shape shape;
  double solid_angle = 0.0;
};

// As much of b beside a as makes the solid angle `wanted`.
Shape Mixed(Member a, Member b, double wanted) {
  const double from = a.solid_angle, to = b.solid_angle;
  const double share = to > from ? std::clamp((wanted - from) / (to - from), 0.0, 1.0) : 0.0;
  return [a = std::move(a.shape), b = std::move(b.shape), share](double t) {
    if (t > 0.5 * std::numbers::pi) return 0.0;
    return (1.0 - share) * a(t) + share * b(t);
  };
}

Member CosinePower(double half) {
  const double n = CosineExponent(half);
  return {[n](double t) { return std::pow(std::max(0.0, std::cos(t)), n); },
          2.0 * std::numbers::pi / (n + 1.0)};
}

// The beam with spill all around it, so much that they make the solid angle `wanted`.
Shape WithSpill(double half, double wanted) {
  const double c = std::cos(half);
  return Mixed(CosinePower(half),
               {[c](double t) { return 0.5 + 0.5 * std::max(0.0, (std::cos(t) - c) / (1.0 - c)); },
                std::numbers::pi * (1.0 + 0.5 * (1.0 - c))},
               wanted);
}

std::vector<Member> MembersOfBeam(double half) {
  const Shape gaussian = [half](double t) {
    return std::exp(-std::numbers::ln2 * (t / half) * (t / half));
  };
  Member cosine = CosinePower(half);
  const double spilling = cosine.solid_angle / (1.0 - kSpillShare);
  return {{[half](double t) { return t < half ? 1.0 : 0.0; },
           2.0 * std::numbers::pi * (1.0 - std::cos(half))},
          std::move(cosine),
          {gaussian, SolidAngle(gaussian)},
          {WithSpill(half, spilling), spilling}};
}

std::vector<Member> MembersOfBeamAndField(double half, double tenth) {
  const double ratio = std::log(tenth / half);
  const double p = std::log(std::numbers::ln10 / std::numbers::ln2) / ratio;
  const double q = std::log(9.0) / ratio;
  std::vector<Member> members;
  for (Shape shape :
       {Shape([=](double t) { return std::exp(-std::numbers::ln2 * std::pow(t / half, p)); }),
        Shape([=](double t) { return 1.0 / (1.0 + std::pow(t / half, q)); }), Shape([=](double t) {
          return std::clamp(0.5 - 0.4 * (t - half) / (tenth - half), 0.0, 1.0);
        })}) {
    const double solid_angle = SolidAngle(shape);
    members.push_back({std::move(shape), solid_angle});
  }
  return members;
}

// What beams of such angles are like, from the least solid angle to the most.
std::vector<Member> MembersOf(Radians beam, std::optional<Radians> field) {
  const double half = 0.5 * beam.value();
  auto members = field ? MembersOfBeamAndField(half, 0.5 * field->value()) : MembersOfBeam(half);
  std::ranges::stable_sort(members, {}, &Member::solid_angle);
  return members;
}

Result<void> CheckAngles(Radians beam, std::optional<Radians> field) {
  const double half = 0.5 * beam.value();
  if (!(half > 0.0) || !(beam < kWidestBeam)) {
    return Refused("bad_beam", "beam_deg", "the beam angle must lie between 0 and 170 degrees");
  }
  if (!field) return {};
  const double tenth = 0.5 * field->value();
  if (!(tenth > half) || !(tenth <= 0.5 * std::numbers::pi)) {
    return Refused("bad_beam", "field_deg",
                   "the field angle (10 % of the peak) must exceed the beam angle (50 %) and stay "
                   "within 180 degrees");
  }
  return {};
}

}  // namespace

Result<BeamSolidAngles> BeamEnsemble(Radians beam, std::optional<Radians> field) {
  if (auto ok = CheckAngles(beam, field); !ok) return Propagate(std::move(ok));
  const auto members = MembersOf(beam, field);
  return BeamSolidAngles{Steradians(members.front().solid_angle),
                         Steradians(members.back().solid_angle)};
}

std::optional<RelativeIntensity> BeamOf(Radians beam, std::optional<Radians> field,
                                        Steradians flux_per_candela) {
  if (!CheckAngles(beam, field)) return std::nullopt;
  Shape shape;
  if (field) {
    auto members = MembersOf(beam, field);
    shape = Mixed(std::move(members.front()), std::move(members.back()), flux_per_candela.value());
  } else {
    shape = WithSpill(0.5 * beam.value(), flux_per_candela.value());
  }
  return [shape = std::move(shape)](Radians theta) { return shape(theta.value()); };
}

RelativeIntensity DoubtOfBeams(Radians beam, std::optional<Radians> field,
                               RelativeIntensity drawn) {
  return [members = MembersOf(beam, field), drawn = std::move(drawn)](Radians theta) {
    double farthest = 0.0;
    for (const Member& member : members) {
      farthest = std::max(farthest, std::abs(member.shape(theta.value()) - drawn(theta)));
    }
    return farthest / kZ95;
  };
}

}  // namespace lightcal
