// SPDX-License-Identifier: Apache-2.0
#include "match/match_source.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <utility>

#include "calibration_options.h"
#include "commands/color_source.h"
#include "input_files.h"
#include "light_input.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/colorimetry/illuminants.h"
#include "lightcal/colorimetry/ssi.h"
#include "lightcal/core/did_you_mean.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal/match/demonstration_gels.h"
#include "lightcal/records/known_cameras.h"
#include "lightcal_devices/files/gel_file.h"
#include "report_html.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

bool IsFolder(const std::string& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

bool IsFile(const std::string& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

// "5600K": digits and a K.
bool IsTemperature(const std::string& text) {
  return text.size() > 1 && (text.back() == 'K' || text.back() == 'k') &&
         std::all_of(text.begin(), text.end() - 1,
                     [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; });
}

Result<MatchLight> SmoothLight(Kelvin temperature, std::string title) {
  auto spectrum = SimilarityReference(temperature);
  if (!spectrum) return Propagate(std::move(spectrum));
  return MatchLight{std::move(title), *std::move(spectrum), false, {}, {}};
}

Result<MatchLight> OneSpectrum(const std::string& source, const std::string& column,
                               Console& console) {
  auto file = ReadSpectrumSource(source);
  if (!file && file.error().code == "not_found" && IlluminantSpectrum(source)) {
    return Failed("not_found", source,
                  "there is no such file; the illuminant is illuminant:" + source);
  }
  if (!file && file.error().code == "not_found" && ParseNumber(source)) {
    return Failed("not_found", source,
                  "there is no such file; the colour temperature is " + source + "K");
  }
  if (!file) return Propagate(std::move(file));
  auto chosen = ChosenSpectra(*file, source, column);
  if (!chosen) return Propagate(std::move(chosen));
  if (chosen->size() > 1) {
    return Refused("several_spectra", source,
                   "holds " + std::to_string(chosen->size()) +
                       " spectra; choose one with --column (the lamp's) or --to-column");
  }
  console.Warn(file->warnings);
  ImportedSpectrum& one = chosen->front();
  if (!CoversVisibleRange(one.spectrum)) {
    const auto& l = one.spectrum.wavelengths_nm;
    console.Warn({"spectrum_truncated", source,
                  "covers " + ShortestText(l.front()) + " to " + ShortestText(l.back()) +
                      " nm only; what it lacks of 380 to 780 nm is taken as dark"});
  }
  MatchLight light;
  light.measured = !NamesIlluminant(source);
  light.title = one.name.empty() ? fs::path(source).stem().string() : one.name;
  light.spectrum = std::move(one.spectrum);
  return light;
}

Result<const FittedLight*> OneLight(const LightFile& file, const MatchLightWords& words) {
  std::vector<std::string> names;
  for (const FittedLight& light : file.lights) {
    if (light.name == words.light || (words.light.empty() && file.lights.size() == 1)) {
      return &light;
    }
    names.push_back(light.name);
  }
  if (words.light.empty()) {
    return Refused("several_lights", words.source,
                   "holds " + Joined(names) + "; choose one with --light");
  }
  return WrongUsage("--light", "there is no light \"" + words.light + "\"" +
                                   DidYouMean(words.light, file.lights));
}

// A spectrum that is not of the colour the lamp was measured to have: another lamp's, or of another
// state.
void WarnOfOtherColor(const FittedLight& light, const std::string& source, const Spectrum& spectrum,
                      Console& console) {
  constexpr double kAlike = 0.02;    // of a CCT
  constexpr double kAlikeUv = 0.01;  // in u'v', where no CCT tells
  const auto xyz = XyzFromSpectrum(spectrum);
  if (!xyz) return;
  const Xy xy = XyFromXyz(*xyz);
  const CctResult own = CctFromXy(xy);
  std::string measured, given;
  if (light.color.cct_K && own.valid()) {
    const double kelvin = light.color.cct_K->value;
    const double off = std::abs(own.temperature.value() - kelvin);
    if (off <= light.color.cct_K->u95 + kAlike * kelvin) return;
    measured = ValueWithAbsolute(kelvin, light.color.cct_K->u95, "K");
    given = RoundedText(own.temperature.value(), 4) + " K";
  } else if (light.color.xy) {
    const auto [u, v] = Uv1976FromXy(xy);
    const auto [lamp_u, lamp_v] = Uv1976FromXy(*light.color.xy);
    if (std::hypot(u - lamp_u, v - lamp_v) <= kAlikeUv) return;
    const auto text = [](const Xy& at) {
      return "x " + RoundedText(at.x, 3) + ", y " + RoundedText(at.y, 3);
    };
    measured = text(*light.color.xy);
    given = text(xy);
  } else {
    return;
  }
  console.Warn({"color_disagrees", source,
                "is of " + given + ", \"" + light.name + "\" was measured at " + measured +
                    ": is it this lamp's, and of this state? The spectrum is believed"});
}

// A light.json knows a colour, not the spectrum it came from.
Result<MatchLight> FromLights(const LightFile& file, const MatchLightWords& words,
                              const std::vector<LightSpectrum>& spectra, Console& console) {
  const auto light = OneLight(file, words);
  if (!light) return tl::unexpected(light.error());
  MatchLight made;
  const auto own = std::ranges::find(spectra, (*light)->name, &LightSpectrum::light);
  const bool by_states = words.by_states && (*light)->states.size() > 1;
  if (words.spectrum.empty() && (by_states || (words.by_color && (*light)->color.xy))) {
    made.measured = true;
  } else if (!words.spectrum.empty()) {
    auto one = OneSpectrum(words.spectrum, words.column, console);
    if (!one) return one;
    made = *std::move(one);
    WarnOfOtherColor(**light, words.spectrum, made.spectrum, console);
  } else if (own != spectra.end()) {
    made.spectrum = own->spectrum;
    // What its lamp gave at one meter's place is no measure of the lamp.
    made.spectrum.quantity = SpectralQuantity::kRelative;
  } else {
    const auto& cct = (*light)->color.cct_K;
    constexpr double kNearLocus = 0.006;
    const double duv = (*light)->color.duv ? (*light)->color.duv->value : 0.0;
    if (!words.may_assume || !cct || std::abs(duv) > kNearLocus) {
      return Refused("no_spectrum", words.source,
                     "\"" + (*light)->name +
                         "\" was measured without a spectrum, and a colour alone does not say what "
                         "a gel makes of a lamp; give its spectrum with --spectrum" +
                         ((*light)->states.size() > 1
                              ? "; without --gels, --camera and --plot its own states are matched"
                              : ""));
    }
    auto smooth = SmoothLight(Kelvin(cct->value), {});
    if (!smooth) return smooth;
    made = *std::move(smooth);
    console.Warn({"spectrum_assumed", words.source,
                  "\"" + (*light)->name + "\" has a colour and no spectrum: " +
                      (cct->value < 4000.0 ? "a black body" : "daylight") + " of " +
                      RoundedText(cct->value, 4) +
                      " K stands for it; what a camera sees of the lamp itself may differ"});
  }
  made.title = (*light)->name;
  made.light = **light;
  made.inputs = file.provenance.inputs;
  for (const InputFile& one : made.inputs) made.session += one.sha256;
  if (made.session.empty()) made.session = words.source;
  return made;
}

}  // namespace

Result<MatchLight> ReadMatchLight(const MatchLightWords& words, Console& console) {
  const std::string& source = words.source;
  if (IsTemperature(source) && !IsFile(source)) {
    const auto temperature = ParseTemperature(source);
    if (!temperature) return tl::unexpected(temperature.error());
    return SmoothLight(*temperature, source);
  }
  if (IsFolder(source) || fs::path(source).extension() == ".toml") {
    auto calibrated = CalibrateAloud(source, {}, console);
    if (!calibrated) return Propagate(std::move(calibrated));
    return FromLights(calibrated->lights, words, SpectraOf(*calibrated), console);
  }
  if (fs::path(source).extension() == ".json") {
    auto lights = LightsIn(source);
    if (!lights) return Propagate(std::move(lights));
    return FromLights(*lights, words, {}, console);
  }
  return OneSpectrum(source, words.column, console);
}

Result<GelSet> ReadGels(const std::string& file, Console& console) {
  if (!file.empty()) {
    NoteInput(file);
    auto set = devices::ReadGelFile(file);
    if (set) console.Warn(set->warnings);
    return set;
  }
  console.Warn({"demonstration_gels", "gels",
                "no gel file is named: these are 22 filters by formula that nobody makes; give "
                "your maker's figures with --gels FILE.csv"});
  return match::DemonstrationGels();
}

Result<GelChoice> ReadGelChoice(const std::string& text, const std::string& file,
                                Console& console) {
  std::string path = file;
  std::string names = text;
  const std::size_t colon = text.find(':');
  if (IsFile(text)) {
    path = text;
    names.clear();
  } else if (colon != std::string::npos && !text.starts_with("demo:")) {
    path = text.substr(0, colon);
    names = text.substr(colon + 1);
  }
  auto set = ReadGels(path, console);
  if (!set) return Propagate(std::move(set));
  GelChoice choice;
  choice.set = *std::move(set);
  if (names.empty()) {
    for (std::size_t i = 0; i < choice.set.gels.size(); ++i) choice.stacks.push_back({i});
    return choice;
  }
  std::vector<std::size_t> stack;
  for (std::size_t from = 0; from <= names.size();) {
    const std::size_t plus = std::min(names.find('+', from), names.size());
    auto gel = FindGel(choice.set, names.substr(from, plus - from));
    if (!gel) return Propagate(std::move(gel));
    stack.push_back(*gel);
    from = plus + 1;
  }
  choice.stacks.push_back(std::move(stack));
  return choice;
}

Result<std::vector<CameraSensitivities>> ReadCameras(const std::string& words) {
  if (words.empty() || words == "observer") return std::vector<CameraSensitivities>{};
  if (words == "all") return KnownCameras();
  std::vector<std::string> files;
  if (IsFile(words)) files.push_back(words);
  if (IsFolder(words)) {
    for (const auto& entry : fs::directory_iterator(words)) {
      if (entry.path().extension() == ".json") files.push_back(entry.path().string());
    }
    std::ranges::sort(files);
    if (files.empty()) {
      return Refused("no_cameras", words, "holds no .json file of a camera's sensitivities");
    }
  }
  std::vector<CameraSensitivities> cameras;
  for (const std::string& file : files) {
    const auto text = ReadInputFile(file);
    if (!text) return tl::unexpected(text.error());
    auto camera = CameraSensitivitiesFromJson(*text, file);
    if (!camera) return Propagate(std::move(camera));
    cameras.push_back(*std::move(camera));
  }
  if (!cameras.empty()) return cameras;
  auto known = KnownCamera(words);
  if (!known) return Propagate(std::move(known));
  return std::vector<CameraSensitivities>{*std::move(known)};
}

}  // namespace lightcal::app
