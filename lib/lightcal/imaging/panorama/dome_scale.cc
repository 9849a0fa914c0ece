// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/dome_scale.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lightcal/core/numbers_text.h"

namespace lightcal {
namespace {

constexpr double kLeastCosine = 0.05;  // grazing light is no measurement of its source

std::string LuxText(double lux) { return RoundedText(lux, 4) + " lx"; }

double ByLight(const DomeLight& light, const Vec3& normal) {
  return std::max(0.0, Dot(light.flow, normal));
}

tl::unexpected<Error> NoLight() {
  return Refused("no_light", "{dome.illuminance}",
                 "the panorama shows nothing bright on the side the meter faced; check "
                 "{dome.normal} and that the picture is not black");
}

Result<void> CheckFacing(const DomeLight& light, const Vec3& normal) {
  if (Dot(light.direction, normal) >= kLeastCosine) return {};
  return Refused("lux_misses_light", "{dome.illuminance}",
                 "the meter faced away from the light that is to be solved from its reading; turn "
                 "it towards the light and say so with {dome.normal}");
}

void Multiply(double factor, Dome& dome, std::vector<DomeLight>& lights) {
  dome.Multiply(factor);
  for (DomeLight& light : lights) {
    light.flow = light.flow * factor;
    light.illuminance = light.illuminance * factor;
    light.luminance = light.luminance * factor;
    light.body.peak_nits *= factor;
    for (float& v : light.fill) v *= static_cast<float>(factor);
  }
}

Result<DomeScale> ByShading(const DomeReading& reading, double all, Dome& dome,
                            std::vector<DomeLight>& lights) {
  if (lights.empty()) {
    return Refused("no_light", "{dome.shaded}",
                   "the panorama shows no light that a card could have shaded");
  }
  if (auto facing = CheckFacing(lights[0], reading.normal); !facing) {
    return Propagate(std::move(facing));
  }
  const double rest = all - ByLight(lights[0], reading.normal);
  if (!(rest > 0.0)) return NoLight();
  const double direct = reading.illuminance.value() - reading.shaded->value();
  if (!(direct > 0.0)) {
    return Refused("lux_below_rest", "{dome.illuminance}",
                   LuxText(reading.illuminance.value()) + " is not above the shaded reading of " +
                       LuxText(reading.shaded->value()));
  }
  Multiply(reading.shaded->value() / rest, dome, lights);
  InferIlluminance(Lux(direct / Dot(lights[0].direction, reading.normal)), lights[0]);
  DomeScale scale;
  scale.factor = reading.shaded->value() / rest;
  scale.sd_relative = reading.sigma_relative;
  scale.inferred = 1;
  scale.inferred_sd_relative = reading.sigma_relative;  // one meter: both readings share its error
  return scale;
}

Result<DomeScale> ByRest(const DomeReading& reading, double all, std::vector<DomeLight>& lights) {
  std::vector<DomeLight*> clipped;
  double rest = all, weight = 0.0;
  for (DomeLight& light : lights) {
    if (!light.body.clipped) continue;
    if (auto facing = CheckFacing(light, reading.normal); !facing) {
      return Propagate(std::move(facing));
    }
    rest -= ByLight(light, reading.normal);
    weight += light.solid_angle.value() * Dot(light.direction, reading.normal);
    clipped.push_back(&light);
  }
  const double missing = reading.illuminance.value() - rest;
  if (!(missing > 0.0)) {
    return Refused("lux_below_rest", "{dome.illuminance}",
                   "everything but the clipped light gives " + LuxText(rest) +
                       " already, more than the reading of " +
                       LuxText(reading.illuminance.value()) +
                       ": the picture's scale, the reading or the meter's direction is wrong");
  }
  DomeScale scale;
  for (DomeLight* light : clipped) {
    InferIlluminance(Lux(missing * light->solid_angle.value() / weight), *light);
    ++scale.inferred;
  }
  scale.inferred_sd_relative = reading.sigma_relative * reading.illuminance.value() / missing;
  return scale;
}

}  // namespace

Result<DomeScale> ScaleDome(const DomeReading& reading, bool absolute, Dome& dome,
                            std::vector<DomeLight>& lights) {
  const double all = IlluminanceOn(dome.luminance(), dome.grid(), reading.normal).value();
  if (reading.shaded) return ByShading(reading, all, dome, lights);
  const bool clipped =
      std::ranges::any_of(lights, [](const DomeLight& light) { return light.body.clipped; });
  if (clipped && absolute) return ByRest(reading, all, lights);
  if (clipped) {
    return Refused(
        "clipped_scale_unknown", "{dome.illuminance}",
        "one reading cannot give both the picture's scale and the clipped light; read "
        "again with a card shading the light ({dome.shaded}), or give a picture in cd/m2 "
        "({MergeBracket} writes one)");
  }
  if (!(all > 0.0)) return NoLight();
  DomeScale scale;
  scale.factor = reading.illuminance.value() / all;
  scale.sd_relative = reading.sigma_relative;
  Multiply(scale.factor, dome, lights);
  return scale;
}

}  // namespace lightcal
