// SPDX-License-Identifier: Apache-2.0
// lightcal color: a chromaticity, a colour temperature, a measured spectrum or a stream of
// chromaticities -> XYZ, xy, uv, CCT, Duv and linear RGB.
#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "color_batch.h"
#include "color_metrics.h"
#include "color_source.h"
#include "commands.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/daylight.h"
#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal/report/color_vector_graphic.h"
#include "lightcal_devices/files/import_file.h"
#include "output_files.h"

namespace lightcal::app {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::vector<std::string> xy;
  std::string cct, duv, locus = "planck";
  std::string spectrum, column, vector_graphic;
  bool force = false;
  std::string batch;
};

// Everything said about one colour.
struct ColorAnswer {
  Xy xy;
  CctResult cct;
  std::string name;                // of a spectrum
  std::optional<Xyz> xyz;          // of a spectrum: Y in lx for an irradiance, else 100
  std::optional<Lux> illuminance;  // of an irradiance
  std::optional<LumensPerWatt> efficacy;
  std::optional<ReportedColor> reported;
  ColorMetrics metrics;  // of a spectrum
};

struct NamedSpace {
  std::string_view key, title;
  RgbSpace space;
};
constexpr std::array kSpaces = {
    NamedSpace{"srgb_linear", "linear sRGB at Y = 1", RgbSpace::kSrgb},
    NamedSpace{"acescg", "ACEScg at Y = 1", RgbSpace::kAcescg},
    NamedSpace{"rec2020", "linear Rec. 2020 at Y = 1", RgbSpace::kRec2020},
    NamedSpace{"display_p3", "linear Display P3 at Y = 1", RgbSpace::kDisplayP3},
};

std::string_view StatusWord(CctStatus status) {
  switch (status) {
    case CctStatus::kOk:
      return "ok";
    case CctStatus::kFarFromLocus:
      return "far_from_locus";
    case CctStatus::kBelowRange:
      return "below_1000_K";
    case CctStatus::kBeyondInfinity:
      return "beyond_infinity";
    case CctStatus::kNotAChromaticity:
      break;
  }
  return "not_a_chromaticity";
}

std::string_view WhyNoCct(CctStatus status) {
  switch (status) {
    case CctStatus::kFarFromLocus:
      return "none: |Duv| is above 0.05";
    case CctStatus::kBelowRange:
      return "none: colder than 1000 K";
    default:
      return "none: bluer than an infinitely hot body";
  }
}

Result<ColorAnswer> AnswerFor(Xy xy, const std::string& subject) {
  ColorAnswer answer;
  answer.xy = xy;
  answer.cct = CctFromXy(xy);
  if (answer.cct.status == CctStatus::kNotAChromaticity) return NotAChromaticity(subject);
  return answer;
}

// ---- JSON ----

Json Pair(double a, double b) { return Json::array({a, b}); }
Json Triple(double a, double b, double c) { return Json::array({a, b, c}); }

Json RgbJson(Xy xy) {
  Json rgb;
  for (const NamedSpace& space : kSpaces) {
    const Rgb c = LinearRgbFromXyz(XyzFromXyAtUnitY(xy), space.space);
    rgb[std::string(space.key)] = Triple(c.r, c.g, c.b);
  }
  return rgb;
}

Json ReportedJson(const ReportedColor& reported) {
  Json json = Json::object();
  if (reported.illuminance_lx) json["illuminance_lx"] = *reported.illuminance_lx;
  if (reported.cct_K) json["cct_K"] = *reported.cct_K;
  if (reported.duv) json["duv"] = *reported.duv;
  if (reported.xy) json["xy"] = Pair(reported.xy->x, reported.xy->y);
  if (reported.xyz) json["XYZ"] = Triple(reported.xyz->X, reported.xyz->Y, reported.xyz->Z);
  AddReportedMetrics(json, reported);
  return json;
}

Json ToJson(const ColorAnswer& answer) {
  const Uv1960 uv = Uv1960FromXy(answer.xy);
  const Uv1976 uv76 = Uv1976FromXy(answer.xy);
  Json json;
  if (!answer.name.empty()) json["name"] = answer.name;
  json["xy"] = Pair(answer.xy.x, answer.xy.y);
  json["uv1960"] = Pair(uv.u, uv.v);
  json["uv1976"] = Pair(uv76.u, uv76.v);
  if (answer.cct.valid()) json["cct_K"] = answer.cct.temperature.value();
  json["duv"] = answer.cct.duv;
  json["cct_valid"] = answer.cct.valid();
  json["cct_status"] = StatusWord(answer.cct.status);
  json["rgb"] = RgbJson(answer.xy);
  if (answer.xyz) json["XYZ"] = Triple(answer.xyz->X, answer.xyz->Y, answer.xyz->Z);
  if (answer.illuminance) json["illuminance_lx"] = answer.illuminance->value();
  if (answer.efficacy) json["ler_lm_per_W"] = answer.efficacy->value();
  AddMetrics(json, answer.metrics);
  if (answer.reported) json["reported"] = ReportedJson(*answer.reported);
  return json;
}

// ---- Tables ----

// A fixed number of decimals; what rounds to zero has no sign.
std::string Fixed(double value, int decimals) {
  if (std::abs(value) < 0.5 * std::pow(10.0, -decimals)) value = 0.0;
  std::array<char, 400> text{};  // the largest double has 309 digits before its point
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::fixed, decimals);
  return {text.data(), end.ptr};
}
std::string CctText(const CctResult& cct) {
  return cct.valid() ? Fixed(cct.temperature.value(), 1) : std::string(WhyNoCct(cct.status));
}
std::string Claimed(const std::optional<double>& value) {
  return value ? ShortestText(*value) : std::string();
}

std::string TableOfOne(const ColorAnswer& answer) {
  const bool reports = answer.reported.has_value();
  const ReportedColor reported = answer.reported.value_or(ReportedColor{});
  std::vector<std::vector<std::string>> rows;
  const auto row = [&](std::string what, std::string value, std::string unit,
                       std::string claim = "") {
    rows.push_back({std::move(what), std::move(value), std::move(unit)});
    if (reports) rows.back().push_back(std::move(claim));
  };
  const auto coordinates = [](double a, double b) { return Fixed(a, 6) + "  " + Fixed(b, 6); };
  if (answer.illuminance) {
    row("illuminance", RoundedText(answer.illuminance->value(), 6), "lx",
        Claimed(reported.illuminance_lx));
  }
  row("CCT", CctText(answer.cct), answer.cct.valid() ? "K" : "", Claimed(reported.cct_K));
  row("Duv", Fixed(answer.cct.duv, 6), "", Claimed(reported.duv));
  row("x  y", coordinates(answer.xy.x, answer.xy.y), "",
      reported.xy ? coordinates(reported.xy->x, reported.xy->y) : "");
  const Uv1960 uv = Uv1960FromXy(answer.xy);
  const Uv1976 uv76 = Uv1976FromXy(answer.xy);
  row("u  v", coordinates(uv.u, uv.v), "");
  row("u' v'", coordinates(uv76.u, uv76.v), "");
  for (const NamedSpace& space : kSpaces) {
    const Rgb c = LinearRgbFromXyz(XyzFromXyAtUnitY(answer.xy), space.space);
    row(std::string(space.title), Fixed(c.r, 5) + "  " + Fixed(c.g, 5) + "  " + Fixed(c.b, 5), "");
  }
  if (answer.efficacy) {
    row("efficacy of radiation", Fixed(answer.efficacy->value(), 1), "lm/W");
  }
  for (const MetricRow& metric : MetricRows(answer.metrics, reported)) {
    row(metric.what, metric.value, "", metric.claim);
  }
  std::vector<std::string> header = {"quantity", "value", "unit"};
  if (reports) header.emplace_back("file says");
  return TextTable(header, rows);
}

std::string TableOfMany(const std::vector<ColorAnswer>& answers) {
  std::vector<std::vector<std::string>> rows;
  rows.reserve(answers.size());
  for (const ColorAnswer& a : answers) {
    rows.push_back({a.name, a.illuminance ? RoundedText(a.illuminance->value(), 5) : "",
                    CctText(a.cct), Fixed(a.cct.duv, 5), Fixed(a.xy.x, 5), Fixed(a.xy.y, 5)});
  }
  return TextTable({"spectrum", "lx", "CCT in K", "Duv", "x", "y"}, rows);
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

Result<Xy> TypedXy(const Options& options) {
  const auto x = TypedNumber(options.xy[0], "--xy");
  if (!x) return tl::unexpected(x.error());
  const auto y = TypedNumber(options.xy[1], "--xy");
  if (!y) return tl::unexpected(y.error());
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

Result<Xy> XyOfTemperature(const Options& options) {
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
  return XyFromCct(*temperature, duv);
}

Result<void> RunTyped(const Options& options, Console& console) {
  auto xy = options.xy.empty() ? XyOfTemperature(options) : TypedXy(options);
  if (!xy) return Propagate(std::move(xy));
  auto answer = AnswerFor(*xy, options.xy.empty() ? "--cct" : "--xy");
  if (!answer) return Propagate(std::move(answer));
  console.Print(TableOfOne(*answer));
  console.PrintJson(ToJson(*answer));
  return {};
}

// ---- Spectra ----

Result<ColorAnswer> AnswerFor(const ImportedSpectrum& imported, const std::string& subject) {
  const auto xyz = XyzFromSpectrum(imported.spectrum);
  if (!xyz) return Refused(xyz.error().code, subject, xyz.error().message);
  auto answer = AnswerFor(XyFromXyz(*xyz), subject);
  if (!answer) return answer;
  answer->name = imported.name;
  answer->xyz = *xyz;
  if (imported.spectrum.quantity == SpectralQuantity::kIrradiance) {
    answer->illuminance = Lux(xyz->Y);
  }
  if (const auto efficacy = EfficacyOfRadiation(imported.spectrum)) answer->efficacy = *efficacy;
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

Result<void> WriteVectorGraphic(const Options& options, const std::vector<ColorAnswer>& answers) {
  if (answers.size() != 1) {
    return WrongUsage("--vector-graphic", "is drawn of one spectrum; choose it with --column");
  }
  const auto& rendering = answers.front().metrics.rendering;
  if (!rendering) {
    return Refused("no_color_rendering", options.spectrum,
                   "has no colour rendering to draw: the spectrum is too narrow or too coarse, or "
                   "its colour has no temperature");
  }
  const std::string title = answers.front().name.empty() ? options.spectrum : answers.front().name;
  return WriteOutputs({{options.vector_graphic,
                        report::ColorVectorGraphic(rendering->fidelity, rendering->gamut, title)}},
                      options.force);
}

Result<void> RunSpectrum(const Options& options, Console& console) {
  auto file = ReadSpectrumSource(options.spectrum);
  if (!file) return Propagate(std::move(file));
  const auto chosen = ChosenSpectra(*file, options.spectrum, options.column);
  if (!chosen) return tl::unexpected(chosen.error());
  console.Warn(
      WarningsOfChosen(file->warnings, options.column.empty() ? "" : chosen->front().name));
  std::vector<ColorAnswer> answers;
  Json spectra = Json::array();
  for (const ImportedSpectrum& imported : *chosen) {
    const std::string subject =
        imported.name.empty() ? options.spectrum : options.spectrum + ": " + imported.name;
    auto answer = AnswerFor(imported, subject);
    if (!answer && chosen->size() == 1) return Propagate(std::move(answer));
    if (!answer) {  // one dark column among many
      const Error& e = answer.error();
      console.Warn({e.code, e.subject, e.message});
      spectra.push_back({{"name", imported.name}, {"refused", e.code}});
      continue;
    }
    WarnIfTruncated(imported.spectrum, subject, console);
    if (NamesIlluminant(options.spectrum)) answer->reported.reset();
    Warnings warnings;
    answer->metrics = ColorMetricsOf(imported.spectrum, subject, warnings);
    console.Warn(warnings);
    spectra.push_back(ToJson(*answer));
    answers.push_back(std::move(*answer));
  }
  if (auto allowed = console.RefuseIfStrict(); !allowed) return allowed;
  if (!options.vector_graphic.empty()) {
    if (auto written = WriteVectorGraphic(options, answers); !written) return written;
  }
  if (chosen->size() == 1) {
    console.Print(TableOfOne(answers.front()));
    console.PrintJson(spectra.front());
  } else {
    console.Print(TableOfMany(answers));
    console.PrintJson({{"spectra", std::move(spectra)}});
  }
  return {};
}

Result<void> CheckOptions(const Options& o) {
  const int questions = static_cast<int>(!o.xy.empty()) + static_cast<int>(!o.cct.empty()) +
                        static_cast<int>(!o.spectrum.empty()) + static_cast<int>(!o.batch.empty());
  if (questions != 1) {
    return WrongUsage("color", "give one of --xy X Y, --cct K, --spectrum FILE, --batch FILE.csv");
  }
  if (o.cct.empty() && (!o.duv.empty() || o.locus != "planck")) {
    return WrongUsage("color", "--duv and --locus go with --cct");
  }
  if (o.spectrum.empty() && !(o.column.empty() && o.vector_graphic.empty() && !o.force)) {
    return WrongUsage("color", "--column, --vector-graphic and --force go with --spectrum");
  }
  return {};
}

}  // namespace

Run BuildColor(CLI::App& parser) {
  auto o = std::make_shared<Options>();
  parser.add_option("--xy", o->xy, "CIE 1931 chromaticity")->expected(2)->type_name("X Y");
  parser.add_option("--cct", o->cct, "Colour temperature, e.g. 3200K")->type_name("K");
  parser.add_option("--duv", o->duv, "Distance from the Planckian locus, positive is greenish")
      ->type_name("D");
  parser.add_option("--locus", o->locus, "Where --cct lies")
      ->check(CLI::IsMember({"planck", "daylight"}))
      ->capture_default_str();
  parser
      .add_option("--spectrum", o->spectrum,
                  "A spectrometer's export, or illuminant:FL11 and the like")
      ->type_name("FILE");
  parser
      .add_option("--column", o->column,
                  "Which spectrum of the file: its name, or its number from 1")
      ->type_name("NAME|N");
  parser
      .add_option("--vector-graphic", o->vector_graphic,
                  "Write the TM-30 colour vector graphic of the spectrum")
      ->type_name("FILE.svg");
  parser.add_flag("--force", o->force, "Replace a file that lightcal did not write");
  parser.add_option("--batch", o->batch, "Lines of x,y; - reads standard input")
      ->type_name("FILE.csv");
  return [o](Console& console) -> Result<void> {
    if (auto checked = CheckOptions(*o); !checked) return checked;
    if (!o->batch.empty()) return RunColorBatch(o->batch, console);
    return o->spectrum.empty() ? RunTyped(*o, console) : RunSpectrum(*o, console);
  };
}

}  // namespace lightcal::app
