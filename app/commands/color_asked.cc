// SPDX-License-Identifier: Apache-2.0
#include "color_asked.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include "color_batch.h"
#include "color_metrics.h"
#include "color_source.h"
#include "lightcal/calibrate/spectral_doubt.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/daylight.h"
#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal_devices/files/import_file.h"
#include "typed_reading.h"

namespace lightcal::app {
namespace {

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
  if (!(x >= 0.0 && y > 0.0 && z >= 0.0)) {
    return Refused("bad_chromaticity", "--xyz",
                   "no light has a value below 0, nor Y at 0; check the dark level");
  }
  if (!std::isfinite(x + y + z)) {
    return Refused("out_of_range", "--xyz",
                   "the three add up to more than a number holds; divide them all by one");
  }
  return Xyz{x, y, z};
}

Result<Xy> TypedXy(const ColorOptions& options) {
  const auto x = TypedNumber(options.xy[0], "--xy");
  if (!x) return tl::unexpected(x.error());
  const auto y = TypedNumber(options.xy[1], "--xy");
  if (!y) return tl::unexpected(y.error());
  const Xy xy{*x, *y};
  if (IsPhysicalXy(xy)) return xy;
  return Refused("bad_chromaticity", "--xy",
                 "x and y are parts of one, such as 0.4476 0.4074: x >= 0, y > 0, x + y <= 1; " +
                     options.xy[0] + " " + options.xy[1] + " is not" +
                     (std::abs(*x) > 1.5 || std::abs(*y) > 1.5 ? " (per cent?)" : ""));
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
  if (!IsPhysicalXy(xy)) {
    return Refused("bad_chromaticity", "--duv",
                   "no light lies so far from the locus; Duv is a few thousandths, such as 0.006");
  }
  return xy;
}

// Numbers that are far from any white as x, y, and near the locus as u', v': a hint, no more.
std::string HintOfUv(Xy xy) {
  constexpr double kFarDuv = 0.06;   // saturated as x, y
  constexpr double kNearDuv = 0.01;  // as white as lamps are
  constexpr double kLeast_K = 1800.0, kMost_K = 15000.0;
  const CctResult as_typed = CctFromXy(xy);
  if (as_typed.valid() || std::abs(as_typed.duv) < kFarDuv) return {};
  const Xy other = XyFromUv1960({xy.x, xy.y / 1.5});
  if (!IsPhysicalXy(other)) return {};
  const CctResult as_uv = CctFromXy(other);
  const double kelvin = as_uv.temperature.value();
  if (!as_uv.valid() || std::abs(as_uv.duv) > kNearDuv || kelvin < kLeast_K || kelvin > kMost_K) {
    return {};
  }
  return "note: as x, y this is a saturated colour; as u', v' these numbers are a white of " +
         RoundedText(kelvin, 3) + " K: if that is what they are, type --xy " +
         RoundedText(other.x, 4) + "," + RoundedText(other.y, 4);
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

Result<AnsweredColors> AnswerTyped(const ColorOptions& options, const ColorExtras& extras,
                                   Console& console) {
  auto color = ColorTyped(options);
  if (!color) return Propagate(std::move(color));
  const std::string subject = !options.xyz.empty() ? "--xyz"
                              : options.xy.empty() ? "--cct"
                                                   : "--xy";
  auto answer = AnswerFor(color->xy, subject, extras);
  if (!answer) return Propagate(std::move(answer));
  if (!options.xyz.empty()) answer->xyz = color->xyz;
  Warnings warnings;
  if (!options.xy.empty()) {
    if (const std::string hint = HintOfUv(color->xy); !hint.empty()) console.Note(hint);
  }
  answer->findings.noise = NoiseFound(color->xyz, extras, subject, warnings);
  console.Warn(warnings);
  AnsweredColors answered;
  answered.documents.push_back(ToJson(*answer));
  answered.colors.push_back(*std::move(answer));
  return answered;
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

Result<AnsweredColors> AnswerSpectra(const ColorOptions& options, const ColorExtras& extras,
                                     Console& console) {
  auto file = ReadSpectrumSource(options.spectrum);
  if (!file) return Propagate(std::move(file));
  auto chosen = ChosenSpectra(*file, options.spectrum, options.column);
  if (!chosen) return Propagate(std::move(chosen));
  console.Warn(file->warnings);
  AnsweredColors answered;
  if (!options.through.empty()) {
    auto gels = GelsAsked(options, *chosen, console);
    if (!gels) return Propagate(std::move(gels));
    answered.behind = *std::move(gels);
  }
  answered.one = chosen->size() == 1;
  for (std::size_t i = 0; i < chosen->size(); ++i) {
    const ImportedSpectrum& imported = (*chosen)[i];
    const std::string subject =
        imported.name.empty() ? options.spectrum : options.spectrum + ": " + imported.name;
    auto answer = AnswerFor(imported, subject, extras);
    if (!answer && answered.one) return Propagate(std::move(answer));
    if (!answer) {  // one dark column among many
      const Error& e = answer.error();
      console.Warn({e.code, e.subject, e.message});
      answered.documents.push_back({{"name", imported.name}, {"refused", e.code}});
      continue;
    }
    if (const auto range = WarningOfRange(imported.spectrum, subject)) console.Warn(*range);
    if (const auto clip = WarningOfClip(imported.spectrum, subject)) console.Warn(*clip);
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
    answered.documents.push_back(ToJson(*answer));
    if (!answered.behind.empty()) {
      answered.documents.back().Put("through", ThroughNode(answered.behind[i]));
    }
    answered.colors.push_back(std::move(*answer));
  }
  return answered;
}

}  // namespace

void TakeTyped(ColorOptions& o) {
  const bool named = !o.xy.empty() || !o.xyz.empty() || !o.cct.empty() || !o.spectrum.empty();
  if (named || o.typed.empty()) return;  // both: CheckColor refuses
  const std::vector<std::string> given = std::exchange(o.typed, {});
  std::vector<std::string> words;
  for (const std::string& word : given) {
    std::vector<std::string> parts = SplitAt(word, ',');
    if (parts.back().empty()) parts.pop_back();  // "0.33, 0.34"
    std::ranges::move(parts, std::back_inserter(words));
  }
  const bool numbers =
      std::ranges::all_of(words, [](const auto& w) { return ParseNumber(w).has_value(); });
  if (numbers && (words.size() == 2 || words.size() == 3)) {
    (words.size() == 2 ? o.xy : o.xyz) = words;
  } else if (given.size() > 1) {
    o.typed = given;
  } else if (ParseTemperature(given.front())) {
    o.cct = given.front();
  } else {
    o.spectrum = given.front();
  }
}

Result<void> CheckColor(const ColorOptions& o) {
  const int questions = static_cast<int>(!o.xy.empty()) + static_cast<int>(!o.xyz.empty()) +
                        static_cast<int>(!o.cct.empty()) + static_cast<int>(!o.spectrum.empty()) +
                        static_cast<int>(!o.batch.empty()) + 2 * static_cast<int>(!o.typed.empty());
  if (questions != 1) {
    return WrongUsage(
        "color",
        "give one colour: 3200K, 0.33,0.34 or a spectrum's file, --xyz X,Y,Z or --batch FILE.csv");
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

Result<AnsweredColors> AnswerColor(const ColorOptions& options, const ColorExtras& extras,
                                   Console& console) {
  return options.spectrum.empty() ? AnswerTyped(options, extras, console)
                                  : AnswerSpectra(options, extras, console);
}

Node DocumentOf(const AnsweredColors& answered) {
  if (answered.one) return answered.documents.front();
  return {{"spectra", answered.documents}};
}

}  // namespace lightcal::app
