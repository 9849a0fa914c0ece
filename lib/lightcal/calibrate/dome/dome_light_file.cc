// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/dome/dome_light_file.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lightcal/fit/fit_light.h"
#include "lightcal/imaging/camera/spectral_mismatch.h"
#include "lightcal/imaging/panorama/turn_north.h"
#include "lightcal/photometry/area_illuminance.h"

namespace lightcal {
namespace {

constexpr double kAreaDistance_m = 1.0;

Vec3 DirectionOf(const MeasuredDome& measured, std::size_t index) {
  return TurnedNorth(measured.lights[index].direction, measured.north);
}

bool IsSun(const DomeLight& light) { return IsBrightAsSun(light) && light.direction[2] > 0.0; }

// The same illuminance from a rectangle that fills the same angles.
void BecomeRect(const DomeLight& seen, FittedLight& light) {
  const auto side = [](Radians angle) {
    const double widest = 0.9 * std::numbers::pi;
    return 2.0 * kAreaDistance_m * std::tan(std::min(angle.value(), widest) / 2.0);
  };
  const double width = side(seen.angular_width), height = side(seen.angular_height);
  const double lux_per_nit =
      LuxPerNitOfRect(Metres(width), Metres(height), Metres(kAreaDistance_m));
  const auto scaled = [&](double factor) {
    Uncertain u = *light.illuminance_lx;
    u.value *= factor;
    u.u95 *= factor;
    if (u.low) *u.low *= factor;
    if (u.high) *u.high *= factor;
    return u;
  };
  light.kind = LightKind::kRect;
  light.width_m = width;
  light.height_m = height;
  light.luminance_nits = scaled(1.0 / lux_per_nit);
  light.intensity_cd = scaled(width * height / lux_per_nit);
  light.flux_lm = scaled(std::numbers::pi * width * height / lux_per_nit);
  light.position_m = *light.aim * -kAreaDistance_m;
  light.illuminance_lx.reset();
  light.angular_diameter_deg.reset();
}

}  // namespace

std::vector<std::string> NamesOfLights(const MeasuredDome& measured, std::size_t count) {
  std::vector<std::string> names;
  bool sun = false;
  for (std::size_t i = 0; i < std::min(count, measured.lights.size()); ++i) {
    const bool is_sun = !sun && IsSun(measured.lights[i]);
    sun = sun || is_sun;
    names.push_back(is_sun ? "sun" : "light-" + std::to_string(i + 1));
  }
  return names;
}

LightDescription DirectionalLight(const MeasuredDome& measured, std::size_t index,
                                  std::string name) {
  LightDescription light;
  light.name = std::move(name);
  light.kind = LightKind::kDirectional;
  light.aim = DirectionOf(measured, index) * -1.0;
  return light;
}

Reading ReadingOfLight(const MeasuredDome& measured, std::size_t index, std::string name) {
  const DomeLight& light = measured.lights[index];
  Reading reading;
  reading.light = std::move(name);
  reading.illuminance = light.illuminance;
  reading.sigma_relative = std::clamp(measured.sd_relative[index], 1e-6, 0.99);
  reading.xy = light.xy;
  if (light.xy) {
    reading.color_source = ColorSource::kCamera;
    reading.sigma_mired = GenericColorSigma(LampClass::kUnknown);
  }
  reading.quality = MeterQuality::kDerived;
  reading.device = "panorama";
  return reading;
}

Result<LightFile> LightFileOfDome(const MeasuredDome& measured, std::size_t count,
                                  Warnings& warnings) {
  Session session;
  session.surroundings = Surroundings::kDark;  // what else shines was left in the picture
  const std::vector<std::string> names = NamesOfLights(measured, count);
  for (std::size_t i = 0; i < names.size(); ++i) {
    session.lights.push_back(DirectionalLight(measured, i, names[i]));
    session.readings.push_back(
        {ReadingOfLight(measured, i, names[i]), measured.input.files.front()});
  }
  auto fitted = FitSession(session, {});
  if (!fitted) return Propagate(std::move(fitted));
  warnings.insert(warnings.end(), fitted->warnings.begin(), fitted->warnings.end());
  for (std::size_t i = 0; i < names.size(); ++i) {
    FittedLight& light = fitted->lights.lights[i];
    const DomeLight& seen = measured.lights[i];
    light.aim = session.lights[i].aim;
    light.ambient_lx.reset();  // what surrounds it is the dome
    if (!measured.unit_known || seen.at_most) light.illuminance_lx = LuxOfLight(measured, i);
    light.angular_diameter_deg = DegreesFromRadians(seen.angular_diameter);
    if (*light.angular_diameter_deg > kAreaLightDegrees) BecomeRect(seen, light);
  }
  return std::move(fitted->lights);
}

}  // namespace lightcal
