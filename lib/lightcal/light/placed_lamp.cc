// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/placed_lamp.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <type_traits>

#include "lightcal/core/normal_mixture.h"

namespace lightcal {
namespace {

constexpr double kGround = 0.25;  // reflectance under a sky that nobody saw

template <class Source>
constexpr bool kHasLadder =
    std::is_same_v<Source, DiskSource> || std::is_same_v<Source, RectSource> ||
    std::is_same_v<Source, TubeSource>;
template <class Source>
constexpr bool kMovesAgainstAim =
    std::is_same_v<Source, DiskSource> || std::is_same_v<Source, RectSource> ||
    std::is_same_v<Source, SpotSource>;

// In the source's frame, with the source moved by d0.
template <class Source>
Receiver<double> ReceiverOf(const LampPose& pose, const SurfacePoint& at) {
  Receiver<double> out{pose.frame.Of(at.position_m - pose.position_m), pose.frame.Of(at.normal)};
  Vec3& p = out.position;
  if (pose.offset_m == 0.0) return out;
  if constexpr (kMovesAgainstAim<Source>) {
    p[2] += pose.offset_m;
  } else if constexpr (std::is_same_v<Source, TubeSource>) {
    const double away = std::hypot(p[1], p[2]);
    const double stretch = away > 0.0 ? std::max(0.0, 1.0 + pose.offset_m / away) : 1.0;
    p[1] *= stretch;
    p[2] *= stretch;
  } else {
    const double d = std::sqrt(Dot(p, p));
    if (d > 0.0) p = p * std::max(0.0, 1.0 + pose.offset_m / d);
  }
  return out;
}

double AsPoint(const DiskSource&, const Receiver<double>& at) {
  return models::FlatPointLuxPerCandela(at);
}
double AsPoint(const RectSource&, const Receiver<double>& at) {
  return models::FlatPointLuxPerCandela(at);
}
double AsPoint(const TubeSource&, const Receiver<double>& at) {
  return models::TubePointLuxPerCandela(at);
}

double TablePart(const TableSource& source, const Vec3& in_frame) {
  const IntensityTable& table = *source.table;
  return table.Towards({in_frame[0], in_frame[1], -in_frame[2]}) / table.peak().intensity;
}

// How a sky that nobody saw differs from EvenSky, 1 sigma over E_up: upright planes differ by where
// windows and clouds are, what comes from below by the ground.
double DoubtOfUnseen(const Vec3& normal) {
  constexpr double kUpright = 0.25;
  constexpr double kDownward = 0.15;
  const double upright = std::sqrt(std::max(0.0, 1.0 - normal[2] * normal[2]));
  return std::hypot(kUpright * upright, kDownward * 0.5 * (1.0 - normal[2]));
}

template <class Source>
double DirectLux(const Source& source, const LampPose& pose, const SurfacePoint& at,
                 const SourceDetail& detail) {
  if constexpr (std::is_same_v<Source, SunSource>) {
    const Vec3 toward = pose.frame.z * -1.0;
    return detail.point_only ? DirectionalFactor(at.normal, toward)
                             : SunFactor(at.normal, toward, source.angular_radius);
  } else if constexpr (std::is_same_v<Source, EvenSky>) {
    return 0.5 * ((1.0 + at.normal[2]) + kGround * (1.0 - at.normal[2]));
  } else if constexpr (std::is_same_v<Source, SeenSky>) {
    double sum = 0.0;
    for (const Vec3& flux : *source.flux) sum += std::max(0.0, Dot(at.normal, flux));
    return sum;
  } else {
    const Receiver<double> receiver = ReceiverOf<Source>(pose, at);
    if constexpr (kHasLadder<Source>) {
      if (detail.point_only) return AsPoint(source, receiver);
      return detail.tolerance > 0.0 ? LuxPerCandela(source, receiver, detail.tolerance)
                                    : LuxPerCandela(source, receiver);
    } else if constexpr (std::is_same_v<Source, SphereSource>) {
      return detail.point_only ? PointLuxPerCandela(receiver) : LuxPerCandela(source, receiver);
    } else if constexpr (std::is_same_v<Source, TableSource>) {
      const double even = PointLuxPerCandela(receiver);
      return even > 0.0 ? even * TablePart(source, receiver.position) : 0.0;
    } else {
      return LuxPerCandela(source, receiver);
    }
  }
}

// The frame with its aim turned about its own x and y by small angles.
SourceFrame Turned(const SourceFrame& frame, double about_x, double about_y) {
  const Vec3 z = frame.z + frame.x * about_y - frame.y * about_x;
  return SourceFrame::Facing(z * (1.0 / Length(z)), frame.x);
}

// Of the illuminance `here`, whose derivatives by the lamp's coordinates are `slope`.
double VarianceOfPlace(const PlaceDoubt& doubt, const Vec3& way, double here, const Vec3& slope) {
  constexpr int n = PlaceDoubt::kCount;
  const double length = Length(way);
  const Vec3 u = length > 0.0 ? way * (1.0 / length) - doubt.middle : Vec3{};
  const std::array<double, n> by = {here,        slope[0],    slope[1],   slope[2],
                                    here * u[0], here * u[1], here * u[2]};
  const double uneven = here * Dot(doubt.gradient, u);
  double variance = uneven * uneven;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) variance += by[i] * by[j] * doubt.covariance[i * n + j];
  }
  return variance;
}

// dE/dm of a flat lamp that shines by cos^m, m near 1, and of a tube by sin^m of the angle from its
// length: E ln of that cosine or sine, no lower than where no meter tells it.
double DoubtOfExponent(const PlacedLamp& lamp, const SurfacePoint& at) {
  constexpr double kLeast = 0.05;
  const bool tube = std::holds_alternative<TubeSource>(lamp.source);
  const Vec3 p = lamp.pose.frame.Of(at.position_m - lamp.pose.position_m);
  const double length = Length(p);
  if (!(length > 0.0)) return 0.0;
  const double part = (tube ? std::hypot(p[1], p[2]) : p[2]) / length;
  return lamp.doubt.exponent * LuxOf(lamp, at) * -std::log(std::clamp(part, kLeast, 1.0));
}

// As one of the things that the lamp may be has it: ln E at a place.
NormalPart LnLuxOf(const PlacedLamp& lamp, const LampPart& part, const SurfacePoint& at,
                   const SourceDetail& detail) {
  LampPose pose = lamp.pose;
  LampSource source = lamp.source;
  const Vec3 way = at.position_m - pose.position_m;
  if (part.width_m > 0.0 && Length(way) > 0.0) {
    source = RectSource{0.5 * part.width_m, 0.5 * part.height_m};
    pose.frame = SourceFrame::Facing(way * (1.0 / Length(way)), pose.frame.x);
  }
  const auto ln = [&](double offset_m) {
    pose.offset_m = offset_m;
    return std::log(LuxPerUnit(source, pose, at, detail));
  };
  const double here = ln(part.offset_m);
  NormalPart out{part.weight, part.ln_strength + here, std::sqrt(part.variance_ln)};
  if (!(part.variance_offset > 0.0) || !std::isfinite(here)) return out;
  // Over a step within which its light cannot start behind the meter.
  constexpr double kStep = 1e-3;
  const double step = kStep * std::sqrt(part.variance_offset);
  const double slope = (ln(part.offset_m + step) - ln(part.offset_m - step)) / (2.0 * step);
  const double variance =
      part.variance_ln + slope * slope * part.variance_offset + 2.0 * slope * part.covariance;
  out.sd = std::sqrt(std::max(0.0, variance));
  return out;
}

// Absent where they leave the place dark.
std::optional<double> VarianceOfParts(const PlacedLamp& lamp, const SurfacePoint& at,
                                      const SourceDetail& detail) {
  std::vector<NormalPart> parts;
  for (const LampPart& part : lamp.doubt.parts) {
    parts.push_back(LnLuxOf(lamp, part, at, detail));
    if (!std::isfinite(parts.back().mean) || !std::isfinite(parts.back().sd)) parts.pop_back();
  }
  if (parts.empty()) return std::nullopt;
  const double sd = UncertainFromLogMixture(parts).u95 / kZ95;
  return sd * sd;
}

}  // namespace

double LuxPerUnit(const LampSource& source, const LampPose& pose, const SurfacePoint& at,
                  const SourceDetail& detail) {
  return std::visit([&](const auto& s) { return DirectLux(s, pose, at, detail); }, source);
}

double SolidAngleOf(const LampSource& source) {
  if (const auto* spot = std::get_if<SpotSource>(&source)) {
    return SolidAngleOfSpot(spot->cone, spot->falloff).value();
  }
  if (const auto* table = std::get_if<TableSource>(&source)) {
    return table->table->Flux().value() / table->table->peak().intensity.value();
  }
  if (std::holds_alternative<TubeSource>(source)) return std::numbers::pi * std::numbers::pi;
  if (std::holds_alternative<DiskSource>(source) || std::holds_alternative<RectSource>(source)) {
    return std::numbers::pi;
  }
  return 4.0 * std::numbers::pi;
}

bool IsSky(const LampSource& source) {
  return std::holds_alternative<EvenSky>(source) || std::holds_alternative<SeenSky>(source);
}

bool IsEverywhere(const LampSource& source) {
  return std::holds_alternative<SunSource>(source) || IsSky(source);
}

std::optional<Vec3> DirectionToLamp(const PlacedLamp& lamp, const Vec3& position_m) {
  if (IsSky(lamp.source)) return std::nullopt;
  const bool sun = std::holds_alternative<SunSource>(lamp.source);
  const Vec3 way = sun ? lamp.pose.frame.z * -1.0 : lamp.pose.position_m - position_m;
  const double length = Length(way);
  return length > 0.0 ? std::optional(way * (1.0 / length)) : std::nullopt;
}

double DoubtOfLux(const PlacedLamp& lamp, const SurfacePoint& at, const SourceDetail& detail) {
  const LampDoubt& doubt = lamp.doubt;
  const auto lux = [&](const LampSource& source, const LampPose& pose) {
    return lamp.strength * LuxPerUnit(source, pose, at, detail);
  };
  double variance = 0.0;
  // Half of what a step of one standard deviation both ways changes.
  const auto add = [&](double sd, const auto& moved) {
    if (!(sd > 0.0)) return;
    const double half = 0.5 * (moved(sd) - moved(-sd));
    variance += half * half;
  };
  const double here = lux(lamp.source, lamp.pose);
  const bool everywhere = IsEverywhere(lamp.source);
  const std::optional<double> of_parts = VarianceOfParts(lamp, at, detail);
  if (of_parts) variance += *of_parts;
  if (!of_parts && !doubt.place) variance += here * here * doubt.variance_ln;
  if (doubt.variance_offset > 0.0 && !everywhere && !of_parts) {
    const double sd = std::sqrt(doubt.variance_offset);
    const auto moved = [&](double by) {
      LampPose pose = lamp.pose;
      pose.offset_m += by;
      return lux(lamp.source, pose);
    };
    const double half = 0.5 * (moved(sd) - moved(-sd));
    variance += half * half + 2.0 * here * (half / sd) * doubt.covariance;
  }
  if (doubt.place) {
    Vec3 slope{};
    for (int axis = 0; axis < 3 && !everywhere; ++axis) {
      const double sd = std::sqrt(doubt.place->covariance[(axis + 1) * (PlaceDoubt::kCount + 1)]);
      const auto moved = [&](double by) {
        LampPose pose = lamp.pose;
        pose.position_m[axis] += by;
        return lux(lamp.source, pose);
      };
      if (sd > 0.0) slope[axis] = (moved(sd) - moved(-sd)) / (2.0 * sd);
    }
    variance += VarianceOfPlace(*doubt.place, at.position_m - lamp.pose.position_m, here, slope);
  }
  for (const bool about_x : {true, false}) {
    add(doubt.aim_rad, [&](double by) {
      LampPose pose = lamp.pose;
      pose.frame = Turned(pose.frame, about_x ? by : 0.0, about_x ? 0.0 : by);
      return lux(lamp.source, pose);
    });
  }
  if (const auto* spot = std::get_if<SpotSource>(&lamp.source)) {
    const auto cone = [&](double inner, double outer) {
      SpotSource moved = *spot;
      moved.cone.outer = Radians(std::max(1e-6, spot->cone.outer.value() + outer));
      moved.cone.inner =
          Radians(std::clamp(spot->cone.inner.value() + inner, 0.0, moved.cone.outer.value()));
      return lux(LampSource(moved), lamp.pose);
    };
    add(doubt.inner_rad, [&](double by) { return cone(by, 0.0); });
    add(doubt.outer_rad, [&](double by) { return cone(0.0, by); });
  }
  const double pattern = DoubtOfPattern(lamp, at);
  variance += pattern * pattern;
  if (std::holds_alternative<EvenSky>(lamp.source)) {
    const double unseen = lamp.strength * DoubtOfUnseen(at.normal);
    variance += unseen * unseen;
  }
  return std::sqrt(std::max(0.0, variance));
}

double DoubtOfPattern(const PlacedLamp& lamp, const SurfacePoint& at) {
  if (lamp.doubt.exponent > 0.0) return DoubtOfExponent(lamp, at);
  if (!lamp.doubt.pattern || IsEverywhere(lamp.source)) return 0.0;
  const Receiver<double> receiver = ReceiverOf<PointSource>(lamp.pose, at);
  const double even = PointLuxPerCandela(receiver);
  if (!(even > 0.0)) return 0.0;
  const Vec3& p = receiver.position;
  return lamp.strength * even * lamp.doubt.pattern->At(std::atan2(std::hypot(p[0], p[1]), p[2]));
}

double DoubtOfLnFlux(const PlacedLamp& lamp) {
  const LampDoubt& doubt = lamp.doubt;
  double variance = doubt.place ? 0.0 : doubt.variance_ln;
  if (!doubt.parts.empty()) {
    std::vector<NormalPart> parts;
    for (const LampPart& part : doubt.parts) {
      parts.push_back({part.weight, part.ln_strength, std::sqrt(part.variance_ln)});
    }
    const double sd = UncertainFromLogMixture(parts).u95 / kZ95;
    variance = sd * sd / (lamp.strength * lamp.strength);
  }
  variance += doubt.variance_ln_flux;
  if (!doubt.place) return std::sqrt(variance);
  constexpr int n = PlaceDoubt::kCount;
  const Vec3& middle = doubt.place->middle;
  const std::array<double, n> by = {1.0, 0.0, 0.0, 0.0, -middle[0], -middle[1], -middle[2]};
  const double uneven = Dot(doubt.place->gradient, middle);
  variance += uneven * uneven;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) variance += by[i] * by[j] * doubt.place->covariance[i * n + j];
  }
  return std::sqrt(std::max(0.0, variance));
}

}  // namespace lightcal
