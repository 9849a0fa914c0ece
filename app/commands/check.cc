// SPDX-License-Identifier: Apache-2.0
// lightcal check: a preset file against the readings, or a rendered picture against the meter.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calibration_options.h"
#include "commands.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/check/card_picture.h"
#include "lightcal/presets/check/compare_readings.h"
#include "lightcal/presets/check/read_preset.h"
#include "lightcal/presets/check/render_cause.h"
#include "lightcal/presets/check/rig_file.h"
#include "lightcal/presets/preset_table.h"
#include "lightcal_devices/captures/picture.h"
#include "output_files.h"
#include "preset_input.h"

namespace lightcal::app {
namespace {

struct CheckOptions {
  std::string preset, session, render, rig, engine;
};

// ---- a picture ----

std::vector<std::string> Renderers() {
  std::vector<std::string> words;
  for (const PresetTarget* target : ReportTargets()) {
    for (const Renderer& renderer : target->renderers) words.emplace_back(renderer.word);
  }
  words.emplace_back("other");
  return words;
}

Node CauseNode(const RenderCause& cause) {
  return {{"code", cause.code}, {"message", cause.message}, {"factor", cause.factor}};
}

void PrintVerdict(const CheckedRig& rig, const RenderVerdict& verdict, Console& console) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < 2; ++i) {
    const double expected = rig.cards[i].expected_lx;
    rows.push_back({rig.cards[i].name, RoundedText(expected, 4) + " lx",
                    RoundedText(verdict.card_lx[i], 4) + " lx",
                    RoundedText(std::log2(verdict.card_lx[i] / expected), 2)});
  }
  console.Print(TextTable({"card", "meter", "picture", "stops"}, rows));
  console.Print("\n" + RoundedText(verdict.lux, 4) + " lx, " +
                RoundedText(std::log2(verdict.lux / verdict.expected_lx), 2) +
                " stops off: " + verdict.cause.code + "\n  " + verdict.cause.message + "\n");
  for (const RenderCause& other : verdict.alternatives) {
    console.Print("or " + other.code + ": " + other.message + "\n");
  }
}

Result<void> CheckRender(const CheckOptions& options, Console& console) {
  if (options.rig.empty()) {
    return WrongUsage("--rig", "is missing: the STEM.preset.json that was exported with the rig");
  }
  const auto text = ReadWholeFile(options.rig);
  if (!text) return tl::unexpected(text.error());
  const auto rig = RigFromPreset(*text, options.rig);
  if (!rig) return tl::unexpected(rig.error());
  const auto picture = devices::ReadPicture(options.render);
  if (!picture) return tl::unexpected(picture.error());
  const bool linear = picture->info.meaning == SampleMeaning::kLinear;
  const PixelUnit unit = linear ? LinearPixelsOf(options.engine) : PixelUnit::kExposed;
  const auto cards = MeasureCards(*picture, *rig);
  if (!cards) return tl::unexpected(cards.error());
  const auto verdict = JudgeRender(*rig, *cards, unit, options.render);
  if (!verdict) return tl::unexpected(verdict.error());
  for (std::size_t i = 0; i < 2; ++i) {
    const CardPixels& card = (*cards)[i];
    if (card.clipped[0] || card.clipped[1] || card.clipped[2]) {
      console.Warn(
          {"clipped", rig->cards[i].name, "is clipped in this picture and left out there"});
    }
    if (card.spread > 0.15) {
      console.Warn({"uneven_card", rig->cards[i].name,
                    "is uneven where the rig says it is: another camera, or too few samples"});
    }
  }
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  PrintVerdict(*rig, *verdict, console);
  Node measured = Node::Array();
  for (std::size_t i = 0; i < 2; ++i) {
    measured.items.push_back({{"name", rig->cards[i].name},
                              {"expected_lx", rig->cards[i].expected_lx},
                              {"illuminance_lx", verdict->card_lx[i]},
                              {"pixel", (*cards)[i].rgb}});
  }
  console.PrintDocument({{"illuminance_lx", verdict->lux},
                         {"expected_lx", verdict->expected_lx},
                         {"stops_off", std::log2(verdict->lux / verdict->expected_lx)},
                         {"cause", CauseNode(verdict->cause)},
                         {"alternatives", Node::List(verdict->alternatives, CauseNode)},
                         {"cards", measured}});
  return {};
}

// ---- a preset ----

Result<void> CheckPreset(const CheckOptions& options, Console& console) {
  const auto text = ReadWholeFile(options.preset);
  if (!text) return tl::unexpected(text.error());
  const auto lights = LightsOfPreset(options.preset, *text, FilesBeside(options.preset));
  if (!lights) return tl::unexpected(lights.error());
  const auto calibrated = CalibrateAloud(options.session, {}, console);
  if (!calibrated) return tl::unexpected(calibrated.error());
  const auto rows = CompareWithReadings(calibrated->session, calibrated->lights, *lights);
  if (rows.empty()) {
    return Refused("no_readings", options.session, "has no reading to check against");
  }
  if (std::ranges::any_of(
          rows, [](const ComparedReading& row) { return !std::isfinite(row.predicted_lx); })) {
    return Refused("bad_preset", options.preset,
                   "gives no finite illuminance at a reading; look at its numbers");
  }
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  std::vector<Node> readings;
  std::vector<std::vector<std::string>> table;
  for (const ComparedReading& row : rows) {
    readings.push_back({{"light", row.light},
                        {"index", row.index},
                        {"measured_lx", row.measured_lx},
                        {"predicted_lx", row.predicted_lx},
                        {"used", row.used},
                        {"distance_m", row.distance_m}});
    std::string error = "-";
    if (row.measured_lx > 0.0) {
      readings.back().Put("error", row.predicted_lx / row.measured_lx - 1.0);
      error = PercentText(row.predicted_lx / row.measured_lx - 1.0);
    }
    table.push_back({row.light, row.distance_m ? RoundedText(*row.distance_m, 3) + " m" : "-",
                     RoundedText(row.measured_lx, 4) + " lx",
                     RoundedText(row.predicted_lx, 4) + " lx",
                     error + (row.used ? "" : " (rejected)")});
  }
  console.Print(TextTable({"light", "distance", "meter", "preset", "error"}, table));
  console.Print("\nrms " + PercentText(RmsOf(rows)) + "\n");
  console.PrintDocument({{"readings", readings}, {"rms_relative", RmsOf(rows)}});
  return {};
}

Result<void> RunCheck(const CheckOptions& options, Console& console) {
  if (!options.render.empty()) return CheckRender(options, console);
  if (options.preset.empty() || options.session.empty()) {
    return WrongUsage("check",
                      "needs PRESET --session SESSION, or --render PICTURE --rig PRESET.json");
  }
  return CheckPreset(options, console);
}

}  // namespace

Run BuildCheck(CLI::App& parser) {
  auto options = std::make_shared<CheckOptions>();
  parser.add_option("preset", options->preset, "An exported file: " + ReadableEndings(" "));
  parser.add_option("--session", options->session, "The readings it is checked against");
  parser.add_option("--render", options->render, "A picture an engine rendered of the rig");
  parser.add_option("--rig", options->rig, "The STEM.preset.json of that rig");
  parser
      .add_option("--engine", options->engine,
                  "Who rendered it: an EXR of blender holds watts, one of three cd/m2; any other "
                  "picture is exposed")
      ->check(CLI::IsMember(Renderers()));
  return [options](Console& console) { return RunCheck(*options, console); };
}

}  // namespace lightcal::app
