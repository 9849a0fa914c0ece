// SPDX-License-Identifier: Apache-2.0
// lightcal quick: no session needed. Typed readings or a data sheet's figures become a session in
// memory and go through the same fit.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "calibration_options.h"
#include "commands.h"
#include "light_table.h"
#include "lightcal/core/file_stem.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/printable.h"
#include "lightcal/core/units_text.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/plan/reading_candidates.h"
#include "lightcal/match/gelled_light.h"
#include "lightcal/presets/export_presets.h"
#include "lightcal/presets/preset_table.h"
#include "lightcal/records/light_codec.h"
#include "match/behind_gels.h"
#include "minutes_answer.h"
#include "one_of.h"
#include "output_files.h"
#include "typed_reading.h"

namespace lightcal::app {
namespace {

struct QuickOptions {
  std::vector<std::string> readings;
  std::string name = "light";
  std::string kind;
  std::string cct, diameter, fixture, room, meter, sigma, beam, field, lumens, watts, inner, outer;
  std::string gel, gels, spectrum;
  std::vector<std::string> predict_at;
  std::vector<std::string> targets;
  std::string output = "lightcal-quick";
  bool full_angles = false;
  bool bare = false;
  bool force = false;
  bool plan = false;
  MinutesOptions minutes;
};

// Fills an optional quantity from an option's text; an empty text leaves it absent.
template <class Unit, class Parse>
Result<void> Fill(std::optional<Unit>& target, const std::string& text, Parse parse) {
  if (text.empty()) return {};
  const auto value = parse(text);
  if (!value) return tl::unexpected(value.error());
  if (!(value->value() > 0.0)) return WrongUsage(text, "must be above zero");
  target = Unit(*value);
  return {};
}

template <class Unit>
Result<void> FillPlain(std::optional<Unit>& target, const std::string& text,
                       std::string_view unit_word) {
  return Fill(target, text, [unit_word](const std::string& t) -> Result<Unit> {
    const auto split = SplitNumberAndUnit(t);
    if (!split) return tl::unexpected(split.error());
    if (!split->unit.empty() && LowerAscii(split->unit) != LowerAscii(unit_word)) {
      return WrongUsage(t, "the unit here is " + std::string(unit_word));
    }
    return Unit(split->number);
  });
}

constexpr std::array<std::string_view, 5> kQuickKinds = {"point", "spot", "sphere", "disk",
                                                         "directional"};

Result<LightDescription> DescribeLight(const QuickOptions& options) {
  LightDescription light;
  light.name = options.name;
  const std::string kind = !options.kind.empty()                             ? options.kind
                           : !options.outer.empty() || !options.beam.empty() ? "spot"
                                                                             : "point";
  const auto known = LightKindFromName(kind);
  if (!known) return WrongUsage(kind, "unknown --kind; point, spot, sphere, disk or directional");
  light.kind = *known;
  const auto fixture = std::ranges::find(kFixtureNames, options.fixture);
  if (fixture != kFixtureNames.end()) {
    light.fixture = static_cast<Fixture>(fixture - kFixtureNames.begin());
  }
  std::optional<Radians> inner = std::nullopt;
  std::optional<Radians> outer = std::nullopt;
  for (const Result<void>& filled :
       {Fill(light.diameter, options.diameter, [](const auto& t) { return ParseLength(t); }),
        Fill(inner, options.inner, [](const auto& t) { return ParseAngle(t); }),
        Fill(outer, options.outer, [](const auto& t) { return ParseAngle(t); }),
        Fill(light.beam, options.beam, [](const auto& t) { return ParseAngle(t); }),
        Fill(light.field, options.field, [](const auto& t) { return ParseAngle(t); }),
        FillPlain(light.flux, options.lumens, "lm"),
        FillPlain(light.electrical, options.watts, "W")}) {
    if (!filled) return tl::unexpected(filled.error());
  }
  const double half = options.full_angles ? 0.5 : 1.0;
  if (inner) light.inner = *inner * half;
  if (outer) light.outer = *outer * half;
  return light;
}

constexpr const char* kQuickMeter = "meter";

// 1 sigma of a reading as it was typed, or by what the meter's maker says; absent where neither is.
Result<std::optional<double>> SigmaAsked(const QuickOptions& options) {
  if (options.sigma.empty() && options.meter.empty()) return std::nullopt;
  const auto sigma =
      options.meter.empty() ? ParseTolerance(options.sigma) : SigmaOfMeter(options.meter);
  if (!sigma) return tl::unexpected(sigma.error());
  return *sigma;
}

Result<void> AddReadings(Session& session, const QuickOptions& options) {
  std::optional<Kelvin> cct;
  if (auto filled = Fill(cct, options.cct, [](const auto& t) { return ParseTemperature(t); });
      !filled) {
    return filled;
  }
  const auto sigma = SigmaAsked(options);
  if (!sigma) return tl::unexpected(sigma.error());
  for (const std::string& text : options.readings) {
    auto typed = ParseTypedReading(text, options.name);
    if (!typed) return Propagate(std::move(typed));
    for (Reading& reading : *typed) {
      if (fit::IsLit(reading) && !reading.cct) reading.cct = cct;
      if (options.meter.empty()) {
        reading.sigma_relative = *sigma;
      } else {
        reading.meter = kQuickMeter;
      }
      session.readings.push_back({std::move(reading), text});
    }
  }
  if (options.readings.empty() && cct) {
    Reading color_only;
    color_only.light = options.name;
    color_only.cct = cct;
    session.readings.push_back({color_only, "--cct " + options.cct});
  }
  return {};
}

// What all readings are taken with, and the first will be, where none is there to tell.
Result<void> AddMeter(Session& session, const QuickOptions& options) {
  const auto sigma = SigmaAsked(options);
  if (!sigma) return tl::unexpected(sigma.error());
  if (!*sigma || (options.meter.empty() && !options.readings.empty())) return {};
  MeterDescription meter;
  meter.name = kQuickMeter;
  meter.sigma_relative = **sigma;
  session.meters.push_back(std::move(meter));
  return {};
}

Result<Session> SessionFromOptions(const QuickOptions& options) {
  if (options.readings.empty() && options.lumens.empty() && !options.plan) {
    return WrongUsage("quick", "give a reading such as 192lx@0.5m, or a data sheet's --lumens 806");
  }
  if (options.name.empty() || !IsPrintable(options.name)) {
    return WrongUsage("--name", "\"" + options.name + "\" is no name: letters that show, please");
  }
  auto light = DescribeLight(options);
  if (!light) return Propagate(std::move(light));
  Session session;
  session.name = options.name;
  session.stem = FileStem(options.name);
  session.directory = ".";
  session.lights.push_back(std::move(*light));
  if (!options.room.empty()) {
    if (auto set = SetRoom(options.room, session); !set) return Propagate(std::move(set));
  }
  if (auto added = AddReadings(session, options); !added) return Propagate(std::move(added));
  if (auto added = AddMeter(session, options); !added) return Propagate(std::move(added));
  return session;
}

struct Prediction {
  Metres distance;
  PredictedIlluminance predicted;
};

Result<std::vector<Prediction>> Predict(const QuickOptions& options, const FittedLight& light) {
  std::vector<Prediction> predictions;
  const auto asked = SigmaAsked(options);
  if (!asked) return tl::unexpected(asked.error());
  const double sigma = asked->value_or(kSigmaUnnamedMeter);
  for (const std::string& text : options.predict_at) {
    const auto distance = ParseLength(text);
    if (!distance) return tl::unexpected(distance.error());
    auto predicted = PredictIlluminance(light, *distance, sigma);
    if (!predicted) return Propagate(std::move(predicted));
    predictions.push_back({*distance, *predicted});
  }
  return predictions;
}

std::string PredictionTable(const std::vector<Prediction>& predictions) {
  std::vector<std::vector<std::string>> rows;
  rows.reserve(predictions.size());
  for (const Prediction& p : predictions) {
    const Uncertain& lx = p.predicted.reading_lx;
    const std::string range =
        lx.low && lx.high ? RoundedText(*lx.low, 4) + " … " + RoundedText(*lx.high, 4) + " lx"
                          : "-";
    rows.push_back({RoundedText(p.distance.value(), 4) + " m",
                    ValueWithPercent(lx.value, lx.u95, "lx"), range});
  }
  return TextTable({"at", "a meter will read", "95 %"}, rows);
}

// What the minutes buy, at the end of whatever else is said.
Result<void> PrintMinutes(const QuickOptions& options, const std::vector<MinutesLadder>& ladders,
                          Console& console) {
  auto pictures = MinutesPictures(options.minutes, ladders);
  if (!pictures) return Propagate(std::move(pictures));
  if (auto written = WriteOutputs(*pictures, options.force); !written) return written;
  console.Print("\n" + MinutesTable(ladders) + "\n");
  for (const std::string& sentence : MinutesSentences(ladders)) console.Print(sentence + "\n");
  for (const OutputFile& file : *pictures) console.Note("wrote " + file.path);
  return {};
}

// Before any reading: the ladder alone.
Result<void> PlanFromNone(const QuickOptions& options, const Session& session,
                          const LadderWishes& wishes, Console& console) {
  auto ladder = PlanMinutes(session, options.name, FitSettings{}, wishes);
  if (!ladder) return Propagate(std::move(ladder));
  const std::vector<MinutesLadder> ladders = {*std::move(ladder)};
  if (auto printed = PrintMinutes(options, ladders, console); !printed) return printed;
  console.PrintDocument({{"minutes", Node::List(ladders, MinutesNode)}});
  return {};
}

// The fitted light behind its gels. Without a spectrum its colour stands for a black body or
// daylight, which is said.
Result<BehindGels> PutGelBefore(const QuickOptions& options, FittedLight& light, Console& console) {
  MatchLightWords words;
  words.source = options.spectrum;
  if (options.spectrum.empty()) {
    if (!light.color.cct_K) {
      return Refused("no_spectrum", "--gel",
                     "what a gel makes of a lamp depends on its spectrum; give --spectrum FILE, or "
                     "at least --cct 3200K");
    }
    words.source = ShortestText(std::round(light.color.cct_K->value)) + "K";
    console.Warn({"spectrum_assumed", "--gel",
                  "a black body or daylight of " + words.source +
                      " stands for the lamp; give its own with --spectrum FILE"});
  }
  auto lamp = ReadMatchLight(words, console);
  if (!lamp) return Propagate(std::move(lamp));
  auto behind = PutBehindGels(lamp->spectrum, lamp->measured, options.gel, options.gels, console);
  if (!behind) return Propagate(std::move(behind));
  if (behind->size() != 1) return WrongUsage("--gel", "name one gel, or a stack: L204+L298");
  light = match::LightBehind(light, behind->front().match);
  return std::move(behind->front());
}

void PrintAnswer(const QuickOptions& options, const FittedSession& fitted, const std::string& next,
                 const std::vector<Prediction>& predictions,
                 const std::vector<MinutesLadder>& ladders, const std::optional<BehindGels>& behind,
                 Console& console) {
  const FittedLight& light = fitted.lights.lights.front();
  if (behind) console.Print(ThroughText(*behind) + "\n\n");
  console.Print(LightTable(fitted.lights) + "\n" + FitTable(fitted.lights));
  if (light.intensity_cd && light.intensity_cd->low && light.intensity_cd->high) {
    console.Print("\n95 % interval: " + RoundedText(*light.intensity_cd->low, 3) + " … " +
                  RoundedText(*light.intensity_cd->high, 3) + " cd\n");
  }
  if (!predictions.empty()) console.Print("\n" + PredictionTable(predictions));
  console.Print("\nnext: " + next + "\n");
  Node document = DocumentOf(fitted.lights);
  document.Put("next_step", next);
  if (behind) document.Put("through", ThroughNode(*behind));
  document.Put("predictions",
               Node::UnlessEmpty(Node::List(predictions, [](const Prediction& p) -> Node {
                 return {{"distance_m", p.distance},
                         {"model_lx", DocumentOf(p.predicted.model_lx)},
                         {"reading_lx", DocumentOf(p.predicted.reading_lx)}};
               })));
  document.Put("minutes", Node::UnlessEmpty(Node::List(ladders, MinutesNode)));
  console.PrintDocument(std::move(document));
  if (options.targets.empty()) {
    console.Note("add --to gltf,json -o DIR to write presets");
  }
}

Result<void> RunQuick(const QuickOptions& options, Console& console) {
  auto session = SessionFromOptions(options);
  if (!session) return Propagate(std::move(session));
  const auto wishes = LadderWishesOf(options.minutes);
  if (!wishes) return tl::unexpected(wishes.error());
  if (options.readings.empty() && options.lumens.empty()) {
    return PlanFromNone(options, *session, *wishes, console);
  }
  auto fitted = FitSession(*session, FitSettings{});
  if (!fitted) return Propagate(std::move(fitted));
  fitted->lights.provenance.generator = GeneratorName();
  const FittedLight bare = fitted->lights.lights.front();
  std::optional<BehindGels> behind;
  if (!options.gel.empty()) {
    auto put = PutGelBefore(options, fitted->lights.lights.front(), console);
    if (!put) return Propagate(std::move(put));
    behind = *std::move(put);
  }
  const FittedLight& light = fitted->lights.lights.front();
  const auto predictions = Predict(options, light);
  if (!predictions) return tl::unexpected(predictions.error());
  if (const auto json = LightFileToJson(fitted->lights); !json) return tl::unexpected(json.error());
  console.Warn(fitted->warnings);
  std::vector<OutputFile> files;
  if (!options.targets.empty()) {
    auto presets =
        ExportPresets(fitted->lights, options.targets, session->stem, {.bare = options.bare});
    if (!presets) return Propagate(std::move(presets));
    console.Warn(presets->warnings);
    for (PresetFile& file : presets->files) {
      files.push_back({std::move(file.name), std::move(file.contents)});
    }
    PlaceUnder(options.output, files);
  }
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  if (auto written = WriteOutputs(files, options.force); !written) return written;
  std::vector<MinutesLadder> ladders;
  if (options.plan) ladders = LaddersOf(*session, {}, *wishes);
  PrintAnswer(options, *fitted, NextStep(*session, bare), *predictions, ladders, behind, console);
  if (options.plan) {
    if (auto printed = PrintMinutes(options, ladders, console); !printed) return printed;
  }
  for (const OutputFile& file : files) console.Note("wrote " + file.path);
  return {};
}

}  // namespace

Run BuildQuick(CLI::App& parser) {
  auto options = std::make_shared<QuickOptions>();
  parser.add_option("readings", options->readings,
                    "What the meter showed and where: 192lx@0.5m, 17.8fc@20in; with a shadow card "
                    "52lx@1m,card=5lx, with the lamp off ,off=2lx");
  parser.add_option("--name", options->name, "Name of the light")->capture_default_str();
  parser.add_option("--kind", options->kind, "What shines [point; spot with --beam]")
      ->check(OneOf(kQuickKinds));
  parser.add_option("--cct", options->cct, "Colour temperature, e.g. 2900K");
  parser
      .add_option("--fixture", options->fixture,
                  "How the lamp is built: where its light starts, how wide it shines")
      ->check(OneOf(kFixtureNames));
  parser.add_option(
      "--room", options->room,
      "Where it stands: 5,4,2.6 in metres (and ,0.7 for the walls' reflectance), dark "
      "or outdoors [an ordinary room]");
  parser.add_option("--diameter", options->diameter, "Of a sphere or disk, e.g. 6cm");
  parser.add_option("--inner", options->inner, "Half angle where the spot starts to fall off");
  parser.add_option("--outer", options->outer, "Half angle where the spot ends");
  parser.add_flag("--full-angles", options->full_angles, "--inner and --outer are full angles");
  CLI::Option* const sigma =
      parser.add_option("--sigma", options->sigma, "1 sigma of a reading, e.g. 3% [5%]");
  parser
      .add_option("--meter", options->meter,
                  "phone, hobby or lab, or what its maker says of the meter, e.g. 3%: taken as 95 "
                  "%, and shared by all readings as a meter's error is")
      ->excludes(sigma);
  parser.add_option("--lumens", options->lumens, "Data sheet: luminous flux, e.g. 806");
  parser.add_option("--beam", options->beam, "Data sheet: full beam angle (50 % of the peak)");
  parser.add_option("--field", options->field, "Data sheet: full field angle (10 % of the peak)");
  parser.add_option("--watts", options->watts, "Data sheet: electrical power");
  CLI::Option* const gel =
      parser
          .add_option("--gel", options->gel,
                      "Put this gel, or stack, before the lamp: L204, \"half cto\", L204+L298")
          ->type_name("GEL");
  parser
      .add_option("--gels", options->gels,
                  "A maker's transmittances for --gel [demonstration filters by formula]")
      ->type_name("FILE.csv")
      ->needs(gel);
  parser
      .add_option("--spectrum", options->spectrum,
                  "The lamp's, for --gel [black body or daylight of its colour temperature]")
      ->type_name("FILE")
      ->needs(gel);
  parser.add_option("--at", options->predict_at, "Predict the reading at this distance, e.g. 5m")
      ->allow_extra_args(false);
  parser.add_option("--to", options->targets, "Also write presets")
      ->check(OneOf(NamesOf(PresetTargets())))
      ->delimiter(',')
      ->allow_extra_args(false);
  parser.add_option("-o,--output", options->output, "Where the presets go")->capture_default_str();
  CLI::Option* const plan =
      parser.add_flag("--plan", options->plan,
                      "What the next minutes of measuring buy, from these readings or from none");
  AddMinutesOptions(parser, options->minutes);
  for (const char* name : {"--minutes", "--reach", "--plot"}) {
    parser.get_option(name)->needs(plan);
  }
  parser.add_flag("--bare", options->bare, "Presets hold the light only, no cards and camera");
  parser.add_flag("--force", options->force, "Replace files that lightcal did not write");
  return [options](Console& console) { return RunQuick(*options, console); };
}

}  // namespace lightcal::app
