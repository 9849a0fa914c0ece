// SPDX-License-Identifier: Apache-2.0
// lightcal match: the gels and the dimming that bring one lamp to another, as eye and camera see
// it.
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "calibration_options.h"
#include "commands.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/match/gelled_light.h"
#include "lightcal/match/match_lights.h"
#include "lightcal/match/mix_lights.h"
#include "lightcal/records/light_codec.h"
#include "match/match_answer.h"
#include "match/match_by_states.h"
#include "match/match_sheet_of.h"
#include "match/match_source.h"
#include "output_files.h"
#include "picture_file.h"
#include "progress_line.h"
#include "typed_reading.h"

namespace lightcal::app {
namespace {

struct MatchOptions {
  MatchLightWords lamp, target;
  std::string gels, camera = "observer", meter, gel_spread = "2%";
  std::string observer = "2";
  int most_gels = 2;
  int count = 5;
  bool air_gaps = false;
  double reach = 0.02;
  std::string plot, output, with, with_column, with_light, to_state;
  int take = 1;
  bool force = false;
};

Result<match::MatchRequest> RequestOf(const MatchOptions& o, const MatchLight& lamp,
                                      const MatchLight& target) {
  auto cameras = ReadCameras(o.camera);
  if (!cameras) return Propagate(std::move(cameras));
  match::MatchRequest request = RequestBetween(lamp, target, *std::move(cameras));
  request.observer = o.observer == "10" ? ObserverAngle::kTenDegrees : ObserverAngle::kTwoDegrees;
  request.most_gels = o.most_gels;
  request.gap = o.air_gaps ? SheetGap::kAir : SheetGap::kNone;
  request.count = o.count;
  request.reach = o.reach;
  const auto spread = ParseTolerance(o.gel_spread);
  if (!spread) return tl::unexpected(spread.error());
  request.spread.gel_points = *spread;
  if (!o.meter.empty()) {
    const auto sigma = SigmaOfMeter(o.meter);
    if (!sigma) return tl::unexpected(sigma.error());
    request.spread.spectral *= *sigma / request.spread.level;
    request.spread.level = *sigma;
  }
  return request;
}

void WarnIfTooWeak(const match::Match& best, Console& console) {
  if (!best.dimmer_stops || *best.dimmer_stops >= 0.0) return;
  console.Warn({"lamp_too_weak", "lamp",
                "behind " + std::string(best.gels.empty() ? "no gel" : "these gels") + " it is " +
                    RoundedText(-*best.dimmer_stops, 2) +
                    " stops below the target where both were read; move it nearer or dim the "
                    "target"});
}

// ---- what is written ----

Result<OutputFile> GelledLightFile(const MatchOptions& o, const match::MatchRequest& request,
                                   const match::Match& match, const MatchLight& lamp) {
  LightFile file;
  if (lamp.light) {
    file.lights.push_back(match::LightBehind(*lamp.light, match));
  } else {
    auto light = match::LightAtMeter(request, match, lamp.title);
    if (!light) return Propagate(std::move(light));
    file.lights.push_back(*std::move(light));
  }
  file.provenance.generator = GeneratorName();
  file.provenance.inputs = lamp.inputs;
  auto text = LightFileToJson(file);
  if (!text) return Propagate(std::move(text));
  return OutputFile{o.output, *std::move(text)};
}

Result<std::vector<OutputFile>> FilesAsked(const MatchOptions& o,
                                           const match::MatchRequest& request,
                                           const match::MatchAnswer& answer, const GelSet& set,
                                           const MatchLight& lamp, const MatchLight& target) {
  std::vector<OutputFile> files;
  if (o.plot.empty() && o.output.empty()) return files;
  const auto taken = static_cast<std::size_t>(o.take);
  if (taken > answer.matches.size()) {
    return WrongUsage("--take", "there are " + std::to_string(answer.matches.size()) + " matches");
  }
  const match::Match& match = taken == 0 ? answer.unfiltered : answer.matches[taken - 1];
  if (!o.plot.empty()) {
    const auto sheet = SheetOf(request, match, StackTitle(match.gels, set), lamp, target);
    if (!sheet) return tl::unexpected(sheet.error());
    auto picture = PictureFile(o.plot, report::MatchSheetSvg(*sheet));
    if (!picture) return Propagate(std::move(picture));
    files.push_back(*std::move(picture));
  }
  if (!o.output.empty()) {
    auto light = GelledLightFile(o, request, match, lamp);
    if (!light) return Propagate(std::move(light));
    files.push_back(*std::move(light));
  }
  return files;
}

// ---- two lamps ----

Node DimmerNode(const Uncertain& dimmer) {
  return {
      {"value", dimmer.value}, {"u95", dimmer.u95}, {"low95", dimmer.low}, {"high95", dimmer.high}};
}

Result<void> RunMix(const MatchOptions& o, const MatchLight& lamp, const MatchLight& with,
                    const MatchLight& target, Console& console) {
  const auto request = RequestOf(o, lamp, target);
  if (!request) return tl::unexpected(request.error());
  const auto mix = match::MixLights(*request, with.spectrum, with.measured);
  if (!mix) return tl::unexpected(mix.error());
  for (const auto& [light, dimmer] :
       {std::pair{&lamp, &mix->dimmer_lamp}, {&with, &mix->dimmer_with}}) {
    if (!*dimmer || (*dimmer)->value <= 1.0 + 1e-9) continue;
    console.Warn({"lamp_too_weak", light->title,
                  "would have to give " + PercentText((*dimmer)->value, 3) +
                      " of what was read; move it nearer, or dim the target"});
  }
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  const auto row = [](const std::string& title, double share, double u95,
                      const std::optional<Uncertain>& dimmer) {
    return std::vector<std::string>{
        title, PercentText(share, 3) + " ± " + PercentText(u95),
        dimmer ? PercentText(dimmer->value, 3) + " ± " + PercentText(dimmer->u95) : kNone};
  };
  const GelSet none;
  const double share = mix->share.value;
  console.Print(TextTable({"lamp", "of the light", "dimmer"},
                          {row(lamp.title, share, mix->share.u95, mix->dimmer_lamp),
                           row(with.title, 1.0 - share, mix->share.u95, mix->dimmer_with)}) +
                "\n" + MatchTable({}, mix->mixed, none));
  Node dimmers = Node::Table();
  if (mix->dimmer_lamp) dimmers.Put("lamp", DimmerNode(*mix->dimmer_lamp));
  if (mix->dimmer_with) dimmers.Put("with", DimmerNode(*mix->dimmer_with));
  console.PrintDocument({{"lamp", lamp.title},
                         {"with", with.title},
                         {"target", target.title},
                         {"share", DimmerNode(mix->share)},
                         {"dimmer", Node::UnlessEmpty(std::move(dimmers))},
                         {"mixed", MatchNode(mix->mixed, none)}});
  return {};
}

Result<void> RunMatch(const MatchOptions& o, Console& console) {
  if (!o.plot.empty()) {
    if (auto named = CheckPictureName("--plot", o.plot); !named) return named;
  }
  // Gels, cameras and sheets want spectra; lamps are set by what is known of their colour.
  const bool by_states = o.gels.empty() && o.camera == "observer" && o.plot.empty();
  MatchLightWords lamp_words = o.lamp;
  lamp_words.by_states = by_states;
  const auto lamp = ReadMatchLight(lamp_words, console);
  if (!lamp) return tl::unexpected(lamp.error());
  std::optional<MatchLight> with;
  if (!o.with.empty()) {
    MatchLightWords words;
    words.source = o.with;
    words.column = o.with_column;
    words.light = o.with_light;
    words.by_states = by_states;
    auto read = ReadMatchLight(words, console);
    if (!read) return Propagate(std::move(read));
    with = *std::move(read);
  }
  const bool set = IsSetByStates(*lamp) || (with && IsSetByStates(*with));
  MatchLightWords target_words = o.target;
  target_words.by_color = set || !o.to_state.empty();
  auto target = ReadMatchLight(target_words, console);
  if (!target) return Propagate(std::move(target));
  if (!o.to_state.empty()) {
    if (!set) {
      return WrongUsage("--to-state",
                        "the lamp has no states of its own to be set by; export the "
                        "target at that state and give its spectrum");
    }
    if (auto at = SetMatchState(o.to_state, *target); !at) return at;
  }
  if (set) {
    const StateMatchWords words = {o.count, o.take, o.reach, o.meter, o.output, o.force};
    return with ? RunMixByStates(words, *lamp, *with, *target, console)
                : RunMatchByStates(words, *lamp, *target, console);
  }
  if (with) return RunMix(o, *lamp, *with, *target, console);
  const auto gels = ReadGels(o.gels, console);
  if (!gels) return tl::unexpected(gels.error());
  auto request = RequestOf(o, *lamp, *target);
  if (!request) return tl::unexpected(request.error());
  ProgressLine progress("looking at stacks", !console.quiet());
  request->progress = progress.Watcher();
  auto answer = match::MatchLights(*request, gels->gels);
  progress.Wipe();
  if (!answer) return Propagate(std::move(answer));
  WarnIfTooWeak(answer->matches.front(), console);
  const auto files = FilesAsked(o, *request, *answer, *gels, *lamp, *target);
  if (!files) return tl::unexpected(files.error());
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  if (auto written = WriteOutputs(*files, o.force); !written) return written;
  console.Print(lamp->title + " to " + target->title + ", " + std::to_string(answer->stacks) +
                " stacks of " + std::to_string(gels->gels.size()) + " gels (" + gels->source +
                ")\n\n" + MatchTable(answer->matches, answer->unfiltered, *gels));
  Node document = {
      {"lamp", LightNode(lamp->title, answer->unfiltered.xy, answer->unfiltered.cct)},
      {"target", LightNode(target->title, answer->target_xy, answer->target_cct)},
      {"gels_from", gels->source},
      {"demonstration", gels->demonstration},
      {"stacks", answer->stacks},
      {"cameras", request->cameras.size()},
      {"matches", Node::List(answer->matches,
                             [&](const match::Match& each) { return MatchNode(each, *gels); })},
      {"unfiltered", MatchNode(answer->unfiltered, *gels)}};
  if (!files->empty()) document.Put("files", PathsOf(*files));
  console.PrintDocument(std::move(document));
  for (const OutputFile& file : *files) console.Note("wrote " + file.path);
  return {};
}

}  // namespace

Run BuildMatch(CLI::App& parser) {
  auto o = std::make_shared<MatchOptions>();
  o->target.may_assume = true;
  parser
      .add_option("lamp", o->lamp.source,
                  "The lamp to be gelled: a spectrometer's export, a session, a light.json with "
                  "--spectrum, illuminant:FL4 or 3200K; or to be set: a session or light.json that "
                  "was read at states of its controls")
      ->required();
  parser
      .add_option("--to", o->target.source,
                  "What it is to look like: the same, a light.json's colour too; of kelvin a black "
                  "body below 4000 K, CIE daylight from there (SSI's rule)")
      ->required();
  parser
      .add_option("--gels", o->gels,
                  "Transmittances of a maker's filters [demonstration filters by formula]")
      ->type_name("FILE.csv");
  parser
      .add_option("--camera", o->camera,
                  "Whose colours decide: a camera's name (52 ship), all, a file or folder of "
                  "sensitivities, or observer")
      ->type_name("NAME|all|FILE|observer")
      ->capture_default_str();
  parser.add_option("--observer", o->observer, "The standard observer's field in degrees")
      ->check(CLI::IsMember({"2", "10"}))
      ->capture_default_str();
  parser.add_option("-n,--count", o->count, "How many matches")
      ->check(CLI::Range(1, 200))
      ->capture_default_str();
  parser.add_option("--most-gels", o->most_gels, "In one stack")
      ->check(CLI::Range(0, 2))
      ->capture_default_str();
  parser.add_flag("--air-gaps", o->air_gaps,
                  "Count the light thrown to and fro between two sheets that do not touch");
  parser
      .add_option("--gel-spread", o->gel_spread,
                  "What a batch of gel varies by: 95 %, points of transmittance")
      ->capture_default_str();
  parser.add_option("--meter", o->meter,
                    "phone, hobby or lab, or what its maker says of the meter, e.g. 3% [hobby]");
  parser
      .add_option("--reach", o->reach,
                  "The largest distance in u'v' that is still called a match; 1 shows the nearest")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  parser.add_option("--column", o->lamp.column, "Which spectrum of the lamp's file")
      ->type_name("NAME|N");
  parser.add_option("--to-column", o->target.column, "Which spectrum of the target's file")
      ->type_name("NAME|N");
  parser.add_option("--light", o->lamp.light, "Which light of the lamp's session or light.json");
  parser.add_option("--to-light", o->target.light, "Which light of the target's");
  parser
      .add_option("--to-state", o->to_state,
                  "At what its controls say the target is meant: dimmer=50,cct_K=4000")
      ->type_name("STATE");
  parser.add_option("--spectrum", o->lamp.spectrum, "The spectrum of a lamp that is a light.json")
      ->type_name("FILE");
  CLI::Option* const with = parser.add_option(
      "--with", o->with, "A second lamp: the two dimmers whose mix is nearest, without gels");
  parser.add_option("--with-column", o->with_column, "Which spectrum of its file")
      ->type_name("NAME|N")
      ->needs(with);
  parser.add_option("--with-light", o->with_light, "Which light of its session or light.json")
      ->needs(with);
  parser
      .add_option("--plot", o->plot,
                  "A sheet of patches under the lamp, the target and the lamp behind the gels, as "
                  "the camera sees them, and the spectra")
      ->type_name("FILE.svg|png")
      ->excludes(with);
  parser
      .add_option("-o,--output", o->output,
                  "The lamp behind the gels as a light.json, for lightcal export")
      ->type_name("light.json")
      ->excludes(with);
  parser
      .add_option("--take", o->take,
                  "Which match --plot and --output are of, from 1; 0 is the lamp as it is")
      ->check(CLI::Range(0, 200))
      ->capture_default_str();
  parser.add_flag("--force", o->force, "Replace files that lightcal did not write");
  return [o](Console& console) { return RunMatch(*o, console); };
}

}  // namespace lightcal::app
