// SPDX-License-Identifier: Apache-2.0
// lightcal check: a preset file against the readings, or a rendered picture against the meter.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "check_preset.h"
#include "check_render.h"
#include "commands.h"
#include "lightcal/presets/preset_table.h"

namespace lightcal::app {
namespace {

struct CheckOptions {
  PresetCheck preset;
  RenderCheck render;
};

std::vector<std::string> Renderers() {
  std::vector<std::string> words;
  for (const PresetTarget* target : ReportTargets()) {
    for (const Renderer& renderer : target->renderers) words.emplace_back(renderer.word);
  }
  words.emplace_back("other");
  return words;
}

Result<void> RunCheck(const CheckOptions& options, Console& console) {
  if (!options.render.renders.empty()) {
    RenderCheck render = options.render;
    render.max_error = options.preset.max_error;
    return CheckRender(render, console);
  }
  if (options.preset.file.empty() || options.preset.session.empty()) {
    return WrongUsage("check",
                      "needs PRESET --session SESSION, or --render PICTURE --rig PRESET.json");
  }
  return CheckPreset(options.preset, console);
}

}  // namespace

Run BuildCheck(CLI::App& parser) {
  auto options = std::make_shared<CheckOptions>();
  parser.add_option("preset", options->preset.file, "An exported file: " + ReadableEndings(" "));
  parser.add_option("--session", options->preset.session, "The readings it is checked against");
  parser
      .add_option("--state", options->preset.states,
                  "The preset is of lights at this state, as export writes it: "
                  "[LIGHT:]dimmer=18,cct_K=4500")
      ->allow_extra_args(false);
  parser.add_option("--white", options->preset.white,
                    "What the preset's pipeline shows as white, as export wrote it [D65]");
  parser
      .add_option(
          "--max-error", options->preset.max_error,
          "Exit 1 where the rms over a light's readings, or a card of a picture, is off beyond "
          "this")
      ->default_str(options->preset.max_error);
  parser
      .add_option(
          "--render", options->render.renders,
          "A picture an engine rendered of the rig; several, each with its --rig (export "
          "--rig-at), show what one cannot: a cone law, a turned or mirrored panorama, which "
          "lamp of several is wrong")
      ->allow_extra_args(false);
  parser.add_option("--rig", options->render.rigs, "The STEM.preset.json of that rig")
      ->allow_extra_args(false);
  parser
      .add_option("--engine", options->render.engine,
                  "Who rendered it: an EXR of blender holds watts, one of three cd/m2; any other "
                  "picture is exposed")
      ->check(CLI::IsMember(Renderers()));
  return [options](Console& console) { return RunCheck(*options, console); };
}

}  // namespace lightcal::app
