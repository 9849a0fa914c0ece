// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/dome_scale.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/imaging/scene/picture_luminance.h"

namespace lightcal {
namespace {

constexpr double kMostOverRest = 19.0;
constexpr double kSunOutside_lx = 138e3;
constexpr double kLeastCosine = 0.05;  // grazing light is no measurement of its source

std::string LuxText(double lux) { return RoundedText(lux, 4) + " lx"; }

double ByLight(const DomeLight& light, const Vec3& normal) {
  return std::max(0.0, Dot(light.flow, normal));
}

double MostByRest(double rest_lx, double shown_lx) {
  return std::max(kMostOverRest * rest_lx, 2.0 * shown_lx);
}

// Infinite of what is no sun.
double MostOfSun(std::span<const DomeLight* const> lights, const Vec3& normal) {
  if (lights.size() != 1 || !(lights.front()->direction[2] > 0.0) ||
      !(lights.front()->angular_diameter < kWidestSun)) {
    return std::numeric_limits<double>::infinity();
  }
  return kSunOutside_lx * std::max(0.0, Dot(lights.front()->direction, normal));
}

tl::unexpected<Error> NoLight() {
  return Refused("no_light", "{dome.illuminance}",
                 "the panorama shows nothing bright on the side the meter faced; check "
                 "{dome.normal} and that the picture is not black");
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

constexpr double kAgreeSd = 2.0;
double ReadingsDifferBy(const DomeReading& reading) {
  return kAgreeSd * std::numbers::sqrt2 * reading.sigma_relative;
}

// What a reading and the picture's own scale say together.
DomeScale Agreed(double read_factor, double read_sd, std::optional<double> stated_sd) {
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

tl::unexpected<Error> SeveralClipped(std::ptrdiff_t count) {
  return Refused("several_clipped", "{dome.shaded}",
                 std::to_string(count) +
                     " clipped lights lit the meter, and the shaded reading still holds all but "
                     "one of them: merge a bracket whose shortest frame clips none "
                     "({MergeBracket}); or, of a picture in cd/m2, leave out {dome.shaded}: they "
                     "share the reading then");
}

// ln of what the card took the reading down by, over what it would have by the light's pixels.
double OffPixels(const DomeReading& reading, double all, const DomeLight& light) {
  const double rest = all - ByLight(light, reading.normal);
  return std::log(reading.illuminance.value() / reading.shaded->value() * rest / all);
}

// The light that the card was held before: the one that is clipped, else the one whose pixels are
// best what the card took away, else the brightest.
Result<DomeLight*> ShadedLight(const DomeReading& reading, double all,
                               std::vector<DomeLight>& lights) {
  if (lights.empty()) {
    return Refused("no_light", "{dome.shaded}",
                   "the panorama shows no light that a card could have shaded");
  }
  const auto faces = [&](const DomeLight& light) { return LightsMeter(light, reading.normal); };
  const auto lost = [&](const DomeLight& light) { return light.body.clipped && faces(light); };
  const std::ptrdiff_t clipped = std::ranges::count_if(lights, lost);
  if (clipped > 1) return SeveralClipped(clipped);
  if (clipped == 1) return &*std::ranges::find_if(lights, lost);
  DomeLight* nearest = nullptr;
  for (DomeLight& light : lights) {
    if (ShadingOf(reading, all, light) != ShadingBy::kAsPixelsSay) continue;
    if (nearest == nullptr ||
        std::abs(OffPixels(reading, all, light)) < std::abs(OffPixels(reading, all, *nearest))) {
      nearest = &light;
    }
  }
  if (nearest != nullptr) return nearest;
  DomeLight& brightest = lights.front();
  if (!faces(brightest)) return FacedAway();
  const auto dimmer = [&](const DomeLight& light) {
    return light.body.peak_nits <= brightest.body.peak_nits;
  };
  if (ShadingOf(reading, all, brightest) == ShadingBy::kMore &&
      !std::ranges::all_of(lights, dimmer)) {
    return Refused("shaded_light_unknown", "{dome.shaded}",
                   "the card took away more than any light of the picture gives, so one is "
                   "clipped, and the picture does not show which: say from which value samples "
                   "are clipped ({dome.clip})");
  }
  return &brightest;
}

Result<DomeScale> ByShading(const DomeReading& reading, double all, std::optional<double> stated_sd,
                            Dome& dome, std::vector<DomeLight>& lights) {
  const Result<DomeLight*> light = ShadedLight(reading, all, lights);
  if (!light) return tl::unexpected(light.error());
  DomeLight& shaded = **light;
  const double rest = all - ByLight(shaded, reading.normal);
  if (!(rest > 0.0)) return NoLight();
  const double direct = reading.illuminance.value() - reading.shaded->value();
  if (!(direct > 0.0)) {
    return Refused("lux_below_rest", "{dome.illuminance}",
                   LuxText(reading.illuminance.value()) + " is not above the shaded reading of " +
                       LuxText(reading.shaded->value()));
  }
  const ShadingBy by = ShadingOf(reading, all, shaded);
  DomeScale scale = Agreed(reading.shaded->value() / rest, reading.sigma_relative, stated_sd);
  Multiply(scale.factor, dome, lights);
  scale.shading_of_pixels = by == ShadingBy::kLess ? direct / ByLight(shaded, reading.normal) : 1.0;
  InferIlluminance(Lux(direct / Dot(shaded.direction, reading.normal)), shaded);
  scale.inferred = 1;
  scale.inferred_sd_relative = reading.sigma_relative;  // one meter: both readings share its error
  return scale;
}

// Lights that share so many lux on the meter, by their solid angles.
class Shares {
 public:
  Shares(std::span<DomeLight* const> lights, const Vec3& normal) {
    for (const DomeLight* light : lights) {
      weight_ += light->solid_angle.value() * Dot(light->direction, normal);
    }
  }
  // At normal incidence.
  [[nodiscard]] Lux Of(const DomeLight& light, double on_meter) const {
    return Lux(on_meter * light.solid_angle.value() / weight_);
  }

 private:
  double weight_ = 0.0;
};

Result<DomeScale> ByRange(const DomeReading& reading, double all, Dome& dome,
                          std::vector<DomeLight>& lights) {
  std::vector<DomeLight*> ends;
  double shown = 0.0;
  for (DomeLight& light : lights) {
    const double part = ByLight(light, reading.normal);
    if (!light.maybe_clipped || !(part > 0.0)) continue;
    ends.push_back(&light);
    shown += part;
  }
  const double rest = all - shown;
  if (!(rest > 0.0)) return NoLight();
  const double lux = reading.illuminance.value();
  const double high = lux / all;
  const std::vector<const DomeLight*> seen(ends.begin(), ends.end());
  // E = k (rest + most(rest)): once by what the rest allows, once by what a sun does.
  const double by_rest = lux / (rest + MostByRest(rest, shown));
  const double sun = MostOfSun(seen, reading.normal);
  const double by_sun = (lux - sun) / rest;
  const double low = by_sun < high ? std::max(by_rest, by_sun) : by_rest;
  DomeScale scale = Agreed(std::sqrt(low * high), reading.sigma_relative, std::nullopt);
  scale.range_ln = 0.5 * std::log(high / low);
  Multiply(scale.factor, dome, lights);
  std::erase_if(ends, [&](const DomeLight* light) { return !LightsMeter(*light, reading.normal); });
  const Shares shares(ends, reading.normal);
  const double error = kZ95 * reading.sigma_relative;
  for (DomeLight* light : ends) {
    const double as_shown = light->illuminance.value() / scale.factor;
    InferIlluminance(shares.Of(*light, lux - scale.factor * rest), *light);
    light->at_least = Lux(std::min(light->illuminance.value(), high * as_shown) * (1.0 - error));
    light->at_most = shares.Of(*light, lux * (1.0 + error) - low * rest);
    ++scale.inferred;
  }
  scale.inferred_sd_relative = reading.sigma_relative;
  return scale;
}

Result<DomeScale> ByRest(const DomeReading& reading, double all, double scale_sd,
                         std::vector<DomeLight>& lights) {
  std::vector<DomeLight*> clipped;
  double rest = all;
  for (DomeLight& light : lights) {
    if (!light.body.clipped) continue;
    // What shone past the meter stays a lower bound, as long as something clipped lit it.
    if (!LightsMeter(light, reading.normal)) continue;
    rest -= ByLight(light, reading.normal);
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
  // A picture too dark by its scale leaves the lights too much: the scale's error comes whole.
  const double sd =
      std::hypot(reading.sigma_relative * reading.illuminance.value(), scale_sd * rest);
  const double shown = (all - rest) * std::exp(-kZ95 * scale_sd);
  scale.inferred_sd_relative = sd / missing;
  const Shares shares(clipped, reading.normal);
  for (DomeLight* light : clipped) {
    InferIlluminance(shares.Of(*light, missing), *light);
    ++scale.inferred;
    if (kZ95 * sd < missing) continue;
    // Of a difference that may be nothing, what the pixels show is left.
    light->at_least = shares.Of(*light, std::min(shown, missing));
    light->at_most = shares.Of(*light, missing + kZ95 * sd);
  }
  return scale;
}

}  // namespace

bool LightsMeter(const DomeLight& light, const Vec3& normal) {
  return Dot(light.direction, normal) >= kLeastCosine;
}

bool TookLight(const DomeReading& reading) {
  const double ratio = reading.illuminance.value() / reading.shaded->value();
  return std::log(ratio) > ReadingsDifferBy(reading);
}

double MostOfCutOff(std::span<const DomeLight* const> lights, const Vec3& normal, double rest_lx) {
  double shown = 0.0;
  for (const DomeLight* light : lights) shown += ByLight(*light, normal);
  const double most = MostByRest(rest_lx, shown);
  const double sun = MostOfSun(lights, normal);
  return sun > shown ? std::min(most, sun) : most;
}

ShadingBy ShadingOf(const DomeReading& reading, double all_lux, const DomeLight& light) {
  if (!LightsMeter(light, reading.normal)) return ShadingBy::kNotSeen;
  const double rest = all_lux - ByLight(light, reading.normal);
  if (!(rest > 0.0)) return ShadingBy::kLess;
  const double off = OffPixels(reading, all_lux, light);
  if (std::abs(off) <= ReadingsDifferBy(reading)) {
    return ShadingBy::kAsPixelsSay;
  }
  return off > 0.0 ? ShadingBy::kMore : ShadingBy::kLess;
}

Result<DomeScale> ScaleDome(const DomeReading& reading, bool absolute,
                            std::optional<double> stated_sd, Dome& dome,
                            std::vector<DomeLight>& lights) {
  const double all = IlluminanceOn(dome.luminance(), dome.grid(), reading.normal).value();
  if (!absolute) stated_sd.reset();
  if (reading.shaded) return ByShading(reading, all, stated_sd, dome, lights);
  const bool clipped =
      std::ranges::any_of(lights, [](const DomeLight& light) { return light.body.clipped; });
  if (clipped && absolute) {
    return ByRest(reading, all, stated_sd.value_or(kUnstatedScaleU95 / kZ95), lights);
  }
  if (clipped) {
    return Refused(
        "clipped_scale_unknown", "{dome.illuminance}",
        "one reading cannot give both the picture's scale and the clipped light; read "
        "again with a card shading the light ({dome.shaded}), or give a picture in cd/m2 "
        "({MergeBracket} writes one)");
  }
  if (!(all > 0.0)) return NoLight();
  const bool may_lack = std::ranges::any_of(lights, [&](const DomeLight& light) {
    return light.maybe_clipped && ByLight(light, reading.normal) > 0.0;
  });
  if (may_lack && !absolute) return ByRange(reading, all, dome, lights);
  const DomeScale scale =
      Agreed(reading.illuminance.value() / all, reading.sigma_relative, stated_sd);
  Multiply(scale.factor, dome, lights);
  return scale;
}

}  // namespace lightcal
