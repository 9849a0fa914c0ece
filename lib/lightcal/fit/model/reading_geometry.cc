// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/reading_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/vec3.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/light/lamp_axes.h"

namespace lightcal::fit {
namespace {

// Nearer than this no meter's head fits and no distance is known.
constexpr double kLeastDistance_m = 1e-3;

// A right angle where one of them has no length.
double AngleBetween(const Vec3& a, const Vec3& b) {
  const double lengths = Length(a) * Length(b);
  const double cosine = lengths > 0.0 ? Dot(a, b) / lengths : 0.0;
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

ReadingGeometry FromPositions(const Vec3& lamp, const Vec3& meter, const Vec3& normal) {
  const Vec3 to_lamp = lamp - meter;
  return {Length(to_lamp), AngleBetween(to_lamp, normal), true};
}

// Absent where the angle off it says enough.
std::optional<std::string> WithoutAxis(LightKind kind) {
  if (kind == LightKind::kTube) {
    return "a tube shines otherwise along itself than across: give position_m and normal, and the "
           "lamp's position_m and axis, instead of off_axis_deg";
  }
  if (!HasDistanceLaw(kind)) {
    return "a " + std::string(LightKindName(kind)) +
           " light has no axis to stand off; leave off_axis_deg away, or give the lamp the kind it "
           "has";
  }
  return std::nullopt;
}

// The radius around the reference point inside which no meter can stand.
double InnerRadius(const LightDescription& light) {
  if (light.kind == LightKind::kTube && light.radius) return light.radius->value();
  if (light.kind == LightKind::kSphere && light.diameter) return 0.5 * light.diameter->value();
  return 0.0;
}

}  // namespace

PartRound MeanRound(const std::function<double(double)>& part_of) {
  constexpr int kSides = 16;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kSides; ++i) {
    const double part = part_of(2.0 * std::numbers::pi * i / kSides);
    sum += part;
    squares += part * part;
  }
  const double mean = sum / kSides;
  if (!(mean > 0.0)) return {};
  return {mean, std::sqrt(std::max(0.0, squares / kSides - mean * mean)) / mean};
}

TablePart TablePartTowards(const LightDescription& light, const Reading& reading) {
  if (!light.distribution) return {};
  const IntensityTable& table = *light.distribution;
  const auto part = [&](double candela, double error) {
    return TablePart{candela / table.peak().intensity.value(),
                     candela > 0.0 ? error / candela : 0.0};
  };
  if (const double off = std::abs(reading.off_axis.value()); off != 0.0) {
    const auto round = [&](auto candela_at) {
      return MeanRound([&](double about) { return candela_at(Radians(about)).value(); }).mean;
    };
    return part(
        round([&](Radians about) { return table.At(about, Radians(off)); }),
        round([&](Radians about) { return table.InterpolationErrorAt(about, Radians(off)); }));
  }
  Vec3 towards{0.0, 0.0, -1.0};
  if (reading.position_m && light.position_m) {
    const LampAxes axes =
        AxesOfAim(light.aim.value_or(Vec3{0.0, 0.0, -1.0}), light.axis.value_or(Vec3{}));
    const Vec3 way = *reading.position_m - *light.position_m;
    towards = {Dot(way, axes.c0), Dot(way, axes.c90), -Dot(way, axes.aim)};
  }
  return part(table.Towards(towards).value(), table.InterpolationErrorTowards(towards).value());
}

Result<ReadingGeometry> GeometryOfReading(const LightDescription& light, const Reading& reading,
                                          const std::string& name, bool lit) {
  if (reading.distance && reading.distance->value() < 0.0) {
    return Refused("negative_distance", name, "a distance below 0 m has no meaning; correct it");
  }
  if (lit && reading.off_axis.value() != 0.0) {
    if (auto fault = WithoutAxis(light.kind)) return Refused("no_axis", name, *std::move(fault));
  }
  if (light.kind == LightKind::kDirectional && lit && reading.normal) {
    if (!light.aim) {
      return Refused("no_aim", name,
                     "its normal says how the meter was turned, but nobody says where the light "
                     "comes from: give the light's aim, or the reading's tilt_deg from the light");
    }
    return ReadingGeometry{1.0, AngleBetween(*light.aim * -1.0, *reading.normal), true};
  }
  if (!HasDistanceLaw(light.kind)) return ReadingGeometry{1.0, reading.tilt.value(), true};
  if (reading.distance)
    return ReadingGeometry{reading.distance->value(), reading.tilt.value(), false};
  if (!reading.position_m) {
    if (!lit) return ReadingGeometry{};
    return Refused("no_distance", name, "give distance_m, or position_m and normal");
  }
  if (!light.position_m) {
    return ReadingGeometry{1.0, reading.normal ? 0.0 : reading.tilt.value(), true};
  }
  if (reading.normal) {
    return FromPositions(*light.position_m, *reading.position_m, *reading.normal);
  }
  return ReadingGeometry{Length(*light.position_m - *reading.position_m), reading.tilt.value(),
                         true};
}

std::string FaultOfReading(const LightDescription& light, const Reading& reading,
                           const ReadingGeometry& geometry, bool lit) {
  const double lux = reading.illuminance->value();
  if (!std::isfinite(lux)) return "its illuminance is not a number";
  if (!std::isfinite(geometry.distance_m)) return "its distance is not a number";
  if (lit && !(geometry.distance_m > 0.0)) return "its distance is 0; no law holds there";
  if (!std::isfinite(geometry.tilt_rad)) return "its tilt is not a number";
  if (!lit) return {};
  if (!(TablePartTowards(light, reading).of_peak > 0.0)) {
    return "the lamp's photometric file has no light in the meter's direction";
  }
  if (geometry.distance_m < InnerRadius(light)) {
    return "it stands inside the lamp (" + ShortestText(geometry.distance_m) + " m)";
  }
  if (HasDistanceLaw(light.kind) && geometry.distance_m < kLeastDistance_m) {
    return "it is nearer than 1 mm (" + ShortestText(geometry.distance_m) +
           " m), where no distance is known: measure from farther away";
  }
  if (std::abs(geometry.tilt_rad) >= 0.5 * std::numbers::pi - 1e-9) {
    return "the meter faces away from the lamp (tilt 90 degrees or more)";
  }
  return {};
}

}  // namespace lightcal::fit
