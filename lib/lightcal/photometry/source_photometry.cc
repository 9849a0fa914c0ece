// SPDX-License-Identifier: Apache-2.0
#include "lightcal/photometry/source_photometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

#include "lightcal/photometry/area_illuminance.h"
#include "lightcal/photometry/inverse_square.h"
#include "lightcal/photometry/lambert.h"

namespace lightcal {
namespace {

using std::numbers::pi;

// Everything is proportional: the amount of each quantity for one unit of a common scale (1 cd of
// axial intensity for lamps, 1 cd/m^2 of luminance or 1 lx where there is no intensity).
struct PerUnit {
  std::optional<double> flux, intensity, luminance, illuminance;
};

std::string_view QuantityName(SourceQuantity quantity) {
  constexpr std::array<std::string_view, 5> kNames = {"luminous flux", "intensity", "luminance",
                                                      "exitance", "illuminance"};
  return kNames[static_cast<std::size_t>(quantity)];
}

Result<Metres> Need(const std::optional<Metres>& size, std::string_view name, LightKind kind) {
  const std::string subject(name);
  if (!size) {
    return WrongUsage(subject, "a " + std::string(LightKindName(kind)) + " light needs its " +
                                   subject + " for this conversion");
  }
  if (!(*size > Metres(0.0)) || std::isinf(size->value())) {
    return Refused("not_positive", subject, "must be a length above zero");
  }
  return *size;
}

Result<PerUnit> Punctual(double flux_per_candela, const SourceGeometry& g) {
  PerUnit unit{flux_per_candela, 1.0, std::nullopt, std::nullopt};
  if (g.distance) unit.illuminance = LuxFromCandela(Candela(1.0), *g.distance).value();
  return unit;
}

// A source of luminance 1/area for one candela.
PerUnit Area(double flux_per_candela, double projected_area) {
  return {flux_per_candela, 1.0, 1.0 / projected_area, std::nullopt};
}

Result<PerUnit> Spot(const SourceGeometry& g) {
  if (!g.cone) return WrongUsage("outer angle", "a spot light needs its outer half angle");
  if (!(g.cone->outer > Radians(0.0)) || g.cone->outer > Radians(pi) ||
      !(g.cone->inner >= Radians(0.0))) {
    return Refused("bad_cone", "spot",
                   "the outer half angle must lie above 0 and up to 180 "
                   "degrees, the inner one from 0");
  }
  if (g.spot_flux == SpotFlux::kPiConvention) return Punctual(pi, g);
  return Punctual(SolidAngleOfSpot(*g.cone, g.falloff).value(), g);
}

Error InsideSource(LightKind kind) {
  return Refused("inside_source", "distance",
                 "the distance to the middle of the " + std::string(LightKindName(kind)) +
                     " is not above its radius: the receiver would stand inside it")
      .value();
}

Result<PerUnit> Round(const SourceGeometry& g) {
  const auto radius = Need(g.radius, "radius or diameter", g.kind);
  if (!radius) return tl::unexpected(radius.error());
  const bool sphere = g.kind == LightKind::kSphere;
  const double area = pi * radius->value() * radius->value();
  PerUnit unit = Area(sphere ? 4.0 * pi : pi, area);
  if (!g.distance) return unit;
  if (sphere && *g.distance <= *radius) return tl::unexpected(InsideSource(g.kind));
  unit.illuminance =
      (sphere ? LuxPerNitOfSphere(*radius, *g.distance) : LuxPerNitOfDisk(*radius, *g.distance)) /
      area;
  return unit;
}

// The side of a rect that is all length.
std::optional<Metres> LengthOfLine(const SourceGeometry& g) {
  if (!g.width || !g.height || (*g.width == Metres(0.0)) == (*g.height == Metres(0.0))) {
    return std::nullopt;
  }
  return std::max(*g.width, *g.height);
}

Result<PerUnit> Line(Metres side, const SourceGeometry& g) {
  const auto length = Need(side, "width or height", g.kind);
  if (!length) return tl::unexpected(length.error());
  PerUnit unit{pi, 1.0, std::nullopt, std::nullopt};
  if (g.distance) unit.illuminance = LuxPerCandelaOfLine(*length, *g.distance);
  return unit;
}

Result<PerUnit> Rect(const SourceGeometry& g) {
  if (const auto line = LengthOfLine(g)) return Line(*line, g);
  const auto width = Need(g.width, "width", g.kind);
  if (!width) return tl::unexpected(width.error());
  const auto height = Need(g.height, "height", g.kind);
  if (!height) return tl::unexpected(height.error());
  const double area = width->value() * height->value();
  PerUnit unit = Area(pi, area);
  if (g.distance) unit.illuminance = LuxPerNitOfRect(*width, *height, *g.distance) / area;
  return unit;
}

Result<PerUnit> Tube(const SourceGeometry& g) {
  const auto length = Need(g.length, "length", g.kind);
  if (!length) return tl::unexpected(length.error());
  const auto radius = Need(g.radius, "radius or diameter", g.kind);
  if (!radius) return tl::unexpected(radius.error());
  const double area = 2.0 * radius->value() * length->value();
  PerUnit unit = Area(pi * pi, area);
  if (!g.distance) return unit;
  if (*g.distance <= *radius) return tl::unexpected(InsideSource(g.kind));
  unit.illuminance = LuxPerNitOfTube(*length, *radius, *g.distance) / area;
  return unit;
}

Result<PerUnit> Directional(const SourceGeometry& g) {
  PerUnit unit;
  unit.illuminance = 1.0;
  if (!g.angular_radius) return unit;
  if (!(*g.angular_radius > Radians(0.0)) || *g.angular_radius > Radians(pi / 2.0)) {
    return Refused("bad_angle", "angular diameter", "must lie above 0 and up to 180 degrees");
  }
  const double s = std::sin(g.angular_radius->value());
  unit.luminance = 1.0 / (pi * s * s);
  return unit;
}

PerUnit Dome() {
  PerUnit unit;
  unit.luminance = 1.0;
  unit.illuminance = LuxUnderUniformDome(Nits(1.0)).value();
  return unit;
}

Result<PerUnit> PerUnitOf(const SourceGeometry& g) {
  switch (g.kind) {
    case LightKind::kPoint:
      return Punctual(4.0 * pi, g);
    case LightKind::kSpot:
      return Spot(g);
    case LightKind::kSphere:
    case LightKind::kDisk:
      return Round(g);
    case LightKind::kRect:
      return Rect(g);
    case LightKind::kTube:
      return Tube(g);
    case LightKind::kDirectional:
      return Directional(g);
    case LightKind::kDome:
      return Dome();
    case LightKind::kPhotometric:
      break;
  }
  return WrongUsage("photometric",
                    "the distribution stands in an IES or LDT file; ask "
                    "{ReadDistribution}");
}

std::optional<double> Amount(const PerUnit& unit, SourceQuantity quantity) {
  switch (quantity) {
    case SourceQuantity::kFlux:
      return unit.flux;
    case SourceQuantity::kIntensity:
      return unit.intensity;
    case SourceQuantity::kLuminance:
      return unit.luminance;
    case SourceQuantity::kExitance:
      if (!unit.luminance) return std::nullopt;
      return ExitanceFromLuminance(Nits(*unit.luminance)).value();
    case SourceQuantity::kIlluminance:
      break;
  }
  return unit.illuminance;
}

// Why this kind cannot be converted from that quantity, and what would help.
Error NoSuchQuantity(const SourceGeometry& g, SourceQuantity given) {
  if (g.kind == LightKind::kRect && given != SourceQuantity::kIlluminance) {
    return Refused("not_positive", "width or height",
                   "a rect with a side of 0 has no area to have a luminance; give its flux, "
                   "intensity or illuminance")
        .value();
  }
  const std::string kind(LightKindName(g.kind));
  std::string message = "a " + kind + " light has no " + std::string(QuantityName(given));
  if (given == SourceQuantity::kIlluminance) {
    message = "an illuminance needs the distance it was measured at";
  } else if (g.kind == LightKind::kDirectional && given != SourceQuantity::kFlux &&
             given != SourceQuantity::kIntensity) {
    message = "a directional light needs its angular diameter for this (the sun: 0.53 degrees)";
  } else if (g.kind == LightKind::kDirectional) {
    message += "; what is published for sun and moon is their illuminance, in lx";
  } else if (g.kind == LightKind::kPoint || g.kind == LightKind::kSpot) {
    message += ", for it has no size; use sphere, disk, rect or tube";
  } else if (g.kind == LightKind::kDome) {
    message += "; give its luminance or the illuminance under it";
  }
  return Error{ErrorKind::kUsage, "usage", kind, message};
}

template <class Unit>
std::optional<Unit> Scaled(const std::optional<double>& amount, double scale) {
  if (!amount) return std::nullopt;
  return Unit(*amount * scale);
}

template <class Unit>
bool Representable(const std::optional<Unit>& quantity) {
  return !quantity || std::isnormal(quantity->value());
}

}  // namespace

Result<SourcePhotometry> ConvertSource(const SourceGeometry& geometry, SourceQuantity given,
                                       double value) {
  if (!(value > 0.0) || std::isinf(value)) {
    return Refused("not_positive", std::string(QuantityName(given)),
                   "must be above zero; no lamp emits less");
  }
  if (geometry.distance) {
    const auto good = Need(geometry.distance, "distance", geometry.kind);
    if (!good) return tl::unexpected(good.error());
  }
  const auto unit = PerUnitOf(geometry);
  if (!unit) return tl::unexpected(unit.error());
  const auto amount = Amount(*unit, given);
  if (!amount) return tl::unexpected(NoSuchQuantity(geometry, given));
  const double scale = value / *amount;
  SourcePhotometry all{Scaled<Lumens>(unit->flux, scale), Scaled<Candela>(unit->intensity, scale),
                       Scaled<Nits>(unit->luminance, scale), std::nullopt,
                       Scaled<Lux>(unit->illuminance, scale)};
  if (all.luminance) all.exitance = ExitanceFromLuminance(*all.luminance);
  if (!Representable(all.flux) || !Representable(all.intensity) || !Representable(all.luminance) ||
      !Representable(all.exitance) || !Representable(all.illuminance)) {
    return Refused("out_of_range", std::string(LightKindName(geometry.kind)),
                   "the answer lies beyond the range of numbers; check the units of the value, "
                   "sizes and distance");
  }
  return all;
}

}  // namespace lightcal
