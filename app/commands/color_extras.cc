// SPDX-License-Identifier: Apache-2.0
#include "color_extras.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include "color_words.h"
#include "lightcal/calibrate/spectral_doubt.h"
#include "lightcal/colorimetry/engine_kelvin.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/preset_table.h"

namespace lightcal::app {
namespace {

Result<double> ParseSigma(const std::string& text) {
  std::string_view digits = TrimBlanks(text);
  const bool percent = digits.ends_with('%');
  if (percent) digits.remove_suffix(1);
  const auto number = ParseNumber(TrimBlanks(digits));
  if (!number) return WrongUsage("--sigma", "\"" + text + "\" is not a share such as 1% or 0.01");
  const double sigma = percent ? *number / 100.0 : *number;
  if (!(sigma > 0.0 && sigma < 1.0)) {
    return WrongUsage("--sigma", "\"" + text + "\" is not a share above 0 and below 100 %");
  }
  return sigma;
}

GamutPolicy PolicyOf(std::string_view word) {
  if (word == "clip") return GamutPolicy::kClip;
  return word == "desaturate" ? GamutPolicy::kDesaturate : GamutPolicy::kKeep;
}

std::string_view WordOf(GamutPolicy policy) {
  switch (policy) {
    case GamutPolicy::kClip:
      return "clip";
    case GamutPolicy::kDesaturate:
      return "desaturate";
    case GamutPolicy::kKeep:
      break;
  }
  return "keep";
}

// The spaces that do not hold the colour.
std::vector<std::string> SpacesWithout(Xy xy, const ColorExtras& extras) {
  ColorExtras untouched = extras;
  untouched.gamut = GamutPolicy::kKeep;
  std::vector<std::string> names;
  for (const NamedSpace& each : kSpaces) {
    if (!IsInGamut(RgbOf(xy, each, untouched))) names.emplace_back(each.key);
  }
  return names;
}

Node SpectralErrorNode(const SpectralError& error) {
  Node node = {{"from_nm", error.first},
               {"to_nm", error.last},
               {"step_nm", error.step},
               {"roughness", error.roughness},
               {"code", error.undersampled ? Node("undersampled") : Node()}};
  if (!error.bound) return node;
  node.Put({{"cct_K", error.bound->temperature},
            {"duv", error.bound->duv},
            {"illuminance_relative", error.bound->illuminance_relative}});
  return node;
}

Node Triple(const Rgb& c) { return {c.r, c.g, c.b}; }

// What programs with a kelvin setting make of the colour; approximations all.
Node EnginesNode(Xy xy) {
  const Uv1960 uv = Uv1960FromXy(xy);
  const CctResult cct = CctFromXy(xy);
  Node node = {{"krystek_setting_K", KrystekKelvinFrom(uv)}};
  for (const PresetTarget* target : ReportTargets()) {
    if (!cct.valid() || !target->kelvin) continue;
    node.Put(target->kelvin->key, Triple(target->kelvin->color(cct.temperature)));
  }
  node.Put("approximation", true);
  return node;
}

std::string Numbers(const Rgb& c) {
  return RoundedText(c.r, 5) + "  " + RoundedText(c.g, 5) + "  " + RoundedText(c.b, 5);
}

void AddNoiseRows(std::vector<ExtraRow>& rows, const CctNoise& noise) {
  if (!noise.too_noisy()) {
    rows.push_back({"u(CCT)", RoundedText(noise.temperature.value(), 3), "K"});
  }
  rows.push_back({"u(Duv)", RoundedText(noise.duv, 3), ""});
}

void AddErrorRows(std::vector<ExtraRow>& rows, const SpectralError& error) {
  if (error.undersampled) {
    rows.push_back({"error of step and range", "unknown: undersampled", ""});
    return;
  }
  if (error.bound->temperature) {
    rows.push_back({"CCT error of step and range, at most",
                    RoundedText(error.bound->temperature->value(), 3), "K"});
    rows.push_back({"Duv error of the same, at most", RoundedText(*error.bound->duv, 3), ""});
  }
  rows.push_back({"illuminance error of the same, at most",
                  RoundedText(100.0 * error.bound->illuminance_relative, 3), "%"});
}

void AddEngineRows(std::vector<ExtraRow>& rows, Xy xy) {
  const CctResult cct = CctFromXy(xy);
  std::vector<std::string_view> krystek;
  std::vector<ExtraRow> colors;
  for (const PresetTarget* target : ReportTargets()) {
    if (!target->kelvin) continue;
    const KelvinSetting& kelvin = *target->kelvin;
    if (!kelvin.krystek.empty()) krystek.push_back(kelvin.krystek);
    if (cct.valid()) {
      colors.push_back({std::string(kelvin.label), Numbers(kelvin.color(cct.temperature)), ""});
    }
  }
  if (const auto setting = KrystekKelvinFrom(Uv1960FromXy(xy))) {
    rows.push_back({"kelvin setting of " + Joined(krystek, " and ") + " (Krystek)",
                    RoundedText(setting->value(), 5), "K"});
  }
  std::ranges::move(colors, std::back_inserter(rows));
}

}  // namespace

void AddColorExtraOptions(CLI::App& parser, ColorExtraOptions& o) {
  parser
      .add_option("--sigma", o.sigma,
                  "Noise of X, Y and Z each, 1 sigma, e.g. 1%: adds u(CCT) and u(Duv)")
      ->type_name("SHARE");
  parser
      .add_option("--white", o.white,
                  "Adapt RGB (Bradford) so that this white becomes the space's: x,y, 3200K or D65")
      ->type_name("WHITE");
  parser.add_option("--gamut", o.gamut, "What RGB does with colours outside its space")
      ->check(CLI::IsMember({"keep", "clip", "desaturate"}))
      ->capture_default_str();
  parser
      .add_option("--sampling", o.sampling,
                  "What a sample of the spectrum is: the mean over its step (band) or one "
                  "wavelength (point); auto: band for instruments' files")
      ->check(CLI::IsMember({"auto", "band", "point"}))
      ->capture_default_str();
  parser.add_flag("--engines", o.engines,
                  "Add what engines make of this temperature (approximations)");
  parser.add_flag("--adobe", o.adobe, "Add temperature and tint as Adobe's raw converters show");
  parser.add_flag("--tlci", o.tlci,
                  "Add the television lighting consistency index, by ArgyllCMS where installed");
  parser.add_option("--plot", o.plot, "Write a chromaticity diagram with the locus and the colour")
      ->type_name("FILE.svg|png");
}

bool AsksForExtras(const ColorExtraOptions& o) {
  return !o.sigma.empty() || !o.white.empty() || o.gamut != "keep" || o.sampling != "auto" ||
         !o.plot.empty() || o.engines || o.adobe || o.tlci;
}

Result<ColorExtras> ParseColorExtras(const ColorExtraOptions& options) {
  ColorExtras extras;
  extras.engines = options.engines;
  extras.adobe = options.adobe;
  extras.gamut = PolicyOf(options.gamut);
  if (options.sampling == "band") extras.sampling = Sampling::kBandAverage;
  if (options.sampling == "point") extras.sampling = Sampling::kPoint;
  if (!options.sigma.empty()) {
    const auto sigma = ParseSigma(options.sigma);
    if (!sigma) return tl::unexpected(sigma.error());
    extras.sigma = *sigma;
  }
  if (!options.white.empty()) {
    const auto white = ParseWhite("--white", options.white);
    if (!white) return tl::unexpected(white.error());
    extras.white = *white;
  }
  return extras;
}

Rgb RgbOf(Xy xy, const NamedSpace& named, const ColorExtras& extras) {
  const RgbSpace space = named.space;
  const Xy as_it_stands = named.of_scene ? kSceneWhite : PrimariesOf(space).white;
  Xyz color = XyzFromXyAtUnitY(xy);
  const Xyz adapted = AdaptedToSpace(color, extras.white.value_or(as_it_stands), space);
  if (adapted.Y > 0.0) color = {adapted.X / adapted.Y, 1.0, adapted.Z / adapted.Y};
  return FitToGamut(LinearRgbFromXyz(color, space), space, extras.gamut);
}

std::optional<CctNoise> NoiseFound(const Xyz& color, const ColorExtras& extras,
                                   const std::string& subject, Warnings& warnings) {
  if (!extras.sigma || !CctFromXy(XyFromXyz(color)).valid()) return std::nullopt;
  auto noise = NoiseOfCct(color, RelativeNoise(color, *extras.sigma));
  if (noise && noise->too_noisy()) {
    warnings.push_back({"too_noisy", subject,
                        "signal to noise is " + RoundedText(noise->snr, 3) +
                            ", below 30: no CCT is given; measure longer or average readings"});
  }
  return noise;
}

std::optional<SpectralError> SpectralErrorFound(const Spectrum& spectrum, const std::string& format,
                                                const ColorExtras& extras,
                                                const std::string& subject, Warnings& warnings) {
  auto error = SpectralErrorOf(spectrum, extras.sampling.value_or(SamplingOfFormat(format)));
  if (!error) return std::nullopt;
  const auto warning =
      WarningOfSampling(spectrum, *error, subject,
                        "say --sampling band if each is the mean over its step, as an instrument's "
                        "is, or give a table of 1 nm");
  if (warning) warnings.push_back(*warning);
  return *std::move(error);
}

Node ColorExtrasNode(Xy xy, const ColorExtras& extras, const ColorFindings& findings) {
  Node node = Node::Table();
  if (const auto& noise = findings.noise) {
    const bool told = !noise->too_noisy();
    node.Put("uncertainty", {{"u_cct_K", told ? Node(noise->temperature) : Node()},
                             {"u_mired", told ? Node(noise->mireds) : Node()},
                             {"u_duv", noise->duv},
                             {"snr", noise->snr}});
  }
  if (findings.spectral_error) {
    node.Put("spectral_error", SpectralErrorNode(*findings.spectral_error));
  }
  if (const auto outside = SpacesWithout(xy, extras); !outside.empty()) {
    node.Put("rgb_gamut", {{"policy", WordOf(extras.gamut)}, {"outside", outside}});
  }
  if (extras.white) node.Put("rgb_white", {extras.white->x, extras.white->y});
  if (extras.engines) node.Put("engines", EnginesNode(xy));
  if (const auto adobe = extras.adobe ? AdobeReadoutFrom(Uv1960FromXy(xy)) : std::nullopt) {
    node.Put("adobe", {{"temperature_K", adobe->temperature}, {"tint", adobe->tint}});
  }
  return node;
}

std::vector<ExtraRow> ColorExtraRows(Xy xy, const ColorExtras& extras,
                                     const ColorFindings& findings) {
  std::vector<ExtraRow> rows;
  if (findings.noise) AddNoiseRows(rows, *findings.noise);
  if (findings.spectral_error) AddErrorRows(rows, *findings.spectral_error);
  std::string outside;
  for (const std::string& name : SpacesWithout(xy, extras)) {
    outside += (outside.empty() ? "" : ", ") + name;
  }
  if (!outside.empty()) {
    rows.push_back({"outside " + outside, std::string(WordOf(extras.gamut)), ""});
  }
  if (extras.engines) AddEngineRows(rows, xy);
  if (const auto adobe = extras.adobe ? AdobeReadoutFrom(Uv1960FromXy(xy)) : std::nullopt) {
    rows.push_back({"Adobe's temperature", RoundedText(adobe->temperature.value(), 5), "K"});
    rows.push_back({"Adobe's tint", RoundedText(adobe->tint, 3), ""});
  }
  return rows;
}

}  // namespace lightcal::app
