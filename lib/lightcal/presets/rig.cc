// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/rig.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "lightcal/core/did_you_mean.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/photometry/exposure.h"
#include "lightcal/photometry/lambert.h"

namespace lightcal {
namespace {

constexpr double kLargestSide_m = 0.2;
constexpr double kSideShareOfDistance = 0.1;
constexpr double kConeShare = 0.25;
constexpr double kCentreShareOfSide = 0.55;  // of each card from the middle of the pair
constexpr double kCameraTiltDegrees = 35.0;
constexpr double kCameraDistanceInSides = 4.0;

std::optional<double> MedianUsedDistance(const FittedLight& lamp) {
  std::vector<double> distances;
  for (const ResidualRow& row : lamp.residuals) {
    if (row.used && row.distance_m && *row.distance_m > 0.0) distances.push_back(*row.distance_m);
  }
  if (distances.empty()) return std::nullopt;
  std::ranges::sort(distances);
  return distances[(distances.size() - 1) / 2];
}

Vec3 Unit(const Vec3& v) { return v * (1.0 / Length(v)); }

Vec3 HorizontalAcross(const Vec3& aim) {
  const Vec3 across = Cross(aim, Vec3{0.0, 0.0, 1.0});
  return Length(across) > 1e-9 ? Unit(across) : Vec3{1.0, 0.0, 0.0};
}

Metres SideFor(const PunctualLight& light, double separation, bool off_axis) {
  double side = std::min(kLargestSide_m, kSideShareOfDistance * separation);
  if (light.type == PunctualType::kSpot) {
    const double angle = kConeShare * light.cone.outer.value();
    side = std::min(side, separation * std::tan(angle) / kCentreShareOfSide);
    // Their middle half, which is measured, spans a sixteenth of the penumbra: its mean is its
    // middle within .3 %.
    const double penumbra = light.cone.outer.value() - light.cone.inner.value();
    if (off_axis && penumbra > 1e-3) {
      side = std::min(side, separation * 4.0 * std::tan(penumbra / 32.0));
    }
  }
  return Metres(side);
}

// Looks at the pair from the lamp's side, tilted so that a shiny card would not mirror the lamp.
RigCamera CameraFor(const Vec3& middle, const Vec3& normal, const Vec3& across, double side) {
  Vec3 lean = Cross(across, normal);
  if (lean[2] < -1e-9) lean = lean * -1.0;
  const double tilt = RadiansFromDegrees(kCameraTiltDegrees).value();
  const Vec3 back = normal * std::cos(tilt) + lean * std::sin(tilt);
  RigCamera camera;
  camera.target_m = middle;
  camera.position_m = middle + back * (kCameraDistanceInSides * side);
  camera.up = lean * std::cos(tilt) - normal * std::sin(tilt);
  if (camera.up[2] < 0.0) camera.up = camera.up * -1.0;
  return camera;
}

template <class Light>
RigCard CardAt(const char* name, double reflectance, const Vec3& centre, const Vec3& normal,
               std::span<const Light> lights) {
  RigCard card;
  card.name = name;
  card.reflectance = reflectance;
  card.centre_m = centre;
  for (const Light& light : lights) {
    card.by_light.push_back(IlluminanceAt(light, centre, normal));
    card.illuminance = card.illuminance + card.by_light.back();
  }
  card.luminance = LuminanceOfLitSurface(card.illuminance, reflectance);
  return card;
}

RigExposure ExposureFor(Lux white) {
  if (!(white.value() > 0.0)) return {};  // CheckRigPlace says so
  const Nits shown_as_one = LuminanceOfLitSurface(white, 1.0);
  const Nits saturating_at_ev0 =
      MaximumLuminance({.f_number = 1.0, .shutter = Seconds(1.0), .iso = 100.0});
  return {std::log2(shown_as_one / saturating_at_ev0), 1.0 / shown_as_one.value()};
}

const PunctualLight& PunctualOf(const PunctualLight& light) { return light; }
const PunctualLight& PunctualOf(const PresetLight& light) { return light.punctual; }

// The way from the lamp to the cards, and what runs along their row.
struct CardsWay {
  Vec3 aim, across;
};

// `apart`: of each card from the middle of the pair, over their distance from the lamp.
CardsWay WayTo(const FittedLight& lamp, const Vec3& aim, const RigPlace& place, double apart) {
  double off = RadiansFromDegrees(place.off_axis_deg).value();
  const double round = RadiansFromDegrees(place.round_deg).value();
  if (place.OnAxis()) return {aim, HorizontalAcross(aim)};
  if (lamp.kind == LightKind::kDome) {
    const Vec3 facing = {std::sin(off) * std::sin(round), std::sin(off) * std::cos(round),
                         std::cos(off)};
    return {facing * -1.0, HorizontalAcross(facing)};
  }
  const LampAxes axes = AxesOfAim(aim, lamp.axis.value_or(Vec3{}));
  const Vec3 aside = axes.c0 * std::cos(round) + axes.c90 * std::sin(round);
  // Along a circle round the axis: both cards see the beam at one angle, which is the one asked
  // for.
  off = std::acos(std::clamp(std::cos(off) * std::hypot(1.0, apart), -1.0, 1.0));
  return {aim * std::cos(off) + aside * std::sin(off), Unit(Cross(aim, aside))};
}

// Of a place whose sun was taken out as a light, the place.
std::size_t WithAnAxis(const LightFile& file) {
  const auto lamp = std::ranges::find_if(
      file.lights, [](const FittedLight& one) { return one.kind != LightKind::kDirectional; });
  return lamp == file.lights.end() ? 0 : static_cast<std::size_t>(lamp - file.lights.begin());
}

template <class Light>
Rig RigUnder(const LightFile& file, std::span<const Light> lights, const RigPlace& place) {
  std::size_t chosen = 0;
  std::optional<double> distance;
  for (std::size_t i = 0; i < lights.size() && !distance; ++i) {
    if (!place.light.empty() && file.lights[i].name != place.light) continue;
    distance = MedianUsedDistance(file.lights[i]);
    if (distance || !place.light.empty()) chosen = i;
  }
  if (!distance && place.light.empty() && !place.OnAxis()) chosen = WithAnAxis(file);
  const PunctualLight& light = PunctualOf(lights[chosen]);
  Rig rig;
  rig.light = light.name;
  rig.from_reading = distance.has_value();
  rig.distance = Metres(distance.value_or(1.0));
  const double separation = rig.distance.value() + EffectiveOffset_m(file.lights[chosen]);
  rig.separation = Metres(separation > 0.0 ? separation : rig.distance.value());
  rig.place = place;
  rig.side = SideFor(light, rig.separation.value(), !place.OnAxis());
  const double apart = kCentreShareOfSide * rig.side.value() / rig.separation.value();
  const CardsWay way = WayTo(file.lights[chosen], light.aim, place, apart);
  rig.normal = way.aim * -1.0;
  const Vec3 middle = light.position_m + way.aim * rig.separation.value();
  rig.camera = CameraFor(middle, rig.normal, way.across, rig.side.value());
  rig.row = Cross(Unit(rig.camera.target_m - rig.camera.position_m), rig.camera.up);
  const Vec3 half = rig.row * (kCentreShareOfSide * rig.side.value());
  rig.cards = {CardAt("white card", kWhiteCardReflectance, middle - half, rig.normal, lights),
               CardAt("18 % card", kGreyCardReflectance, middle + half, rig.normal, lights)};
  rig.exposure = ExposureFor(rig.cards[0].illuminance);
  return rig;
}

}  // namespace

Rig BuildRig(const LightFile& file, std::span<const PunctualLight> lights, const RigPlace& place) {
  return RigUnder(file, lights, place);
}

Rig BuildRig(const LightFile& file, std::span<const PresetLight> lights, const RigPlace& place) {
  return RigUnder(file, lights, place);
}

Result<void> CheckRigPlace(const LightFile& file, const Rig& rig) {
  const std::string& asked = rig.place.light;
  if (!asked.empty() &&
      std::ranges::find(file.lights, asked, &FittedLight::name) == file.lights.end()) {
    return Refused("unknown_light", asked,
                   "no light is called so" + DidYouMean(asked, file.lights));
  }
  if (rig.place.OnAxis() && asked.empty()) return {};
  const auto lamp = std::ranges::find(file.lights, rig.light, &FittedLight::name);
  if (!rig.place.OnAxis() && lamp != file.lights.end() && lamp->kind == LightKind::kDirectional) {
    return Refused("rig_place", rig.light,
                   "shines from far away and has no axis to stand off; leave out {preset.rig_at}");
  }
  if (rig.cards[0].illuminance.value() > 0.0 && rig.cards[1].illuminance.value() > 0.0) return {};
  if (rig.place.OnAxis()) {
    return Refused("rig_place", rig.light, "and the others leave cards on its axis dark");
  }
  return Refused("rig_place", rig.light,
                 "casts no light " + RoundedText(rig.place.off_axis_deg, 4) +
                     " degrees off its axis; give {preset.rig_at} an angle inside its beam");
}

std::array<Vec3, 4> CornersOf(const Rig& rig, const RigCard& card) {
  const Vec3 across = rig.row * (rig.side.value() / 2.0);
  const Vec3 along = Cross(rig.normal, rig.row) * (rig.side.value() / 2.0);
  const Vec3& middle = card.centre_m;
  return {middle - across - along, middle + across - along, middle + across + along,
          middle - across + along};
}

}  // namespace lightcal
