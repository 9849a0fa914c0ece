// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/place_lamps.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/core/did_you_mean.h"
#include "lightcal/core/uncertain.h"

namespace lightcal {
namespace {

constexpr Vec3 kDown = {0.0, 0.0, -1.0};

std::optional<Vec3> Find(const LampPlaces::ByLight& overrides, const std::string& name,
                         const std::optional<Vec3>& otherwise) {
  const auto at = overrides.find(name);
  return at != overrides.end() ? std::optional<Vec3>(at->second) : otherwise;
}

bool HasPlace(LightKind kind) {
  return kind != LightKind::kDirectional && kind != LightKind::kDome;
}
bool NeedsAim(const FittedLight& light) {
  return light.kind == LightKind::kDisk || light.kind == LightKind::kRect ||
         light.kind == LightKind::kSpot || light.kind == LightKind::kPhotometric ||
         light.kind == LightKind::kDirectional;
}

// A point in front of which its readings were made, and which may shine to that side alone: as
// uneven as no bulb is, and not read from several sides.
bool MayShineToOneSide(const FittedLight& light) {
  constexpr double kOfAnyBulb = 0.5;  // their gradient is .25 (UnevenOf), of lamps of one side .8
  constexpr double kOneSide = 0.95;   // length of the mean of directions near together
  if (light.kind != LightKind::kPoint || !light.uneven) return false;
  const double middle = Length(light.uneven->middle);
  return Length(light.uneven->gradient_sd) > kOfAnyBulb && (middle == 0.0 || middle > kOneSide);
}
// The side from which such a lamp was read, where its meters' places tell it.
std::optional<Vec3> SideRead(const FittedLight& light) {
  if (!MayShineToOneSide(light)) return std::nullopt;
  const Vec3& middle = light.uneven->middle;
  const double length = Length(middle);
  return length > 0.0 ? std::optional(middle * (1.0 / length)) : std::nullopt;
}

Result<Uncertain> StrengthOf(const FittedLight& light) {
  std::optional<Uncertain> strength =
      HasPlace(light.kind) ? light.intensity_cd : light.illuminance_lx;
  if (light.kind == LightKind::kDome && !strength && light.luminance_nits) {
    const Uncertain& nits = *light.luminance_nits;
    strength = Uncertain{std::numbers::pi * nits.value, std::numbers::pi * nits.u95, std::nullopt,
                         std::nullopt};
  }
  if (strength && strength->value > 0.0) return *strength;
  return Refused(
      "no_intensity", light.name,
      "has no luminous intensity (or illuminance) to predict from; fit it from a reading");
}

LampSource SourceOf(const FittedLight& light, Warnings& warnings) {
  const auto unknown_size = [&](const char* size) {
    warnings.push_back({"size_unknown", light.name,
                        std::string("no ") + size + " is known: simulated as a small " +
                            std::string(LightKindName(light.kind)) +
                            "; near it that is too bright"});
  };
  const auto cone = [&]() -> std::optional<LampSource> {
    if (!light.outer_deg || !(*light.outer_deg > 0.0)) return std::nullopt;
    const double outer = std::min(*light.outer_deg, 180.0);
    return SpotSource{{RadiansFromDegrees(std::min(light.inner_deg.value_or(0.0), outer)),
                       RadiansFromDegrees(outer)}};
  };
  switch (light.kind) {
    case LightKind::kDirectional:
      return SunSource{RadiansFromDegrees(0.5 * light.angular_diameter_deg.value_or(0.0)).value()};
    case LightKind::kDome:
      return EvenSky{};
    case LightKind::kSphere:
      return SphereSource{0.5 * light.diameter_m.value_or(0.0)};
    case LightKind::kDisk:
      if (!light.diameter_m) unknown_size("diameter_m");
      return DiskSource{0.5 * light.diameter_m.value_or(0.0)};
    case LightKind::kRect:
      if (!light.width_m || !light.height_m) unknown_size("size_m");
      return RectSource{0.5 * light.width_m.value_or(0.0), 0.5 * light.height_m.value_or(0.0)};
    case LightKind::kTube:
      if (light.length_m && *light.length_m > 0.0) {
        return TubeSource{0.5 * *light.length_m, light.radius_m.value_or(0.0)};
      }
      unknown_size("length_m");
      return PointSource{};
    case LightKind::kPhotometric:
    case LightKind::kSpot:
      if (light.distribution) {
        return TableSource{std::make_shared<IntensityTable>(light.distribution->table)};
      }
      if (const auto spot = cone()) return *spot;
      warnings.push_back(
          {"cone_unknown", light.name,
           "no outer_deg is known: simulated as shining evenly all round, right along "
           "its aim only, anything from there to darkness off it; give beam_deg or outer_deg, or "
           "measure off the axis"});
      return PointSource{};
    case LightKind::kPoint:
      break;
  }
  return PointSource{};
}

// Of parts of some 3 degrees: each sends its light from where its own middle of it lies.
Result<LampSource> SkyOf(const EnvironmentPicture& picture, const FittedLight& light) {
  constexpr int kColumns = 128;
  const int w = picture.small_width, h = picture.small_height;
  const int step = std::max(1, w / kColumns);
  const int across = (w + step - 1) / step;
  std::vector<Vec3> flux(static_cast<std::size_t>(across) * ((h + step - 1) / step));
  const double* rgb = picture.small.data();
  for (int y = 0; y < h; ++y) {
    const double omega = PixelSolidAngle(y, w, h);
    for (int x = 0; x < w; ++x, rgb += 3) {
      Vec3& part = flux[static_cast<std::size_t>(y / step) * across + x / step];
      const double nits = LuminanceOfRgb({rgb[0], rgb[1], rgb[2]}, RgbSpace::kSrgb);
      part = part + PixelDirection(x, y, w, h) * (nits * omega);
    }
  }
  double upward = 0.0;
  for (const Vec3& part : flux) upward += std::max(0.0, part[2]);
  if (!(upward > 0.0)) {
    return Refused("bad_environment", light.environment->file,
                   "is dark above, where its illuminance is measured");
  }
  for (Vec3& part : flux) part = part * (1.0 / upward);
  return LampSource(SeenSky{std::make_shared<const std::vector<Vec3>>(std::move(flux))});
}

// Standard deviation of ln strength of an estimate that has no covariance.
double SdOfLog(const Uncertain& u) {
  if (u.low && u.high && *u.low > 0.0) return std::log(*u.high / *u.low) / (2.0 * kZ95);
  return u.u95 / (u.value * kZ95);
}

PlaceDoubt PlaceDoubtOf(const LocatedLamp& located, bool stands_there) {
  constexpr int n = PlaceDoubt::kCount;
  constexpr std::array<int, n> kFrom = {0, 1, 2, 3, 7, 8, 9};
  const auto counts = [&](int i) { return stands_there || i < 1 || i > 3; };
  PlaceDoubt doubt{located.gradient, located.middle, {}};
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      if (!counts(i) || !counts(j)) continue;
      doubt.covariance[i * n + j] = located.covariance[kFrom[i] * LocatedLamp::kCount + kFrom[j]];
    }
  }
  return doubt;
}

// Of a place and a pattern that nothing ties to the strength. Meters of which a distance alone is
// known stood on the aim.
PlaceDoubt PlaceDoubtOf(const FittedLight& light, double variance_ln, bool stands_there,
                        const std::optional<Vec3>& aim) {
  constexpr int kDiagonal = PlaceDoubt::kCount + 1;
  PlaceDoubt doubt;
  doubt.covariance[0] = variance_ln;
  for (int k = 0; k < 3; ++k) {
    const double place = stands_there ? light.position_u95_m.value_or(Vec3{})[k] / kZ95 : 0.0;
    doubt.covariance[(1 + k) * kDiagonal] = place * place;
    if (!light.uneven || MayShineToOneSide(light)) continue;
    const double sd = light.uneven->gradient_sd[k];
    const bool by_aim = aim && !light.position_m;
    doubt.middle[k] = by_aim ? (*aim)[k] / Length(*aim) : light.uneven->middle[k];
    doubt.covariance[(4 + k) * kDiagonal] = sd * sd;
  }
  return doubt;
}

// What the lamp may be, where that is more than one thing.
std::vector<LampPart> PartsOf(const FittedLight& light) {
  constexpr int n = LampInRoom::kCount;
  std::vector<LampPart> parts;
  if (light.in_room.size() < 2) return parts;
  for (const LampInRoom& one : light.in_room) {
    parts.push_back({one.weight, one.ln_intensity, one.distance_offset_m, one.width_m, one.height_m,
                     one.covariance[0], one.covariance[n + 1], one.covariance[1]});
  }
  return parts;
}

LampDoubt DoubtOf(const FittedLight& light, const Uncertain& strength, bool stands_there,
                  const std::optional<Vec3>& aim) {
  LampDoubt doubt;
  const double sd = SdOfLog(strength);
  doubt.variance_ln = sd * sd;
  if (light.covariance_lnI_d0_E0) {
    const auto& c = *light.covariance_lnI_d0_E0;
    doubt.variance_ln = c[0];
    doubt.covariance = c[1];
    doubt.variance_offset = c[4];
    doubt.parts = PartsOf(light);
  } else if (light.distance_offset_m) {
    const double offset = light.distance_offset_m->u95 / kZ95;
    doubt.variance_offset = offset * offset;
  }
  const bool uneven = light.uneven && !MayShineToOneSide(light);
  if (uneven || light.located || (light.position_u95_m && stands_there)) {
    doubt.place = light.located ? PlaceDoubtOf(*light.located, stands_there)
                                : PlaceDoubtOf(light, doubt.parts.empty() ? doubt.variance_ln : 0.0,
                                               stands_there, aim);
  }
  const auto radians = [](const std::optional<double>& u95_deg) {
    return RadiansFromDegrees(u95_deg.value_or(0.0) / kZ95).value();
  };
  doubt.aim_rad = radians(light.aim_u95_deg);
  doubt.inner_rad = radians(light.inner_u95_deg);
  doubt.outer_rad = radians(light.outer_u95_deg);
  return doubt;
}

// Off its aim: as its table is known; a flat lamp and a tube as far from their laws as their flux
// is; a lamp of which nobody knows how it shines, anyhow, and everywhere where its aim is not
// known.
void AddPattern(const FittedLight& light, const Uncertain& strength, bool aimed, PlacedLamp& lamp) {
  LampDoubt& doubt = lamp.doubt;
  const bool beam = light.kind == LightKind::kSpot || light.kind == LightKind::kPhotometric;
  const bool anyhow = beam && std::holds_alternative<PointSource>(lamp.source);
  if (anyhow || MayShineToOneSide(light)) {
    const bool known = beam || aimed;
    doubt.pattern =
        std::make_shared<const PatternDoubt>(known ? DoubtOfAnyBeam() : DoubtOfAnyAim());
    doubt.variance_ln_flux = kAnyBeamLnFluxSd * kAnyBeamLnFluxSd;
    return;
  }
  if (!light.flux_lm || !(light.flux_lm->value > 0.0)) return;
  const double flux = SdOfLog(*light.flux_lm), of_strength = SdOfLog(strength);
  const double variance = std::max(0.0, flux * flux - of_strength * of_strength);
  // Phi/I = 2 pi/(m + 1) of cos^m, 2 pi int sin^(m+1) of sin^m; their slopes by m where m = 1.
  constexpr double kOfCosine = 0.5, kOfSine = std::numbers::ln2 - 0.5;
  if (const auto* spot = std::get_if<SpotSource>(&lamp.source)) {
    // Phi goes as the square of the cone.
    const double part = 0.5 * std::sqrt(variance);
    if (!light.inner_u95_deg) doubt.inner_rad = part * spot->cone.inner.value();
    if (!light.outer_u95_deg) doubt.outer_rad = part * spot->cone.outer.value();
  } else if (light.kind == LightKind::kDisk || light.kind == LightKind::kRect) {
    doubt.exponent = std::sqrt(variance) / kOfCosine;
  } else if (light.kind == LightKind::kTube) {
    doubt.exponent = std::sqrt(variance) / kOfSine;
  } else if (!light.distribution || light.distribution->pattern_sd.empty()) {
    return;
  } else {
    const MeasuredDistribution& measured = *light.distribution;
    doubt.pattern = std::make_shared<const PatternDoubt>(
        PatternDoubtOf(measured.table.grid().vertical_deg, measured.pattern_sd));
  }
  doubt.variance_ln_flux = variance;
}

// Of a sphere whose distances may have been counted from its surface d0 says from where; what
// shines is its centre, which is its place.
bool OffsetHoldsRadius(const FittedLight& light) {
  return light.kind == LightKind::kSphere &&
         std::ranges::any_of(light.effects, [](const EffectReport& effect) {
           return effect.name == "sphere_surface" && effect.state == EffectState::kFitted;
         });
}

// AxesOfAim puts a table's C0 along c0 and C90 along c90: right-handed with -aim.
SourceFrame FrameOfTable(const Vec3& aim, const Vec3& along) {
  const LampAxes axes = AxesOfAim(aim, along);
  return {axes.c0, axes.c90, axes.aim};
}

class Placer {
 public:
  Placer(const LampPlaces& places, const PictureOfDome& picture)
      : places_(places), picture_(picture) {}

  Result<PlacedLamp> Place(const FittedLight& light, Warnings& warnings) const {
    const auto strength = StrengthOf(light);
    if (!strength) return tl::unexpected(strength.error());
    const auto position = Find(places_.position_m, light.name, light.position_m);
    if (!position && HasPlace(light.kind)) {
      return Refused("position_unknown", light.name,
                     "was measured by distances: where it stands is not known; say so with "
                     "{place.position} " +
                         light.name + "=x,y,z (metres, Z up), or give position_m in its session");
    }
    const Vec3 axis = Find(places_.axis, light.name, light.axis).value_or(Vec3{});
    auto aim = Find(places_.aim, light.name, light.aim);
    if (!aim && NeedsAim(light)) {
      warnings.push_back({"aim_unknown", light.name,
                          "no aim is known: it shines straight down; {place.aim} " + light.name +
                              "=x,y,z says otherwise"});
    }
    if (!aim && MayShineToOneSide(light)) {
      aim = SideRead(light);
      warnings.push_back(
          aim ? Warning{"pattern_unknown", light.name,
                        "was read from one side, to which alone it may shine: elsewhere anything "
                        "from dark to as much again; say that it is a bulb (fixture), if it is, "
                        "or read it from other sides"}
              : Warning{"aim_unknown", light.name,
                        "no aim is known: its light may go anywhere, and off its aim it may be "
                        "dark; {place.aim} " +
                            light.name + "=x,y,z says to which side it was read"});
    }
    PlacedLamp lamp;
    lamp.name = light.name;
    lamp.source = SourceOf(light, warnings);
    if (light.kind == LightKind::kDome && light.environment) {
      const auto seen = picture_(light);
      if (!seen) return tl::unexpected(seen.error());
      auto sky = *seen ? SkyOf(**seen, light) : Result<LampSource>(EvenSky{});
      if (!sky) return Propagate(std::move(sky));
      lamp.source = *std::move(sky);
    }
    lamp.strength = strength->value;
    lamp.pose.position_m = position.value_or(Vec3{});
    // A tube known by its axis alone: any direction square to it serves as z.
    const Vec3 z = aim ? *aim * (1.0 / Length(*aim))
                   : light.kind == LightKind::kTube && Length(axis) > 0.0
                       ? SourceFrame::Facing(axis).y
                       : kDown;
    lamp.pose.frame = std::holds_alternative<TableSource>(lamp.source)
                          ? FrameOfTable(z, axis)
                          : SourceFrame::Facing(z, axis);
    lamp.pose.offset_m = light.distance_offset_m ? light.distance_offset_m->value : 0.0;
    if (light.beam && std::holds_alternative<TableSource>(lamp.source)) {
      // A beam's curve was found about where its light starts, on its axis.
      lamp.pose.position_m = lamp.pose.position_m - lamp.pose.frame.z * lamp.pose.offset_m;
      lamp.pose.offset_m = 0.0;
    }
    lamp.doubt = DoubtOf(light, *strength, !places_.position_m.contains(light.name), aim);
    AddPattern(light, *strength, aim.has_value(), lamp);
    if (OffsetHoldsRadius(light)) {
      lamp.pose.offset_m = 0.0;
      lamp.doubt.variance_offset = lamp.doubt.covariance = 0.0;
      lamp.doubt.parts.clear();
    }
    if (std::holds_alternative<SpotSource>(lamp.source)) return lamp;
    lamp.doubt.inner_rad = lamp.doubt.outer_rad = 0.0;
    if (std::holds_alternative<PointSource>(lamp.source)) lamp.doubt.aim_rad = 0.0;
    return lamp;
  }

 private:
  const LampPlaces& places_;
  const PictureOfDome& picture_;
};

}  // namespace

Result<std::vector<const FittedLight*>> ChooseLights(const LightFile& file,
                                                     const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (std::ranges::find(file.lights, name, &FittedLight::name) == file.lights.end()) {
      return Refused("unknown_light", name,
                     "is not among the lights" + DidYouMean(name, file.lights));
    }
  }
  std::vector<const FittedLight*> chosen;
  for (const FittedLight& light : file.lights) {
    if (names.empty() || std::ranges::find(names, light.name) != names.end()) {
      chosen.push_back(&light);
    }
  }
  if (chosen.empty()) return Refused("no_lights", "", "there is no light to simulate");
  return chosen;
}

Result<std::vector<PlacedLamp>> PlaceLamps(const std::vector<const FittedLight*>& lights,
                                           const LampPlaces& places, const PictureOfDome& picture,
                                           Warnings& warnings) {
  const Placer placer(places, picture);
  std::vector<PlacedLamp> lamps;
  for (const FittedLight* light : lights) {
    auto lamp = placer.Place(*light, warnings);
    if (!lamp) return Propagate(std::move(lamp));
    lamps.push_back(*std::move(lamp));
  }
  return lamps;
}

}  // namespace lightcal
