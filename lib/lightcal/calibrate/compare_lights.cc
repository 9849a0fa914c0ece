// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/compare_lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"

namespace lightcal {
namespace {

// Numbers go through text with 17 digits; what differs by less than this is rounding.
constexpr double kRounding = 1e-12;
// 95 % quantiles of the length of 1, 2, 3 standard normals (chi distribution).
constexpr std::array<double, 4> kChi95 = {0.0, 1.959964, 2.447747, 2.795483};

bool IsRounding(double difference, double size) {
  return std::abs(difference) <= kRounding * std::max(1.0, std::abs(size));
}

// The half width on the side where `other` lies.
double HalfWidthTowards(const Uncertain& u, double other) {
  if (other > u.value) return u.high ? *u.high - u.value : u.u95;
  return u.low ? u.value - *u.low : u.u95;
}

// What two solvers' ends of one problem differ by, of a half width.
constexpr double kSolved = 1e-3;

double Combined(double ua, double ub, double correlation) {
  const double common = std::sqrt(std::max(0.0, ua * ua + ub * ub - 2.0 * correlation * ua * ub));
  return std::max(common, kSolved * std::max(ua, ub));
}

Change Judged(double difference, double size, double u95, bool u_known) {
  if (IsRounding(difference, size)) return Change::kSame;
  if (!u_known) return Change::kWithoutU;
  return std::abs(difference) > u95 ? Change::kChanged : Change::kWithin;
}

class Comparer {
 public:
  // gain: 1 sigma of the relative error that both sides' light has in common.
  Comparer(double correlation, double gain, LightChange& into)
      : correlation_(correlation), gain_(gain), into_(into) {}

  // A quantity proportional to the lamp's light.
  void Light(std::string quantity, std::string unit, const std::optional<Uncertain>& a,
             const std::optional<Uncertain>& b) {
    Values(std::move(quantity), std::move(unit), a, b, gain_);
  }

  void Values(std::string quantity, std::string unit, const std::optional<Uncertain>& a,
              const std::optional<Uncertain>& b, double gain = 0.0) {
    if (!a || !b) return;
    QuantityChange change{std::move(quantity), std::move(unit), true, *a, *b};
    change.difference = b->value - a->value;
    const double ua = HalfWidthTowards(*a, b->value), ub = HalfWidthTowards(*b, a->value);
    const double common = std::min(ua, kZ95 * gain * std::abs(a->value)) *
                          std::min(ub, kZ95 * gain * std::abs(b->value));
    const double correlation = common > 0.0 ? common / (ua * ub) : correlation_;
    change.u95 = Combined(ua, ub, correlation);
    change.change = Judged(change.difference, a->value, change.u95, a->u95 > 0.0 || b->u95 > 0.0);
    into_.quantities.push_back(std::move(change));
  }

  void Values(std::string quantity, std::string unit, const std::optional<double>& a,
              const std::optional<double>& b, const std::optional<double>& ua = {},
              const std::optional<double>& ub = {}) {
    if (!a || !b) return;
    Values(std::move(quantity), std::move(unit), Uncertain{*a, ua.value_or(0.0), {}, {}},
           Uncertain{*b, ub.value_or(0.0), {}, {}});
  }

  // A difference that is a distance; size: of what it is measured in.
  void Distance(std::string quantity, std::string unit, double difference, double u95,
                bool u_known) {
    QuantityChange change{std::move(quantity), std::move(unit), false, {}, {}};
    change.difference = difference;
    change.u95 = u95;
    change.change = Judged(difference, 1.0, u95, u_known);
    into_.quantities.push_back(std::move(change));
  }

  void Position(const FittedLight& a, const FittedLight& b) {
    if (!a.position_m || !b.position_m) return;
    const Vec3 none{};
    const Vec3 ua = a.position_u95_m.value_or(none);
    const Vec3 ub = b.position_u95_m.value_or(none);
    double squares = 0.0;  // of each coordinate's difference in its own u95
    std::size_t unsure = 0;
    bool beyond_doubt = false;  // a coordinate that both state differs
    for (std::size_t k = 0; k < 3; ++k) {
      const double d = (*b.position_m)[k] - (*a.position_m)[k];
      const double u = Combined(ua[k], ub[k], correlation_);
      if (u > 0.0) {
        squares += d * d / (u * u);
        ++unsure;
      } else if (!IsRounding(d, 1.0)) {
        beyond_doubt = true;
      }
    }
    const double distance = Length(*b.position_m - *a.position_m);
    const bool known = unsure > 0 && !beyond_doubt;
    const double u95 =
        known && squares > 0.0 ? distance / std::sqrt(squares) * kChi95[unsure] / kChi95[1] : 0.0;
    Distance("position_m", "m", distance, u95, known);
  }

  void Aim(const FittedLight& a, const FittedLight& b) {
    if (!a.aim || !b.aim) return;
    const double cosine = Dot(*a.aim, *b.aim) / (Length(*a.aim) * Length(*b.aim));
    const double sine = Length(Cross(*a.aim, *b.aim)) / (Length(*a.aim) * Length(*b.aim));
    const double angle_deg = DegreesFromRadians(Radians(std::atan2(sine, cosine)));
    const double u95 =
        Combined(a.aim_u95_deg.value_or(0.0), b.aim_u95_deg.value_or(0.0), correlation_);
    Distance("aim", "deg", angle_deg, u95, u95 > 0.0);
  }

  // Only where no CCT tells: xy carries no uncertainty of its own.
  void Chromaticity(const FittedColor& a, const FittedColor& b) {
    if (!a.xy || !b.xy || (a.cct_K && b.cct_K)) return;
    const auto [ua, va] = Uv1976FromXy(*a.xy);
    const auto [ub, vb] = Uv1976FromXy(*b.xy);
    Distance("color.uv1976", "", std::hypot(ub - ua, vb - va), 0.0, false);
  }

 private:
  double correlation_;
  double gain_;
  LightChange& into_;
};

void CompareStates(const FittedLight& a, const FittedLight& b, Comparer& compare) {
  for (const MeasuredState& one : a.states) {
    const auto other = std::ranges::find_if(
        b.states, [&](const MeasuredState& there) { return SameState(there.state, one.state); });
    // The light itself tells of a reference that both share.
    const bool reference = SameState(one.state, a.state) && SameState(a.state, b.state);
    if (other == b.states.end() || reference) continue;
    const std::string of = "states[" + StateText(one.state) + "].";
    compare.Light(of + "intensity_cd", "cd", one.intensity_cd, other->intensity_cd);
    compare.Light(of + "illuminance_lx", "lx", one.illuminance_lx, other->illuminance_lx);
    compare.Values(of + "color.cct_K", "K", one.color.cct_K, other->color.cct_K);
  }
}

LightChange Compared(const FittedLight& a, const FittedLight& b,
                     std::optional<double> correlation) {
  LightChange change;
  change.name = a.name == b.name ? a.name : a.name + " -> " + b.name;
  change.kind_changed = a.kind != b.kind;
  const bool one_meter = !correlation && a.meter && b.meter && !a.meter->name.empty() &&
                         a.meter->name == b.meter->name;
  double gain = 0.0;
  if (one_meter) gain = std::min(a.meter->calibration_relative, b.meter->calibration_relative);
  if (gain > 0.0) change.common_meter = a.meter->name;
  Comparer compare(correlation.value_or(0.0), gain, change);
  // At different references the lights themselves are not one thing; their common states are.
  if (!SameState(a.state, b.state) && !a.state.empty() && !b.state.empty()) {
    CompareStates(a, b, compare);
    return change;
  }
  compare.Light("intensity_cd", "cd", a.intensity_cd, b.intensity_cd);
  compare.Light("flux_lm", "lm", a.flux_lm, b.flux_lm);
  compare.Light("illuminance_lx", "lx", a.illuminance_lx, b.illuminance_lx);
  compare.Light("luminance_nits", "cd/m²", a.luminance_nits, b.luminance_nits);
  compare.Values("color.cct_K", "K", a.color.cct_K, b.color.cct_K);
  compare.Values("color.duv", "", a.color.duv, b.color.duv);
  compare.Chromaticity(a.color, b.color);
  compare.Values("distance_offset_m", "m", a.distance_offset_m, b.distance_offset_m);
  compare.Values("ambient_lx", "lx", a.ambient_lx, b.ambient_lx);
  compare.Values("cone.inner_deg", "deg", a.inner_deg, b.inner_deg, a.inner_u95_deg,
                 b.inner_u95_deg);
  compare.Values("cone.outer_deg", "deg", a.outer_deg, b.outer_deg, a.outer_u95_deg,
                 b.outer_u95_deg);
  compare.Values("diameter_m", "m", a.diameter_m, b.diameter_m);
  compare.Values("width_m", "m", a.width_m, b.width_m);
  compare.Values("height_m", "m", a.height_m, b.height_m);
  compare.Values("length_m", "m", a.length_m, b.length_m);
  compare.Values("radius_m", "m", a.radius_m, b.radius_m);
  compare.Position(a, b);
  compare.Aim(a, b);
  CompareStates(a, b, compare);
  return change;
}

void FindSharedInputs(const Provenance& a, const Provenance& b, LightComparison& comparison) {
  for (const InputFile& file : a.inputs) {
    if (std::ranges::find(b.inputs, file.sha256, &InputFile::sha256) != b.inputs.end()) {
      comparison.shared_inputs.push_back(file.path);
    }
  }
  const std::size_t shared = comparison.shared_inputs.size();
  comparison.same_inputs = shared > 0 && shared == a.inputs.size() && shared == b.inputs.size();
}

LightChange OnlyIn(const FittedLight& light, bool before) {
  LightChange change;
  change.name = light.name;
  change.before = before;
  change.after = !before;
  return change;
}

}  // namespace

bool LightChange::Changed() const {
  const bool any = std::ranges::any_of(quantities, [](const QuantityChange& q) {
    return q.change == Change::kChanged || q.change == Change::kWithoutU;
  });
  return any || kind_changed || !before || !after;
}

bool LightComparison::Changed() const { return std::ranges::any_of(lights, &LightChange::Changed); }

LightComparison CompareLights(const LightFile& a, const LightFile& b,
                              std::optional<double> correlation) {
  LightComparison comparison;
  FindSharedInputs(a.provenance, b.provenance, comparison);
  if (a.lights.size() == 1 && b.lights.size() == 1) {
    comparison.lights.push_back(Compared(a.lights[0], b.lights[0], correlation));
    return comparison;
  }
  for (const FittedLight& light : a.lights) {
    const auto other = std::ranges::find(b.lights, light.name, &FittedLight::name);
    comparison.lights.push_back(other == b.lights.end() ? OnlyIn(light, true)
                                                        : Compared(light, *other, correlation));
  }
  for (const FittedLight& light : b.lights) {
    if (std::ranges::find(a.lights, light.name, &FittedLight::name) == a.lights.end()) {
      comparison.lights.push_back(OnlyIn(light, false));
    }
  }
  return comparison;
}

}  // namespace lightcal
