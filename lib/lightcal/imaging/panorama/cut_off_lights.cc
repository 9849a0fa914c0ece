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

// So many pixels that share the picture's largest value are clipped, or drawn.
constexpr int kPlateau = 2;
// What a light that may be clipped may hold of all that the meter saw: under a clear sky the sun
// has up to nine tenths.
constexpr double kMostMissing = 0.9;

// Whether the one pixel that is brightest ends where a format does, or is as bright as any in two
// channels alike, which no light is by chance in a picture with colour.
bool IsCutOffPixel(const Dome& dome, std::size_t at) {
  if (IsFormatsEnd(dome.nits[at])) return true;
  if (dome.channels != 3) return false;
  std::array<float, 3> most{};
  bool colour = false;
  for (std::size_t i = 0; i + 2 < dome.samples.size(); i += 3) {
    for (std::size_t c = 0; c < 3; ++c) most[c] = std::max(most[c], dome.samples[i + c]);
    colour = colour || dome.samples[i] != dome.samples[i + 1];
  }
  int alike = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t next = (c + 1) % 3;
    if (dome.samples[3 * at + c] == most[c] && most[c] == most[next]) ++alike;
  }
  return colour && alike > 0;
}

// A channel's largest value, where it is cut off there: what is smooth, noisy or of eight bits of
// mantissa has neighbours within 2 %.
std::optional<float> ChannelEnd(const Dome& dome, std::size_t channel) {
  constexpr int kLeast = 4, kMoreThanNear = 4;
  constexpr float kNear = 0.98F;
  float most = 0.0F;
  for (std::size_t i = channel; i < dome.samples.size(); i += 3) {
    most = std::max(most, dome.samples[i]);
  }
  int at = 0, near = 0;
  for (std::size_t i = channel; i < dome.samples.size(); i += 3) {
    const float v = dome.samples[i];
    if (v > kNear * most) ++(v == most ? at : near);
  }
  return at >= kLeast && at > kMoreThanNear * near ? std::optional(most) : std::nullopt;
}

// Pixels at the picture's largest luminance, and at a channel's largest value, where they are cut
// off there: 1. Empty: nothing is.
std::vector<std::uint8_t> CutOffPixels(const Dome& dome) {
  const FlatTop top = TopOf(dome.nits);
  const auto at = std::ranges::find(dome.nits, top.value) - dome.nits.begin();
  const bool cut_off =
      top.at == 1 ? IsCutOffPixel(dome, static_cast<std::size_t>(at)) : IsCutOff(top, kPlateau);
  std::vector<std::uint8_t> pixels;
  if (cut_off) pixels = PixelsFrom(dome.luminance(), double{top.value});
  for (std::size_t c = 0; c < 3 && dome.channels == 3; ++c) {
    const std::optional<float> end = ChannelEnd(dome, c);
    if (!end) continue;
    pixels.resize(dome.nits.size(), 0);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      if (dome.samples[3 * i + c] >= *end) pixels[i] = 1;
    }
  }
  return pixels;
}

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

int EndsOf(const DomeLight& light, const std::vector<std::uint8_t>& pixels) {
  const auto ends = [&](std::int32_t i) { return pixels[static_cast<std::size_t>(i)] != 0; };
  return static_cast<int>(std::ranges::count_if(light.body.pixels, ends));
}

// What may be clipped.
struct Suspect {
  int pixels = 0;
  // Of the light they are of; absent: a few pixels far above the rest, which are none.
  std::optional<AzimuthElevation> light;
};
std::optional<Suspect> SuspectOf(const MeasuredDome& measured,
                                 const std::vector<std::uint8_t>& pixels) {
  for (const DomeLight& light : measured.lights) {
    const int ends = EndsOf(light, pixels);
    if (ends > 0) return Suspect{ends, AnglesOf(TurnedNorth(light.direction, measured.north))};
  }
  if (!AreFewAndBright(measured.input.dome, pixels)) return std::nullopt;
  return Suspect{};
}

// "2 pixels of the light at ... share the picture's largest value"
std::string WordsOf(const Suspect& suspect) {
  constexpr const char* kShare = " share the picture's largest value";
  if (!suspect.light) {
    return std::string("a pixel or a few that are far brighter than the rest") + kShare;
  }
  const bool one = suspect.pixels == 1;
  return std::to_string(suspect.pixels) + (one ? " pixel" : " pixels") +
         " of the light at azimuth " + RoundedText(suspect.light->azimuth_deg, 3) + ", elevation " +
         RoundedText(suspect.light->elevation_deg, 3) +
         (one ? " ends at the picture's largest value" : kShare);
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
  std::vector<std::uint8_t> pixels = CutOffPixels(input.dome);
  if (pixels.empty()) return {};
  const bool one_reading = reading && !reading->shaded;
  const std::optional<Suspect> suspect = SuspectOf(measured, pixels);
  // Only a reading would be divided by what a few pixels lack.
  if (!suspect || (!suspect->light && !reading)) return {};
  const auto exceeds = [&] {
    const double seen =
        IlluminanceOn(input.dome.luminance(), input.dome.grid(), reading->normal).value();
    const double u95 = input.scale_u95_relative.value_or(kUnstatedScaleU95);
    return reading->illuminance.value() > seen * (1.0 + u95);
  };
  bool clipped = one_reading && input.absolute && exceeds();
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
  if (!suspect->light && !one_reading) return {};
  if (one_reading) {
    const double of_file = input.scale_u95_relative.value_or(kUnstatedScaleU95);
    measured.missing_sd = (input.absolute ? of_file : kMostMissing) / kZ95;
  }
  measured.warnings.push_back(
      {"maybe_clipped", input.files.front(),
       WordsOf(*suspect) + "; clipped, they lack light" +
           (one_reading ? " that the meter saw, and the scale holds that" : "") +
           ": say from where samples are clipped ({dome.clip}; above them all if these were drawn) "
           "and read again with the light shaded ({dome.shaded})"});
  return {};
}

}  // namespace lightcal
