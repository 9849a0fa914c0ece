// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lightcal/fit/states/ln_of.h"
#include "lightcal/fit/states/split_geometries.h"
#include "lightcal/fit/states/state_answer.h"

namespace lightcal {
namespace {

using fit::SameGeometry;
using fit::Scaled;
using fit::SdOfLn;

// A zoom whose cone is known, and the flux of one candela there.
struct KnownCone {
  double zoom = 0.0;
  LightKind kind = LightKind::kPoint;
  std::optional<double> inner_deg{}, outer_deg{}, inner_u95_deg{}, outer_u95_deg{};
  std::optional<Uncertain> offset{};
  std::optional<double> flux_per_candela{};
  bool plain = true;  // a cone, no table and no size that changes
};

template <class Shaped>
KnownCone ConeOf(const Shaped& shaped, const std::optional<Uncertain>& intensity) {
  KnownCone cone;
  cone.zoom = NumberOfControl(shaped.state, kZoomControl).value_or(0.0);
  cone.kind = shaped.kind;
  cone.inner_deg = shaped.inner_deg;
  cone.outer_deg = shaped.outer_deg;
  cone.inner_u95_deg = shaped.inner_u95_deg;
  cone.outer_u95_deg = shaped.outer_u95_deg;
  cone.offset = shaped.distance_offset_m;
  cone.plain = !shaped.distribution && !shaped.beam;
  if (shaped.flux_lm && intensity && intensity->value > 0.0) {
    cone.flux_per_candela = shaped.flux_lm->value / intensity->value;
  }
  return cone;
}

const MeasuredState* ReadAt(const FittedLight& light, const FixtureState& state) {
  const auto found = std::ranges::find_if(
      light.states, [&](const MeasuredState& one) { return SameState(one.state, state); });
  return found == light.states.end() ? nullptr : &*found;
}

// The nearest known zooms on both sides, of the same words.
std::optional<std::pair<KnownCone, KnownCone>> Neighbours(const FittedLight& light,
                                                          const FixtureState& at, double zoom) {
  std::vector<KnownCone> known;
  if (SameWords(at, light.state)) known.push_back(ConeOf(light, light.intensity_cd));
  for (const StateGeometry& one : light.geometries) {
    const MeasuredState* read = ReadAt(light, one.state);
    if (read != nullptr && SameWords(at, one.state)) {
      known.push_back(ConeOf(one, read->intensity_cd));
    }
  }
  const KnownCone* below = nullptr;
  const KnownCone* above = nullptr;
  for (const KnownCone& one : known) {
    if (!(one.zoom > 0.0)) return std::nullopt;
    if (one.zoom < zoom && (below == nullptr || one.zoom > below->zoom)) below = &one;
    if (one.zoom > zoom && (above == nullptr || one.zoom < above->zoom)) above = &one;
  }
  if (below == nullptr || above == nullptr) return std::nullopt;
  const bool alike = below->kind == above->kind && below->plain && above->plain &&
                     below->outer_deg && above->outer_deg;
  if (!alike) return std::nullopt;
  return std::pair(*below, *above);
}

// Between two angles in their logarithms; both known within u95, and the way between them within a
// quarter of it.
struct Angle {
  double deg = 0.0, u95 = 0.0;
};
Angle AngleBetween(double a, double b, double u95, double share) {
  const double floor = 0.01;  // of a degree: a cone may be even up to its edge
  const double deg =
      std::exp((1.0 - share) * std::log(std::max(a, floor)) + share * std::log(std::max(b, floor)));
  return {deg, std::hypot(u95, share * (1.0 - share) * (b - a))};
}

StateGeometry Between(const KnownCone& a, const KnownCone& b, double zoom,
                      const Uncertain& intensity) {
  const double share = std::log(zoom / a.zoom) / std::log(b.zoom / a.zoom);
  const double bend = share * (1.0 - share);
  StateGeometry out;
  out.kind = a.kind;
  const auto wider = [](const std::optional<double>& x, const std::optional<double>& y) {
    return std::max(x.value_or(0.0), y.value_or(0.0));
  };
  const Angle outer =
      AngleBetween(*a.outer_deg, *b.outer_deg, wider(a.outer_u95_deg, b.outer_u95_deg), share);
  out.outer_deg = outer.deg;
  out.outer_u95_deg = outer.u95;
  if (a.inner_deg && b.inner_deg) {
    const Angle inner =
        AngleBetween(*a.inner_deg, *b.inner_deg, wider(a.inner_u95_deg, b.inner_u95_deg), share);
    out.inner_deg = std::min(inner.deg, outer.deg);
    out.inner_u95_deg = inner.u95;
  }
  if (a.offset && b.offset) {
    const double from = a.offset->value;
    const double to = b.offset->value;
    out.distance_offset_m =
        Uncertain{from + share * (to - from),
                  std::hypot(std::max(a.offset->u95, b.offset->u95), bend * (to - from)),
                  {},
                  {}};
  }
  if (a.flux_per_candela && b.flux_per_candela) {
    const double ln_a = std::log(*a.flux_per_candela);
    const double step = std::log(*b.flux_per_candela) - ln_a;
    out.flux_lm = Scaled(intensity, ln_a + share * step, bend * std::abs(step) / kZ95);
  }
  return out;
}

}  // namespace

GeometryOfState GeometryAt(const FittedLight& light, const FixtureState& at,
                           const std::optional<Uncertain>& intensity_cd) {
  const bool lights = !light.distance_offset_m || SameGeometry(light.state, at);
  const auto own = std::ranges::find_if(
      light.geometries, [&](const StateGeometry& one) { return SameGeometry(one.state, at); });
  if (own != light.geometries.end()) {
    GeometryOfState out{GeometryBasis::kOwn, *own};
    const MeasuredState* read = ReadAt(light, own->state);
    if (read != nullptr && read->intensity_cd && intensity_cd && !SameState(own->state, at)) {
      const double ln = std::log(intensity_cd->value / read->intensity_cd->value);
      const double of_scale = SdOfLn(*read->intensity_cd);
      const double sd =
          std::sqrt(std::max(0.0, std::pow(SdOfLn(*intensity_cd), 2.0) - of_scale * of_scale));
      StateGeometry& there = out.geometry;
      there.flux_lm = Scaled(there.flux_lm, ln, sd);
      there.luminance_nits = Scaled(there.luminance_nits, ln, sd);
      if (there.beam) there.beam->axial = Scaled(there.beam->axial, ln, sd);
      if (there.distribution) {
        there.distribution->table = there.distribution->table.Scaled(std::exp(ln));
      }
    }
    out.geometry.state = at;
    return out;
  }
  if (lights) return {GeometryBasis::kLights, {}};
  const auto zoom = NumberOfControl(at, kZoomControl);
  if (!zoom || !intensity_cd || !(*zoom > 0.0)) return {};
  const auto neighbours = Neighbours(light, at, *zoom);
  if (!neighbours) return {};
  return {GeometryBasis::kBetween,
          Between(neighbours->first, neighbours->second, *zoom, *intensity_cd)};
}

}  // namespace lightcal
