// SPDX-License-Identifier: Apache-2.0
#include "simulate/simulated_lamps.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "session_names.h"

namespace lightcal::app {
namespace {

constexpr Vec3 kDown = {0.0, 0.0, -1.0};
constexpr double kPi = 3.14159265358979323846;

using Overrides = std::map<std::string, Vec3, std::less<>>;
using Parse = Result<Vec3> (*)(const std::string& option, const std::string& text);

template <class ParseOne>
Result<Vec3> ParseThree(const std::string& option, const std::string& text, const ParseOne& parse) {
  Vec3 out{};
  std::string_view rest = text;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t comma = axis < 2 ? rest.find(',') : rest.size();
    if (comma == std::string_view::npos) {
      return WrongUsage(option, "\"" + text + "\" must be three numbers: x,y,z");
    }
    const auto value = parse(TrimBlanks(rest.substr(0, comma)));
    if (!value) return WrongUsage(option, "\"" + text + "\" must be three numbers: x,y,z");
    out[axis] = *value;
    rest.remove_prefix(std::min(rest.size(), comma + 1));
  }
  return out;
}

Result<Overrides> ParsePlaces(const std::string& option, const std::vector<std::string>& texts,
                              const std::vector<const FittedLight*>& lights, Parse parse) {
  Overrides out;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    std::string name = equals == std::string::npos ? "" : text.substr(0, equals);
    if (name.empty() && lights.size() > 1) {
      return WrongUsage(option, "there are several lights; say which: " + option + " " +
                                    lights.front()->name + "=" + text);
    }
    if (name.empty()) name = lights.front()->name;
    const bool known = std::ranges::any_of(lights, [&](const auto* l) { return l->name == name; });
    if (!known) return WrongUsage(option, "no light \"" + name + "\" is simulated");
    const auto value = parse(option, equals == std::string::npos ? text : text.substr(equals + 1));
    if (!value) return tl::unexpected(value.error());
    out[name] = *value;
  }
  return out;
}

std::optional<Vec3> Find(const Overrides& overrides, const std::string& name,
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

Result<Uncertain> StrengthOf(const FittedLight& light) {
  std::optional<Uncertain> strength =
      HasPlace(light.kind) ? light.intensity_cd : light.illuminance_lx;
  if (light.kind == LightKind::kDome && !strength && light.luminance_nits) {
    const Uncertain& nits = *light.luminance_nits;
    strength = Uncertain{kPi * nits.value, kPi * nits.u95, std::nullopt, std::nullopt};
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
      if (light.distribution) {
        return TableSource{std::make_shared<IntensityTable>(light.distribution->table)};
      }
      [[fallthrough]];
    case LightKind::kSpot:
      if (const auto spot = cone()) return *spot;
      warnings.push_back(
          {"cone_unknown", light.name,
           "no outer_deg is known: simulated as shining evenly all round, right along "
           "its aim only; give outer_deg or measure off the axis"});
      return PointSource{};
    case LightKind::kPoint:
      break;
  }
  return PointSource{};
}

// Standard deviation of ln strength of an estimate that has no covariance.
double SdOfLog(const Uncertain& u) {
  if (u.low && u.high && *u.low > 0.0) return std::log(*u.high / *u.low) / (2.0 * kZ95);
  return u.u95 / (u.value * kZ95);
}

LampDoubt DoubtOf(const FittedLight& light, const Uncertain& strength, bool stated_position) {
  LampDoubt doubt;
  const double sd = SdOfLog(strength);
  doubt.variance_ln = sd * sd;
  if (light.covariance_lnI_d0_E0) {
    const auto& c = *light.covariance_lnI_d0_E0;
    doubt.variance_ln = c[0];
    doubt.covariance = c[1];
    doubt.variance_offset = c[4];
  } else if (light.distance_offset_m) {
    const double offset = light.distance_offset_m->u95 / kZ95;
    doubt.variance_offset = offset * offset;
  }
  if (light.position_u95_m && stated_position) {
    doubt.position_m = *light.position_u95_m * (1.0 / kZ95);
  }
  const auto radians = [](const std::optional<double>& u95_deg) {
    return RadiansFromDegrees(u95_deg.value_or(0.0) / kZ95).value();
  };
  doubt.aim_rad = radians(light.aim_u95_deg);
  doubt.inner_rad = radians(light.inner_u95_deg);
  doubt.outer_rad = radians(light.outer_u95_deg);
  return doubt;
}

// AxesOfAim puts a table's C0 along c0 and C90 along c90: right-handed with -aim.
SourceFrame FrameOfTable(const Vec3& aim) {
  const LampAxes axes = AxesOfAim(aim);
  return {axes.c0, axes.c90, axes.aim};
}

class Placer {
 public:
  Placer(const Session* session, Overrides position, Overrides aim, Overrides axis)
      : session_(session),
        position_(std::move(position)),
        aim_(std::move(aim)),
        axis_(std::move(axis)) {}

  Result<PlacedLamp> Place(const FittedLight& light, Warnings& warnings) const {
    const auto strength = StrengthOf(light);
    if (!strength) return tl::unexpected(strength.error());
    const auto position = Find(position_, light.name, light.position_m);
    if (!position && HasPlace(light.kind)) {
      return Refused("position_unknown", light.name,
                     "was measured by distances: where it stands is not known; say so with "
                     "--position " +
                         light.name + "=x,y,z (metres, Z up), or give position_m in its session");
    }
    const LightDescription* stated = session_ ? FindLight(*session_, light.name) : nullptr;
    const Vec3 axis =
        Find(axis_, light.name, stated ? stated->axis : std::nullopt).value_or(Vec3{});
    auto aim = Find(aim_, light.name, light.aim);
    if (!aim && NeedsAim(light)) {
      warnings.push_back({"aim_unknown", light.name,
                          "no aim is known: it shines straight down; --aim " + light.name +
                              "=x,y,z says otherwise"});
    }
    PlacedLamp lamp;
    lamp.name = light.name;
    lamp.source = SourceOf(light, warnings);
    lamp.strength = strength->value;
    lamp.pose.position_m = position.value_or(Vec3{});
    // A tube known by its axis alone: any direction square to it serves as z.
    const Vec3 z = aim ? *aim * (1.0 / Length(*aim))
                   : light.kind == LightKind::kTube && Length(axis) > 0.0
                       ? SourceFrame::Facing(axis).y
                       : kDown;
    lamp.pose.frame = std::holds_alternative<TableSource>(lamp.source)
                          ? FrameOfTable(z)
                          : SourceFrame::Facing(z, axis);
    lamp.pose.offset_m = light.distance_offset_m ? light.distance_offset_m->value : 0.0;
    lamp.doubt = DoubtOf(light, *strength, !position_.contains(light.name));
    if (std::holds_alternative<SpotSource>(lamp.source)) return lamp;
    lamp.doubt.inner_rad = lamp.doubt.outer_rad = 0.0;
    if (std::holds_alternative<PointSource>(lamp.source)) lamp.doubt.aim_rad = 0.0;
    return lamp;
  }

 private:
  const Session* session_;
  Overrides position_, aim_, axis_;
};

}  // namespace

Result<Vec3> ParsePoint(const std::string& option, const std::string& text) {
  return ParseThree(option, text, [](std::string_view one) -> std::optional<double> {
    const auto length = ParseLength(one);
    if (!length) return std::nullopt;
    return length->value();
  });
}

Result<Vec3> ParseUnitVector(const std::string& option, const std::string& text) {
  auto direction = ParseThree(option, text, [](std::string_view one) { return ParseNumber(one); });
  if (!direction) return direction;
  const double length = Length(*direction);
  if (!(length > 0.0)) return WrongUsage(option, "\"" + text + "\" has no direction");
  return *direction * (1.0 / length);
}

Result<std::vector<PlacedLamp>> PlaceLamps(const LightFile& file, const Session* session,
                                           const std::vector<std::string>& names,
                                           const LampPlaces& places, Warnings& warnings) {
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
  auto position = ParsePlaces("--position", places.position, chosen, ParsePoint);
  if (!position) return Propagate(std::move(position));
  auto aim = ParsePlaces("--aim", places.aim, chosen, ParseUnitVector);
  if (!aim) return Propagate(std::move(aim));
  auto axis = ParsePlaces("--axis", places.axis, chosen, ParseUnitVector);
  if (!axis) return Propagate(std::move(axis));
  const Placer placer(session, *std::move(position), *std::move(aim), *std::move(axis));
  std::vector<PlacedLamp> lamps;
  for (const FittedLight* light : chosen) {
    auto lamp = placer.Place(*light, warnings);
    if (!lamp) return Propagate(std::move(lamp));
    lamps.push_back(*std::move(lamp));
  }
  return lamps;
}

}  // namespace lightcal::app
