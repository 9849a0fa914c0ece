// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/cut_off_lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/imaging/panorama/turn_north.h"
#include "lightcal/imaging/scene/flat_top.h"
#include "lightcal/imaging/scene/picture_luminance.h"

namespace lightcal {
namespace {

// A few pixels far above the rest: a sun too small to be a light by what is left of it.
bool AreFewAndBright(const Dome& dome, const std::vector<std::uint8_t>& pixels) {
  constexpr double kFew = 0.01, kFarAbove = 3.0;  // of the sphere; times the mean luminance
  const LatLongGrid grid = dome.grid();
  double omega_ends = 0.0, ends = 0.0, all = 0.0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const double omega = grid.SolidAngle(grid.Y(static_cast<std::int32_t>(i)));
    all += omega * double{dome.nits[i]};
    if (pixels[i] == 0) continue;
    omega_ends += omega;
    ends += omega * double{dome.nits[i]};
  }
  constexpr double kSphere = 4.0 * std::numbers::pi;
  return omega_ends < kFew * kSphere && ends * kSphere > kFarAbove * all * omega_ends;
}

// Whether any is white in a picture with colour, as what is clipped in all channels alike.
bool AnyIsWhite(const Dome& dome, const std::vector<std::uint8_t>& pixels) {
  if (dome.channels != 3) return false;
  bool colour = false, any = false;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const float* const rgb = &dome.samples[3 * i];
    const bool white = rgb[0] == rgb[1] && rgb[1] == rgb[2];
    any |= white && pixels[i] != 0;
    colour |= !white;
  }
  return colour && any;
}

int EndsOf(const DomeLight& light, const std::vector<std::uint8_t>& pixels) {
  const auto ends = [&](std::int32_t i) { return pixels[static_cast<std::size_t>(i)] != 0; };
  return static_cast<int>(std::ranges::count_if(light.body.pixels, ends));
}

// What may be clipped.
struct Suspect {
  int pixels = 0;
  // Of the light they are of; absent: a few pixels far above the rest, or white ones, which are
  // none.
  std::optional<AzimuthElevation> light;
};
std::optional<Suspect> SuspectOf(const MeasuredDome& measured,
                                 const std::vector<std::uint8_t>& pixels) {
  for (const DomeLight& light : measured.lights) {
    const int ends = EndsOf(light, pixels);
    if (ends > 0) return Suspect{ends, AnglesOf(TurnedNorth(light.direction, measured.north))};
  }
  const Dome& dome = measured.input.dome;
  if (!AreFewAndBright(dome, pixels) && !AnyIsWhite(dome, pixels)) return std::nullopt;
  return Suspect{};
}

// "2 pixels of the light at ... share the picture's largest value"
std::string WordsOf(const Suspect& suspect) {
  constexpr const char* kShare = " share the picture's largest value";
  if (!suspect.light) {
    return std::string("pixels that are far brighter than the rest, or white as what is clipped,") +
           kShare;
  }
  const bool one = suspect.pixels == 1;
  return std::to_string(suspect.pixels) + (one ? " pixel" : " pixels") +
         " of the light at azimuth " + RoundedText(suspect.light->azimuth_deg, 3) + ", elevation " +
         RoundedText(suspect.light->elevation_deg, 3) +
         (one ? " ends at the picture's largest value" : kShare);
}

bool AnyFaces(const Dome& dome, const std::vector<std::uint8_t>& pixels, const Vec3& normal) {
  const LatLongGrid grid = dome.grid();
  for (std::size_t at = 0; at < pixels.size(); ++at) {
    const auto i = static_cast<std::int32_t>(at);
    if (pixels[at] != 0 && Dot(grid.Direction(grid.X(i), grid.Y(i)), normal) > 0.0) return true;
  }
  return false;
}

// Of the lights, those that hold such a pixel; of pixels too few for that, the lights they would
// be.
void MarkMaybeClipped(const std::vector<std::uint8_t>& pixels, MeasuredDome& measured) {
  bool any = false;
  for (DomeLight& light : measured.lights) {
    light.maybe_clipped = EndsOf(light, pixels) > 0;
    any |= light.maybe_clipped;
  }
  if (any) return;
  DomeInput marked = measured.input;
  marked.clipped = pixels;
  measured.lights = FindLights(marked, true);
  for (DomeLight& light : measured.lights) {
    light.maybe_clipped = light.body.clipped;
    light.body.clipped = false;
  }
}

std::string WhatItOpens(bool lit, bool absolute) {
  if (!lit) return ", and the picture's lux are a lower bound";
  if (absolute) return " that the meter saw, and the scale holds that";
  return " that the meter saw, so the scale is anything from the picture as it is down to where "
         "they gave nearly all of the reading, or as much as the sun can";
}

// What a card says of lights that end at the picture's largest value.
enum class CardSays : std::uint8_t { kClipped, kNothing };

tl::unexpected<Error> ShadedLightUnknown(const char* why) {
  return Refused("shaded_light_unknown", "{dome.shaded}",
                 std::string(why) +
                     ": say from which value samples are clipped ({dome.clip}; above them all if "
                     "lights were drawn flat)");
}

// Of two lights and more that may be clipped the shaded reading holds what the others lack; of one
// that was not shaded, both readings hold it. One, c, that shows less than the card took away is
// clipped and was shaded, unless another light u shows as much as the card took, or more, which it
// does where the meter saw what c lacks. One that shows what the card took was shaded, whole,
// unless the card took hardly anything, by what two readings differ, and u could have been it as
// well.
Result<CardSays> JudgeCard(const DomeReading& reading, const std::vector<std::uint8_t>& pixels,
                           const MeasuredDome& measured) {
  DomeInput marked = measured.input;
  marked.clipped = pixels;
  const std::vector<DomeLight> ends = FindLights(marked, true);
  const auto may_be = [&](const DomeLight& light) {
    return light.body.clipped && LightsMeter(light, reading.normal);
  };
  const std::ptrdiff_t count = std::ranges::count_if(ends, may_be);
  if (count == 0) return CardSays::kNothing;
  if (count > 1) {
    return Refused("several_clipped", "{dome.shaded}",
                   std::to_string(count) +
                       " lights that lit the meter end at the picture's largest value; clipped, "
                       "the shaded reading still holds all but one of them: merge a bracket whose "
                       "shortest frame clips none ({MergeBracket}), or, if they were drawn flat, "
                       "say that none is ({dome.clip}, above them all)");
  }
  const Dome& dome = measured.input.dome;
  const double all = IlluminanceOn(dome.luminance(), dome.grid(), reading.normal).value();
  const DomeLight& c = *std::ranges::find_if(ends, may_be);
  const ShadingBy by_c = ShadingOf(reading, all, c);
  const bool other_fits = std::ranges::any_of(measured.lights, [&](const DomeLight& u) {
    if (EndsOf(u, pixels) > 0) return false;
    const ShadingBy by = ShadingOf(reading, all, u);
    return by == ShadingBy::kAsPixelsSay || by == ShadingBy::kLess;
  });
  if (by_c == ShadingBy::kMore) {
    if (!other_fits) return CardSays::kClipped;
    return ShadedLightUnknown(
        "the card took away more than the light shows that ends at the picture's largest value, "
        "and another light could have been the one that it shaded");
  }
  if (!other_fits || (by_c == ShadingBy::kAsPixelsSay && TookLight(reading))) {
    return CardSays::kNothing;
  }
  return ShadedLightUnknown(
      "a light that ends at the picture's largest value lit the meter, and shows more than the "
      "card took away, or as much within what two readings differ by: another light was shaded, "
      "and both readings hold what this one may lack");
}

}  // namespace

std::vector<DomeLight> FindLights(const DomeInput& input, bool clipped_always) {
  const Dome& dome = input.dome;
  return MeasureDomeLights(
      dome,
      FindBrightBodies(dome.luminance(), dome.grid(),
                       {.clipped = input.clipped, .clipped_always = clipped_always}),
      input.clipped);
}

Result<void> JudgePlateaus(const DomeRequest& request, const std::optional<DomeReading>& reading,
                           MeasuredDome& measured) {
  DomeInput& input = measured.input;
  if (request.input.clip || std::ranges::find(input.clipped, 1) != input.clipped.end()) return {};
  const Dome& dome = input.dome;
  std::vector<std::uint8_t> pixels = CutOffPixels(dome.samples, dome.channels, dome.nits);
  if (pixels.empty()) return {};
  const bool one_reading = reading && !reading->shaded;
  const std::optional<Suspect> suspect = SuspectOf(measured, pixels);
  if (!suspect) return {};
  const bool lit = one_reading && AnyFaces(dome, pixels, reading->normal);
  const auto exceeds = [&] {
    const double seen = IlluminanceOn(dome.luminance(), dome.grid(), reading->normal).value();
    const double u95 = input.scale_u95_relative.value_or(kUnstatedScaleU95);
    return reading->illuminance.value() > seen * (1.0 + u95);
  };
  bool clipped = lit && input.absolute && exceeds();
  if (reading && reading->shaded) {
    const auto card = JudgeCard(*reading, pixels, measured);
    if (!card) return tl::unexpected(card.error());
    clipped = *card == CardSays::kClipped;
  }
  if (clipped) {
    input.clipped = std::move(pixels);
    measured.lights = FindLights(input, true);
    return {};
  }
  if (!suspect->light && reading && reading->shaded) return {};
  MarkMaybeClipped(pixels, measured);
  if (lit && input.absolute) {
    measured.missing_sd = input.scale_u95_relative.value_or(kUnstatedScaleU95) / kZ95;
  }
  measured.warnings.push_back(
      {"maybe_clipped", input.files.front(),
       WordsOf(*suspect) + "; clipped, they lack light" + WhatItOpens(lit, input.absolute) +
           ". To be sure: read again with the light shaded ({dome.shaded}) or the meter turned "
           "away from it ({dome.normal}), merge a bracket with a darker frame ({MergeBracket}), "
           "or say from where samples are clipped ({dome.clip}; above them all if these were "
           "drawn)"});
  return {};
}

}  // namespace lightcal
