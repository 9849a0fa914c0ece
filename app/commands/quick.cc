// SPDX-License-Identifier: Apache-2.0
// lightcal quick: no session needed. Typed readings or a data sheet's figures become a session in
// memory and go through the same fit.
#include <CLI/CLI.hpp>
#include <memory>

#include "commands.h"
#include "directory_name.h"
#include "engine_colors.h"
#include "lamp_answer.h"
#include "lamp_words.h"
#include "light_table.h"
#include "lightcal/calibrate/export_presets.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/presets/preset_table.h"
#include "match/behind_gels.h"
#include "minutes_answer.h"
#include "one_of.h"
#include "output_files.h"
#include "preset_flags.h"
#include "quick/quick_answer.h"
#include "quick/quick_session.h"
#include "quick/quick_table.h"
#include "target_words.h"

namespace lightcal::app {
namespace {

std::string ValueAndRange(const Uncertain& lx) { return ValueText(lx) + " lx   " + RangeText(lx); }

// "at 3 m   lamp alone 5.2 lx   4.6 … 5.9   in the room 12 lx   8 … 17"
std::string PredictionLines(const QuickAnswer& answer) {
  const bool outdoors = answer.session.surroundings == Surroundings::kOutdoors;
  const std::string where = outdoors ? "over the ground " : "in the room ";
  std::string text;
  for (const QuickPrediction& p : answer.predictions) {
    std::string line = "a meter reads " + ValueAndRange(p.predicted.reading_lx);
    if (p.in_room) {
      line = "lamp alone " + ValueAndRange(p.predicted.reading_lx) + "   " + where +
             ValueAndRange(p.in_room->reading_lx);
    }
    text += LabelledLine("at " + ShortestText(p.distance.value()) + " m", line);
  }
  return text;
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

void PrintAnswer(const QuickOptions& options, const QuickAnswer& answer, Console& console) {
  const LightFile& lights = answer.fitted.lights;
  if (answer.behind) console.Print(ThroughText(*answer.behind) + "\n\n");
  console.Print(LampAnswersText(answer.answers, answer.session));
  console.Print(PredictionLines(answer));
  if (console.verbose()) {
    console.Print(ColorLines(answer.answers.front().figures));
    console.Print("\n" + LightTable(lights) + "\n" + FitTable(lights) + "\n" +
                  BudgetTable(lights.lights.front()));
  }
  console.PrintDocument(DocumentOf(answer));
  if (options.targets.empty()) {
    console.Note("add --to gltf,json -o DIR to write presets");
  }
}

Result<void> RunQuick(const QuickOptions& options, Console& console) {
  if (!options.table.empty()) return RunQuickTable(options, console);
  if (options.readings.empty() && options.lumens.empty()) {
    auto session = SessionFromOptions(options);
    if (!session) return Propagate(std::move(session));
    const auto wishes = LadderWishesOf(options.minutes);
    if (!wishes) return tl::unexpected(wishes.error());
    return PlanFromNone(options, *session, *wishes, console);
  }
  const auto answer = AnswerQuick(options, console);
  if (!answer) return tl::unexpected(answer.error());
  std::vector<OutputFile> files;
  if (!options.targets.empty()) {
    auto presets = ExportPresets(answer->fitted.lights, options.targets, answer->session.stem,
                                 {.rig = options.rig});
    if (!presets) return Propagate(std::move(presets));
    console.Warn(presets->warnings);
    for (PresetFile& file : presets->files) {
      files.push_back({std::move(file.name), std::move(file.contents)});
    }
    PlaceUnder(options.output, files);
  }
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  if (auto written = WriteOutputs(files, options.force); !written) return written;
  PrintAnswer(options, *answer, console);
  if (options.plan) {
    if (auto printed = PrintMinutes(options, answer->ladders, console); !printed) return printed;
  }
  if (const std::string wrote = WroteLine(files, options.output); !wrote.empty()) {
    console.Note(wrote);
  }
  return {};
}

}  // namespace

Run BuildQuick(CLI::App& parser) {
  auto options = std::make_shared<QuickOptions>();
  parser.add_option("readings", options->readings,
                    "What the meter showed and where: 192lx@0.5m, 17.8fc@20in; with a shadow card "
                    "52lx@1m,card=5lx, with the lamp off ,off=2lx");
  CLI::Option* const table = parser.add_option(
      "--table", options->table,
      "Many lamps, one a row of this CSV: name,distance_m,illuminance_lx,card_lx,cct_K,fixture ... "
      "or a column reading with 203lx@0.5m,card=5lx; -o FILE.csv takes the answers");
  table->type_name("FILE.csv")->excludes(parser.get_option("readings"));
  parser
      .add_option("--columns", options->columns,
                  "Names of the table's columns, where its first line has none")
      ->needs(table);
  parser.add_option("--name", options->name, "Name of the light")->capture_default_str();
  parser
      .add_option("--kind", options->kind,
                  "What shines [point; spot with --beam, rect with --size, tube with --length]")
      ->check(OneOf(kQuickKinds));
  parser.add_option("--cct", options->cct, "Colour temperature, e.g. 2900K");
  parser.add_option("--duv", options->duv,
                    "Beside a colour temperature what a colour meter calls Duv or delta uv, e.g. "
                    "0.004: above zero greener");
  parser
      .add_option("--fixture", options->fixture,
                  "How the lamp is built: where its light starts, how wide it shines")
      ->check(OneOf(kFixtureNames));
  parser.add_option(
      "--room", options->room,
      "Where it stands: 5,4,2.6 in metres (and ,0.7 for the walls' reflectance), dark "
      "or outdoors [an ordinary room]");
  parser.add_option("--diameter", options->diameter, "Of a sphere or disk, e.g. 6cm");
  parser.add_option("--size", options->size, "Of a rect: 120x60cm");
  parser.add_option("--length", options->length, "Of a tube, e.g. 1.2m");
  parser.add_option("--radius", options->radius, "Of a tube, e.g. 13mm");
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
      ->check(OneOf(TargetWords()))
      ->delimiter(',')
      ->allow_extra_args(false);
  parser.add_option("-o,--output", options->output, "Where the presets go")
      ->check(DirectoryName(".csv"))  // a table's answers
      ->capture_default_str();
  CLI::Option* const plan =
      parser.add_flag("--plan", options->plan,
                      "What the next minutes of measuring buy, from these readings or from none");
  AddMinutesOptions(parser, options->minutes);
  for (const char* name : {"--minutes", "--reach", "--plot"}) {
    parser.get_option(name)->needs(plan);
  }
  AddSceneFlags(parser, options->rig, options->bare);
  parser.add_flag("--force", options->force, "Replace files that lightcal did not write");
  return [options](Console& console) -> Result<void> {
    if (auto parted = CheckNoTargetAmong(options->readings); !parted) return parted;
    SpellOutAll(options->targets);
    return RunQuick(*options, console);
  };
}

}  // namespace lightcal::app
