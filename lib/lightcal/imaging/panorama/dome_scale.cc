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

bool Faces(const DomeLight& light, const Vec3& normal) {
  return Dot(light.direction, normal) >= kLeastCosine;
}

tl::unexpected<Error> FacedAway() {
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

// What a reading and the picture's own scale say together.
DomeScale Agreed(double read_factor, double read_sd, std::optional<double> stated_sd) {
  constexpr double kAgreeSd = 2.0;
  DomeScale scale;
  scale.factor = scale.read_factor = read_factor;
  scale.sd_relative = read_sd;
  if (!stated_sd || !(*stated_sd > 0.0) || !(read_sd > 0.0)) return scale;
  const double both = std::hypot(*stated_sd, read_sd);
  if (std::abs(std::log(read_factor)) > kAgreeSd * both) return scale;
  scale.read_weight = std::pow(*stated_sd / both, 2);
  scale.factor = std::pow(read_factor, scale.read_weight);
  scale.sd_relative = *stated_sd * read_sd / both;
  return scale;
}

Result<DomeScale> ByShading(const DomeReading& reading, double all, std::optional<double> stated_sd,
                            Dome& dome, std::vector<DomeLight>& lights) {
  if (lights.empty()) {
    return Refused("no_light", "{dome.shaded}",
                   "the panorama shows no light that a card could have shaded");
  }
  if (!Faces(lights[0], reading.normal)) return FacedAway();
  const double rest = all - ByLight(lights[0], reading.normal);
  if (!(rest > 0.0)) return NoLight();
  const double direct = reading.illuminance.value() - reading.shaded->value();
  if (!(direct > 0.0)) {
    return Refused("lux_below_rest", "{dome.illuminance}",
                   LuxText(reading.illuminance.value()) + " is not above the shaded reading of " +
                       LuxText(reading.shaded->value()));
  }
  DomeScale scale = Agreed(reading.shaded->value() / rest, reading.sigma_relative, stated_sd);
  Multiply(scale.factor, dome, lights);
  InferIlluminance(Lux(direct / Dot(lights[0].direction, reading.normal)), lights[0]);
  scale.inferred = 1;
  scale.inferred_sd_relative = reading.sigma_relative;  // one meter: both readings share its error
  return scale;
}

Result<DomeScale> ByRest(const DomeReading& reading, double all, std::vector<DomeLight>& lights) {
  std::vector<DomeLight*> clipped;
  double rest = all, weight = 0.0;
  for (DomeLight& light : lights) {
    if (!light.body.clipped) continue;
    // What shone past the meter stays a lower bound, as long as something clipped lit it.
    if (!Faces(light, reading.normal)) continue;
    rest -= ByLight(light, reading.normal);
    weight += light.solid_angle.value() * Dot(light.direction, reading.normal);
    clipped.push_back(&light);
  }
  if (clipped.empty()) return FacedAway();
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

Result<DomeScale> ScaleDome(const DomeReading& reading, bool absolute,
                            std::optional<double> stated_sd, Dome& dome,
                            std::vector<DomeLight>& lights) {
  const double all = IlluminanceOn(dome.luminance(), dome.grid(), reading.normal).value();
  if (!absolute) stated_sd.reset();
  if (reading.shaded) return ByShading(reading, all, stated_sd, dome, lights);
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
  const DomeScale scale =
      Agreed(reading.illuminance.value() / all, reading.sigma_relative, stated_sd);
  Multiply(scale.factor, dome, lights);
  return scale;
}

}  // namespace lightcal
