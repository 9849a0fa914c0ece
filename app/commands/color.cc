// SPDX-License-Identifier: Apache-2.0
// lightcal color: a chromaticity, a colour temperature, a measured spectrum or a stream of
// chromaticities -> XYZ, xy, uv, CCT, Duv and linear RGB.
#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "color_answer.h"
#include "color_batch.h"
#include "color_extras.h"
#include "color_metrics.h"
#include "color_source.h"
#include "commands.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/daylight.h"
#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal/report/chromaticity_plot.h"
#include "lightcal/report/color_vector_graphic.h"
#include "lightcal_devices/files/import_file.h"
#include "match/behind_gels.h"
#include "output_files.h"
#include "picture_file.h"

namespace lightcal::app {
namespace {

struct ColorOptions {
  std::vector<std::string> xy, xyz;
  std::string cct, duv, locus = "planck";
  std::string spectrum, column, vector_graphic;
  bool force = false;
  std::string batch;
  std::string through, gels;
  ColorExtraOptions extra;
};

Result<ColorAnswer> AnswerFor(Xy xy, const std::string& subject, const ColorExtras& extras) {
  ColorAnswer answer;
  answer.extras = extras;
  answer.xy = xy;
  answer.cct = CctFromXy(xy);
  if (answer.cct.status == CctStatus::kNotAChromaticity) return NotAChromaticity(subject);
  return answer;
}

// ---- Typed colours ----

Result<double> TypedNumber(const std::string& text, const std::string& option) {
  if (const auto number = ParseNumber(text)) return *number;
  const std::string word = LowerAscii(TrimBlanks(text));
  if (word.find("nan") != std::string::npos || word.find("inf") != std::string::npos) {
    return Refused("bad_number", option, "\"" + text + "\" is not a finite number");
  }
  return WrongUsage(option, "\"" + text + "\" is not a number");
}

Result<Xyz> TypedXyz(const ColorOptions& options) {
  std::array<double, 3> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto number = TypedNumber(options.xyz[i], "--xyz");
    if (!number) return tl::unexpected(number.error());
    values[i] = *number;
  }
  const auto [x, y, z] = values;
  if (!(y > 0.0 && x + y + z > 0.0 && std::isfinite(x + y + z))) {
    return Refused("bad_chromaticity", "--xyz",
                   "no light has Y at or below 0; check the dark level");
  }
  return Xyz{x, y, z};
}

Result<Xy> TypedXy(const ColorOptions& options) {
  const auto x = TypedNumber(options.xy[0], "--xy");
  if (!x) return tl::unexpected(x.error());
  const auto y = TypedNumber(options.xy[1], "--xy");
  if (!y) return tl::unexpected(y.error());
  if (std::abs(*x) > 1.5 || std::abs(*y) > 1.5) {
    return Refused("bad_chromaticity", "--xy",
                   "x and y are parts of one, such as 0.4476 0.4074; " + options.xy[0] + " " +
                       options.xy[1] + " is not (per cent?)");
  }
  return Xy{*x, *y};
}

Result<Kelvin> TypedTemperature(const std::string& text) {
  auto temperature = ParseTemperature(text);
  if (!temperature) {
    if (auto plain = TypedNumber(text, "--cct"); !plain && plain.error().code == "bad_number") {
      return Propagate(std::move(plain));
    }
    return Propagate(std::move(temperature));
  }
  if (!(temperature->value() > 0.0)) {
    return Refused("out_of_range", "--cct", "a temperature must be above 0 K");
  }
  return temperature;
}

Result<Xy> XyOfTemperature(const ColorOptions& options) {
  auto temperature = TypedTemperature(options.cct);
  if (!temperature) return Propagate(std::move(temperature));
  if (options.locus == "daylight") {
    if (!options.duv.empty()) {
      return WrongUsage("--duv",
                        "is measured from the Planckian locus; leave out --locus daylight");
    }
    return DaylightXy(*temperature);
  }
  double duv = 0.0;
  if (!options.duv.empty()) {
    const auto typed = TypedNumber(options.duv, "--duv");
    if (!typed) return tl::unexpected(typed.error());
    duv = *typed;
  }
  const Xy xy = XyFromCct(*temperature, duv);
  if (!(xy.x >= 0.0 && xy.y > 0.0 && xy.x + xy.y <= 1.0)) {
    return Refused("bad_chromaticity", "--duv",
                   "no light lies so far from the locus; Duv is a few thousandths, such as 0.006");
  }
  return xy;
}

struct TypedColor {
  Xy xy;
  Xyz xyz;  // at Y = 1 where only a chromaticity was typed
};

Result<TypedColor> ColorTyped(const ColorOptions& options) {
  if (!options.xyz.empty()) {
    auto xyz = TypedXyz(options);
    if (!xyz) return Propagate(std::move(xyz));
    return TypedColor{XyFromXyz(*xyz), *xyz};
  }
  auto xy = options.xy.empty() ? XyOfTemperature(options) : TypedXy(options);
  if (!xy) return Propagate(std::move(xy));
  // Without y it has no XYZ, and AnswerFor refuses it.
  return TypedColor{*xy, xy->y == 0.0 ? Xyz{} : XyzFromXyAtUnitY(*xy)};
}

std::string PlotOf(const ColorAnswer& answer) {
  FittedColor color;
  color.xy = answer.xy;
  if (const auto& noise = answer.findings.noise; noise && answer.has_cct()) {
    color.cct_K = UncertainFromNormal(answer.cct.temperature.value(), noise->temperature.value());
    color.duv = UncertainFromNormal(answer.cct.duv, noise->duv);
  }
  return report::ChromaticityPlot(color);
}

Result<void> RunTyped(const ColorOptions& options, const ColorExtras& extras, Console& console) {
  auto color = ColorTyped(options);
  if (!color) return Propagate(std::move(color));
  const std::string subject = !options.xyz.empty() ? "--xyz"
                              : options.xy.empty() ? "--cct"
                                                   : "--xy";
  auto answer = AnswerFor(color->xy, subject, extras);
  if (!answer) return Propagate(std::move(answer));
  if (!options.xyz.empty()) answer->xyz = color->xyz;
  Warnings warnings;
  answer->findings.noise = NoiseFound(color->xyz, extras, subject, warnings);
  console.Warn(warnings);
  if (auto allowed = console.RefuseIfStrict(); !allowed) return allowed;
  if (!options.extra.plot.empty()) {
    auto picture = PictureFile(options.extra.plot, PlotOf(*answer));
    if (!picture) return Propagate(std::move(picture));
    if (auto written = WriteOutputs({*picture}, options.force); !written) return written;
  }
  console.Print(TableOfOne(*answer));
  console.PrintDocument(ToJson(*answer));
  return {};
}

// ---- Spectra ----

Result<ColorAnswer> AnswerFor(const ImportedSpectrum& imported, const std::string& subject,
                              const ColorExtras& extras) {
  const auto xyz = XyzFromSpectrum(imported.spectrum);
  if (!xyz) return Refused(xyz.error().code, subject, xyz.error().message);
  auto answer = AnswerFor(XyFromXyz(*xyz), subject, extras);
  if (!answer) return answer;
  answer->name = imported.name;
  answer->xyz = *xyz;
  if (imported.spectrum.quantity == SpectralQuantity::kIrradiance) {
    answer->illuminance = Lux(xyz->Y);
  }
  if (const auto efficacy = EfficacyOfRadiation(imported.spectrum)) answer->efficacy = *efficacy;
  if (const auto der = MelanopicDaylightEfficacyRatio(imported.spectrum))
    answer->melanopic_der = *der;
  answer->reported = imported.reported;
  return answer;
}

void WarnIfTruncated(const Spectrum& spectrum, const std::string& subject, Console& console) {
  if (CoversVisibleRange(spectrum)) return;
  const auto& l = spectrum.wavelengths_nm;
  console.Warn(
      {"spectrum_truncated", subject,
       "covers " + ShortestText(l.front()) + " to " + ShortestText(l.back()) +
           " nm only; CIE asks for 380 to 780 nm, so colour and illuminance lack the rest"});
}

// The pictures asked for, of the one spectrum they are drawn of.
Result<std::vector<OutputFile>> PicturesOf(const ColorOptions& options,
                                           const std::vector<ColorAnswer>& answers) {
  std::vector<OutputFile> pictures;
  const auto check_one = [&](const std::string& option) -> Result<void> {
    if (answers.size() == 1) return {};
    return WrongUsage(option, "is drawn of one spectrum; choose it with --column");
  };
  if (!options.vector_graphic.empty()) {
    if (auto one = check_one("--vector-graphic"); !one) return Propagate(std::move(one));
    const ColorAnswer& answer = answers.front();
    const auto& rendering = answer.metrics.rendering;
    if (!rendering) {
      return Refused(
          "no_color_rendering", options.spectrum,
          "has no colour rendering to draw: the spectrum is too narrow or too coarse, or "
          "its colour has no temperature");
    }
    const std::string& title = answer.name.empty() ? options.spectrum : answer.name;
    auto picture =
        PictureFile(options.vector_graphic,
                    report::ColorVectorGraphic(rendering->fidelity, rendering->gamut, title));
    if (!picture) return Propagate(std::move(picture));
    pictures.push_back(*std::move(picture));
  }
  if (!options.extra.plot.empty()) {
    if (auto one = check_one("--plot"); !one) return Propagate(std::move(one));
    auto picture = PictureFile(options.extra.plot, PlotOf(answers.front()));
    if (!picture) return Propagate(std::move(picture));
    pictures.push_back(*std::move(picture));
  }
  return pictures;
}

// The one spectrum chosen, behind each stack of gels asked for.
Result<std::vector<BehindGels>> GelsAsked(const ColorOptions& options,
                                          std::vector<ImportedSpectrum>& chosen, Console& console) {
  if (chosen.size() > 1) {
    return WrongUsage("--through", "goes with one spectrum; choose it with --column");
  }
  const bool measured = !NamesIlluminant(options.spectrum);
  auto behind =
      PutBehindGels(chosen.front().spectrum, measured, options.through, options.gels, console);
  if (!behind) return behind;
  std::vector<ImportedSpectrum> gelled;
  for (const BehindGels& one : *behind) {
    gelled.push_back({one.title, one.spectrum, {}, chosen.front().where});
  }
  chosen = std::move(gelled);
  return behind;
}

Result<void> RunSpectrum(const ColorOptions& options, const ColorExtras& extras, Console& console) {
  auto file = ReadSpectrumSource(options.spectrum);
  if (!file) return Propagate(std::move(file));
  auto chosen = ChosenSpectra(*file, options.spectrum, options.column);
  if (!chosen) return Propagate(std::move(chosen));
  console.Warn(file->warnings);
  std::vector<BehindGels> behind;
  if (!options.through.empty()) {
    auto gels = GelsAsked(options, *chosen, console);
    if (!gels) return Propagate(std::move(gels));
    behind = *std::move(gels);
  }
  std::vector<ColorAnswer> answers;
  std::vector<Node> spectra;
  for (std::size_t i = 0; i < chosen->size(); ++i) {
    const ImportedSpectrum& imported = (*chosen)[i];
    const std::string subject =
        imported.name.empty() ? options.spectrum : options.spectrum + ": " + imported.name;
    auto answer = AnswerFor(imported, subject, extras);
    if (!answer && chosen->size() == 1) return Propagate(std::move(answer));
    if (!answer) {  // one dark column among many
      const Error& e = answer.error();
      console.Warn({e.code, e.subject, e.message});
      spectra.push_back({{"name", imported.name}, {"refused", e.code}});
      continue;
    }
    WarnIfTruncated(imported.spectrum, subject, console);
    if (NamesIlluminant(options.spectrum)) answer->reported.reset();
    if (options.extra.tlci) {
      auto tlci = TlciByArgyll(imported.spectrum);
      if (!tlci) return Propagate(std::move(tlci));
      answer->tlci = *std::move(tlci);
    }
    Warnings warnings;
    answer->metrics = ColorMetricsOf(imported.spectrum, subject, warnings);
    answer->findings = {
        NoiseFound(*answer->xyz, extras, subject, warnings),
        SpectralErrorFound(imported.spectrum, file->format, extras, subject, warnings)};
    console.Warn(warnings);
    spectra.push_back(ToJson(*answer));
    if (!behind.empty()) spectra.back().Put("through", ThroughNode(behind[i]));
    answers.push_back(std::move(*answer));
  }
  if (auto allowed = console.RefuseIfStrict(); !allowed) return allowed;
  const auto pictures = PicturesOf(options, answers);
  if (!pictures) return tl::unexpected(pictures.error());
  if (auto written = WriteOutputs(*pictures, options.force); !written) return written;
  if (chosen->size() == 1) {
    if (!behind.empty()) console.Print(ThroughText(behind.front()) + "\n\n");
    console.Print(TableOfOne(answers.front()));
    console.PrintDocument(spectra.front());
  } else {
    console.Print(TableOfMany(answers));
    console.PrintDocument({{"spectra", spectra}});
  }
  return {};
}

Result<void> CheckColor(const ColorOptions& o) {
  const int questions = static_cast<int>(!o.xy.empty()) + static_cast<int>(!o.xyz.empty()) +
                        static_cast<int>(!o.cct.empty()) + static_cast<int>(!o.spectrum.empty()) +
                        static_cast<int>(!o.batch.empty());
  if (questions != 1) {
    return WrongUsage(
        "color", "give one of --xy X Y, --xyz X Y Z, --cct K, --spectrum FILE, --batch FILE.csv");
  }
  if (o.cct.empty() && (!o.duv.empty() || o.locus != "planck")) {
    return WrongUsage("color", "--duv and --locus go with --cct");
  }
  if (o.spectrum.empty() && !(o.column.empty() && o.vector_graphic.empty())) {
    return WrongUsage("color", "--column and --vector-graphic go with --spectrum");
  }
  if (o.spectrum.empty() && !(o.through.empty() && o.gels.empty())) {
    return WrongUsage("color", "--through and --gels go with --spectrum");
  }
  if (o.force && o.vector_graphic.empty() && o.extra.plot.empty()) {
    return WrongUsage("--force", "goes with --plot and --vector-graphic");
  }
  const std::array<std::pair<const char*, const std::string*>, 2> pictures = {
      {{"--plot", &o.extra.plot}, {"--vector-graphic", &o.vector_graphic}}};
  for (const auto& [option, path] : pictures) {
    if (path->empty()) continue;
    if (auto named = CheckPictureName(option, *path); !named) return named;
  }
  if (!o.batch.empty() && AsksForExtras(o.extra)) {
    return WrongUsage("--batch", "gives CCT and Duv only; ask for the rest one colour at a time");
  }
  if (o.spectrum.empty() && o.extra.sampling != "auto") {
    return WrongUsage("--sampling", "goes with --spectrum");
  }
  if (o.spectrum.empty() && o.extra.tlci) return WrongUsage("--tlci", "goes with --spectrum");
  return {};
}

}  // namespace

Run BuildColor(CLI::App& parser) {
  auto o = std::make_shared<ColorOptions>();
  parser.add_option("--xy", o->xy, "CIE 1931 chromaticity")->expected(2)->type_name("X Y");
  parser.add_option("--xyz", o->xyz, "Tristimulus values")->expected(3)->type_name("X Y Z");
  parser.add_option("--cct", o->cct, "Colour temperature, e.g. 3200K")->type_name("K");
  parser.add_option("--duv", o->duv, "Distance from the Planckian locus, positive is greenish")
      ->type_name("D");
  parser.add_option("--locus", o->locus, "Where --cct lies")
      ->check(CLI::IsMember({"planck", "daylight"}))
      ->capture_default_str();
  parser
      .add_option("--spectrum", o->spectrum,
                  "A spectrometer's export, or illuminant:FL11, led:4000, gaussian:530:30")
      ->type_name("FILE");
  parser
      .add_option("--column", o->column,
                  "Which spectrum of the file: its name, or its number from 1")
      ->type_name("NAME|N");
  parser
      .add_option("--through", o->through,
                  "Put the lamp behind gels: gels.csv:L204, gels.csv:L204+L298, \"half cto\" of "
                  "--gels; gels.csv alone lists each of its gels")
      ->type_name("FILE:GEL");
  parser
      .add_option("--gels", o->gels,
                  "The gels that --through names [demonstration filters by formula]")
      ->type_name("FILE.csv");
  parser
      .add_option("--vector-graphic", o->vector_graphic,
                  "Write the TM-30 colour vector graphic of the spectrum")
      ->type_name("FILE.svg|png");
  parser.add_flag("--force", o->force, "Replace a file that lightcal did not write");
  parser.add_option("--batch", o->batch, "Lines of x,y; - reads standard input")
      ->type_name("FILE.csv");
  AddColorExtraOptions(parser, o->extra);
  return [o](Console& console) -> Result<void> {
    if (auto checked = CheckColor(*o); !checked) return checked;
    if (!o->batch.empty()) return RunColorBatch(o->batch, console);
    const auto extras = ParseColorExtras(o->extra);
    if (!extras) return tl::unexpected(extras.error());
    return o->spectrum.empty() ? RunTyped(*o, *extras, console) : RunSpectrum(*o, *extras, console);
  };
}

}  // namespace lightcal::app
