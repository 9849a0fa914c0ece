// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/render_cause.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>

#include "lightcal/colorimetry/srgb_encoding.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units.h"
#include "lightcal/core/units_text.h"
#include "lightcal/presets/check/reader_parts.h"
#include "lightcal/presets/check/render_lamps.h"
#include "lightcal/presets/check/render_shape.h"
#include "lightcal/presets/check/render_tint.h"

namespace lightcal {
namespace {

constexpr double kAsItShould = 0.02;   // |ln| of a factor that is nobody's mistake
constexpr double kSameFactor = 0.025;  // |ln| between what is seen and what a mistake does
constexpr double kCurveShows = 0.08;   // |ln| of the cards' ratio over what it should be
using Rgb3 = std::array<double, 3>;

// A white card of reflectance 1, by least squares over the cards that are not clipped.
std::optional<Rgb3> PerfectWhite(const CheckedRig& rig, const std::array<CardPixels, 2>& cards) {
  Rgb3 white{};
  for (std::size_t c = 0; c < 3; ++c) {
    double above = 0.0, below = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
      if (cards[i].clipped[c]) continue;
      const double rho = rig.cards[i].reflectance;
      const double weight =
          cards[i].step[c] > 0.0 ? 1.0 / (cards[i].step[c] * cards[i].step[c]) : 1.0 / (rho * rho);
      above += weight * cards[i].rgb[c] * rho;
      below += weight * rho * rho;
    }
    if (!(below > 0.0)) return std::nullopt;
    white[c] = above / below;
  }
  return white;
}

// Its luminance where the tint is the lamp's: one figure for all samples that are not clipped.
// Eight bits with a clipped white card say more that way.
double LuminanceInTint(const CheckedRig& rig, const std::array<CardPixels, 2>& cards,
                       const Rgb3& tint) {
  double above = 0.0, below = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (cards[i].clipped[c] || !(cards[i].step[c] > 0.0)) continue;
      const double expected = rig.cards[i].reflectance * tint[c];
      const double weight = 1.0 / (cards[i].step[c] * cards[i].step[c]);
      above += weight * cards[i].rgb[c] * expected;
      below += weight * expected * expected;
    }
  }
  return below > 0.0 ? above / below * Rec709Luminance(tint) : 0.0;
}

double ScaleOf(const CheckedRig& rig, PixelUnit unit) {
  constexpr double kBlenderLumensPerWatt = 683.0;
  switch (unit) {
    case PixelUnit::kNits:
      return 1.0;
    case PixelUnit::kWatts:
      return 1.0 / kBlenderLumensPerWatt;
    case PixelUnit::kExposed:
      break;
  }
  return rig.scale;
}

// ---- the cards' ratio ----

std::optional<RenderCause> CurveIn(const CheckedRig& rig, const std::array<CardPixels, 2>& cards) {
  const double want = rig.cards[0].reflectance * rig.cards[0].expected_lx /
                      (rig.cards[1].reflectance * rig.cards[1].expected_lx);
  double worst = 0.0, raw = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    if (cards[0].clipped[c] || cards[1].clipped[c]) continue;
    if (!(cards[0].rgb[c] > 0.0) || !(cards[1].rgb[c] > 4.0 * cards[1].step[c])) continue;
    const double off = std::log(cards[0].rgb[c] / cards[1].rgb[c] / want);
    if (std::abs(off) <= std::abs(worst)) continue;
    worst = off;
    raw = std::log(cards[0].raw[c] / cards[1].raw[c] / want);
  }
  if (std::abs(worst) < kCurveShows) return std::nullopt;
  if (std::abs(raw) < kCurveShows) {
    return RenderCause{"not_srgb_encoded",
                       "the file holds linear samples where sRGB codes belong; "
                       "save an EXR, or switch the view transform to sRGB/Standard"};
  }
  const double srgb = std::log(SrgbEncoded(rig.cards[0].reflectance) /
                               SrgbEncoded(rig.cards[1].reflectance) / want);
  if (std::abs(worst - srgb) < kCurveShows) {
    return RenderCause{"encoded_twice",
                       "the samples are sRGB encoded once too often; save linear "
                       "samples to EXR, and encode once to PNG"};
  }
  return RenderCause{"tone_mapped",
                     "the white and the grey card are not as far apart as they are: "
                     "a tone curve (Filmic, AgX, ACES) is on; use Standard or linear"};
}

// ---- the factor ----

double ConeSr(double degrees) {
  return 2.0 * std::numbers::pi * (1.0 - std::cos(std::min(degrees, 90.0) * kRadiansPerDegree));
}

std::vector<RenderCause> KnownFactors(const CheckedRig& rig) {
  const CheckedLamp& lamp = rig.lamps[rig.lamp];
  const double d = rig.separation_m;
  const double y = lamp.color_luminance;
  const bool has_place = lamp.kind != "directional" && lamp.kind != "dome";
  std::vector<RenderCause> list = {
      {"missing_luminance_division",
       "the intensity was not divided by the luminance Y of its colour; write I/Y", y},
      {"luminance_divided_twice",
       "the intensity was divided by Y although the engine's colour has luminance 1; write I",
       1 / y},
      {"times_pi",
       "pi too much: an irradiance or flux factor; a white card under E lx is E/pi nits",
       std::numbers::pi},
      {"over_pi", "pi too little: a Lambert 1/pi is applied twice, or a flux was taken for pi I",
       1 / std::numbers::pi},
      {"lumens_as_candela", "lumens were written where the engine takes candela (x 4 pi)",
       4 * std::numbers::pi},
      {"candela_as_lumens", "candela were written where the engine takes lumens (/ 4 pi)",
       1 / (4 * std::numbers::pi)},
      {"lumens_per_watt_683_for_177", "683 lm/W where the IES node counts 177.83: write 177.83/683",
       683.0 / 177.83},
      {"lumens_per_watt_177_for_683",
       "177.83 lm/W where the light counts 683: write 1/683 per lumen", 177.83 / 683.0},
      {"times_683", "lumens were written as watts: divide by 683", 683.0},
      {"over_683",
       "the picture is in watts (Blender EXR): give {render.engine} blender, or multiply by 683",
       1.0 / 683.0},
      {"area_factor", "an area light's factor: pi L A from Blender 4.0 on, 4 L A before",
       4 / std::numbers::pi},
      {"area_factor", "an area light's factor: 4 L A before Blender 4.0, pi L A from it on",
       std::numbers::pi / 4},
      {"diameter_for_radius", "a radius was given as a diameter, or a diameter as a radius", 4.0},
      {"diameter_for_radius", "a diameter was given as a radius, or a radius as a diameter", 0.25},
      {"centimetres", "centimetres and metres are mixed: 1 cd/cm2 = 10^4 cd/m2", 1e4},
      {"centimetres", "centimetres and metres are mixed: 1 cd/m2 = 10^-4 cd/cm2", 1e-4},
      {"footcandles", "footcandles were taken for lux (or feet for metres)", 1 / kLuxPerFootcandle},
      {"footcandles", "lux were taken for footcandles (or metres for feet)", kLuxPerFootcandle},
      {"exposure_missing",
       "the exposure was not applied: samples are cd/m2 (give {render.engine} three?)",
       1 / rig.scale},
      {"ev100_calibration", "EV100 = log2(1/(1.2 k)) and log2(1/k) were mixed up (Unreal)", 1.2},
      {"ev100_calibration", "EV100 = log2(1/(1.2 k)) and log2(1/k) were mixed up (Unreal)",
       1 / 1.2},
  };
  if (has_place) {
    list.push_back({"falloff_1_over_d",
                    "light falls with 1/d, not 1/d^2: set the decay or attenuation to 2", d});
    list.push_back(
        {"falloff_none", "light does not fall with distance: set its decay to 2", d * d});
    if (const double edge = 1.0 - std::pow(d / 10.0, 4); edge > 0.0) {
      list.push_back({"default_range",
                      "the engine's range window of 10 m dims the light: write a "
                      "larger range",
                      edge * edge});
    }
  }
  if (lamp.surface_m2 > 0.0) {
    list.push_back(
        {"divided_by_area",
         "the light is divided by its area, as if normalize were on: it stands for cd/m2",
         1.0 / lamp.surface_m2});
    list.push_back({"times_area", "the light is multiplied by its area: write its luminance",
                    lamp.surface_m2});
  }
  if (lamp.kind == "directional") {
    constexpr double kSunsDisc_sr = 6.7199e-5;  // pi sin^2(.265 degrees)
    list.push_back({"sun_per_disc",
                    "a normalised sun is taken relative to a disc of .53 degrees (RenderMan)",
                    kSunsDisc_sr});
    list.push_back({"sun_per_disc",
                    "the sun's lux are taken for the luminance of a disc of .53 degrees",
                    1.0 / kSunsDisc_sr});
  }
  if (lamp.outer_deg > 0.0) {
    const double own = ConeSr(lamp.outer_deg);
    list.push_back(
        {"full_cone_for_half",
         "the full cone angle was given where the half angle belongs: lumens spread over "
         "a wider cone",
         own / ConeSr(2.0 * lamp.outer_deg)});
    list.push_back({"half_cone_for_full",
                    "the half cone angle was given where the full angle belongs: lumens squeezed "
                    "into a narrower cone",
                    own / ConeSr(lamp.outer_deg / 2.0)});
    list.push_back({"spot_lumens",
                    "the engine's spot lumens are pi I or 4 pi I, whatever the cone; "
                    "write candela",
                    own / std::numbers::pi});
  }
  std::ranges::move(ConeMistakes(rig), std::back_inserter(list));
  return list;
}

}  // namespace

namespace {

// Whether the factor is one of the place of these cards, and another elsewhere.
bool IsOfPlace(const RenderCause& cause, bool on_axis) {
  constexpr std::array<std::string_view, 3> kOfDistance = {"falloff_1_over_d", "falloff_none",
                                                           "default_range"};
  constexpr std::array<std::string_view, 5> kOfAngle = {"full_cone_for_half", "half_cone_for_full",
                                                        "inner_cone_missing", "penumbra_missing",
                                                        "other_cone_law"};
  return std::ranges::find(kOfDistance, cause.code) != kOfDistance.end() ||
         (!on_axis && std::ranges::find(kOfAngle, cause.code) != kOfAngle.end());
}

bool IsWholeStops(double log_factor) {
  const double stops = log_factor / std::numbers::ln2;
  return std::abs(stops - std::round(stops)) * std::numbers::ln2 < kSameFactor &&
         std::round(stops) != 0.0 && std::abs(stops) < 4.5;
}

// What a lamp or an exposure that somebody changed does, beside a mistake of the same factor.
std::optional<RenderCause> ChangedIntensity(const CheckedRig& rig,
                                            const std::vector<RenderCause>& fits, double factor) {
  const bool on_axis = rig.off_axis_deg == 0.0;
  const auto placed = std::ranges::find_if(
      fits, [&](const RenderCause& cause) { return IsOfPlace(cause, on_axis); });
  if (placed == fits.end() && !IsWholeStops(std::log(factor))) return std::nullopt;
  std::string message = "the intensity or the exposure was changed by this factor (" +
                        RoundedText(std::log2(factor), 2) + " stops)";
  if (placed != fits.end() && on_axis) {
    message += ". A picture of a rig at another distance than " + RoundedText(rig.separation_m, 3) +
               " m tells them apart: this stays as it is there, " + placed->code + " does not";
  } else if (placed != fits.end()) {
    message += ". A picture of the rig on the axis tells them apart: this stays as it is there, " +
               placed->code + " does not";
  } else {
    message += ". Its files tell them apart: look at the numbers there";
  }
  return RenderCause{"other_intensity", std::move(message), factor};
}

}  // namespace

std::vector<RenderCause> CausesOfFactor(const CheckedRig& rig, double factor) {
  const double seen = std::log(factor);
  std::vector<RenderCause> fits;
  for (RenderCause& cause : KnownFactors(rig)) {
    const double log_factor = std::log(cause.factor);
    if (std::abs(log_factor) > kAsItShould && std::abs(seen - log_factor) < kSameFactor) {
      fits.push_back(std::move(cause));
    }
  }
  std::ranges::stable_sort(
      fits, {}, [&](const RenderCause& cause) { return std::abs(seen - std::log(cause.factor)); });
  if (fits.empty()) {
    fits.push_back({"exposure_unlocked",
                    "tint and contrast are right and no known mistake has this factor: exposure "
                    "is automatic or not the rig's, or another light is on",
                    factor});
  } else if (auto changed = ChangedIntensity(rig, fits, factor)) {
    fits.push_back(*std::move(changed));
  }
  return fits;
}

namespace {

void NameFactor(const CheckedRig& rig, RenderVerdict& verdict) {
  const double seen = verdict.lux / verdict.expected_lx;
  if (std::abs(std::log(seen)) < kAsItShould) {
    verdict.cause = {"none", "as bright as the meter says", 1.0};
    const std::array<SeenRig, 1> alone = {SeenRig{&rig, &verdict}};
    NameLampsNotSeen(alone, verdict.cause);
    return;
  }
  const std::vector<RenderCause> fits = CausesOfFactor(rig, seen);
  verdict.cause = fits.front();
  verdict.alternatives.assign(fits.begin() + 1, fits.end());
}

// u95 of what the cards show, by what the picture leaves open.
void TakeDoubts(const std::array<CardPixels, 2>& cards, RenderVerdict& verdict) {
  std::optional<double> least;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& clipped = cards[i].clipped;
    if (clipped[0] || clipped[1] || clipped[2]) continue;
    Rgb3 by_channel{};
    for (std::size_t c = 0; c < 3; ++c) by_channel[c] = UnsureOfCard(cards[i], c) * cards[i].rgb[c];
    const double all = Rec709Luminance(cards[i].rgb);
    verdict.card_u95[i] = all > 0.0 ? Rec709Luminance(by_channel) / all : 0.0;
    least = std::min(least.value_or(*verdict.card_u95[i]), *verdict.card_u95[i]);
  }
  verdict.lux_u95 = least.value_or(0.0);
}

}  // namespace

Result<RenderVerdict> JudgeRender(const CheckedRig& rig, const std::array<CardPixels, 2>& cards,
                                  PixelUnit unit, const std::string& picture) {
  const auto white = PerfectWhite(rig, cards);
  if (!white) {
    return Refused("all_saturated", picture,
                   "both cards are clipped; lock the rig's exposure, or render to EXR");
  }
  RenderVerdict verdict;
  const double lux_per_pixel = std::numbers::pi / ScaleOf(rig, unit);
  verdict.expected_lx = (rig.cards[0].expected_lx + rig.cards[1].expected_lx) / 2.0;
  verdict.lux = Rec709Luminance(*white) * lux_per_pixel;
  for (std::size_t c = 0; c < 3; ++c) verdict.rgb_lx[c] = (*white)[c] * lux_per_pixel;
  for (std::size_t i = 0; i < 2; ++i) {
    verdict.card_lx[i] = Rec709Luminance(cards[i].rgb) / rig.cards[i].reflectance * lux_per_pixel;
  }
  TakeDoubts(cards, verdict);
  verdict.color = ColorOfCards(rig, cards, *white);
  if (!(verdict.lux > 0.0) || cards[1].raw[1] < 2.0 * cards[1].step[1]) {
    return Refused("too_dark", picture,
                   "the cards are black: " + rig.lamps[rig.lamp].name +
                       " does not shine, or lock the rig's exposure, or render to EXR");
  }
  if (auto curve = CurveIn(rig, cards)) {
    verdict.cause = *std::move(curve);
    verdict.cause.factor = verdict.lux / verdict.expected_lx;
    return verdict;
  }
  if (rig.panorama) {
    const std::array<SeenRig, 1> alone = {SeenRig{&rig, &verdict}};
    const std::vector<RenderCause> causes = JudgeTogether(alone);
    verdict.cause = causes.front();
    verdict.alternatives.assign(causes.begin() + 1, causes.end());
    return verdict;
  }
  if (rig.lamps.size() == 1) {
    const double seen = verdict.lux / verdict.expected_lx;
    if (auto tint = TintIn(rig.lamps.front(), *white, seen)) {
      verdict.color_cause = tint;
      verdict.cause = *std::move(tint);
      return verdict;
    }
    if (cards[0].step[0] > 0.0) {
      verdict.lux = LuminanceInTint(rig, cards, rig.lamps.front().color) * lux_per_pixel;
    }
  }
  NameFactor(rig, verdict);
  if (verdict.color && verdict.color->Off()) {
    verdict.color_cause = TintAmong(rig, verdict);
    if (verdict.cause.code == "none") verdict.cause = *verdict.color_cause;
  }
  return verdict;
}

}  // namespace lightcal
