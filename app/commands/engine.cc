// SPDX-License-Identifier: Apache-2.0
// lightcal engine: what a renderer makes of each kind of light, from its pictures of exported rigs.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "input_files.h"
#include "lightcal/core/generator_name.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/check/learn_engine.h"
#include "lightcal_devices/captures/picture.h"
#include "one_of.h"
#include "output_files.h"

namespace lightcal::app {
namespace {

constexpr double kSameKindApart = 0.02;  // |ln| between two pictures of one kind

struct EngineOptions {
  std::vector<std::string> files;
  std::string output, pixels;
  bool force = false;
};

const std::vector<std::string> kPixelWords = {"exposed", "nits", "watts"};

// Absent: nobody knows what a sample stands for.
std::optional<PixelUnit> UnitOf(const std::string& word, SampleMeaning meaning) {
  if (meaning != SampleMeaning::kLinear) return PixelUnit::kExposed;
  if (word == "exposed") return PixelUnit::kExposed;
  if (word == "nits") return PixelUnit::kNits;
  if (word == "watts") return PixelUnit::kWatts;
  return std::nullopt;
}

struct LearntPicture {
  LearntKind kind;
  bool absolute = true;
};

Result<LearntPicture> LearnPicture(const std::string& rig_path, const std::string& picture_path,
                                   const EngineOptions& options) {
  const auto text = ReadInputFile(rig_path);
  if (!text) return tl::unexpected(text.error());
  const auto rig = RigFromPreset(*text, rig_path);
  if (!rig) return tl::unexpected(rig.error());
  NoteInput(picture_path);
  const auto picture = devices::ReadPicture(picture_path);
  if (!picture) return tl::unexpected(picture.error());
  const auto cards = MeasureCards(*picture, *rig);
  if (!cards) return tl::unexpected(cards.error());
  const auto unit = UnitOf(options.pixels, picture->info.meaning);
  auto kind = LearnKind(*rig, *cards, unit.value_or(PixelUnit::kNits), picture_path);
  if (!kind) return Propagate(std::move(kind));
  return LearntPicture{*std::move(kind), unit.has_value()};
}

// Two pictures of one kind: their geometric mean, which is as sure as they agree.
void Join(const LearntKind& found, std::vector<LearntKind>& kinds, Console& console) {
  const auto it = std::ranges::find(kinds, found.kind, &LearntKind::kind);
  if (it == kinds.end()) {
    kinds.push_back(found);
    return;
  }
  const double apart = std::abs(std::log(found.factor / it->factor));
  if (apart > kSameKindApart) {
    console.Warn({"kinds_disagree", std::string(LightKindName(found.kind)),
                  "has two pictures that are " + PercentText(std::expm1(apart)) +
                      " apart; one factor cannot be right for both"});
  }
  it->factor = std::sqrt(it->factor * found.factor);
  it->u95_relative = std::max({it->u95_relative, found.u95_relative, apart / 2.0});
  if (it->cause != found.cause) it->cause = "unknown";
}

// Without a scale: factors over the first kind's, whose cause nobody knows.
void MakeRelative(LearntEngine& engine) {
  const double first = engine.kinds.front().factor;
  for (LearntKind& kind : engine.kinds) {
    kind.factor /= first;
    kind.cause = std::abs(std::log(kind.factor)) < kSameKindApart ? "none" : "unknown";
  }
}

void PrintEngine(const LearntEngine& engine, Console& console) {
  std::vector<std::vector<std::string>> rows;
  for (const LearntKind& kind : engine.kinds) {
    rows.push_back({std::string(LightKindName(kind.kind)), RoundedText(kind.factor, 5),
                    "± " + PercentText(kind.u95_relative), RoundedText(std::log2(kind.factor), 2),
                    kind.cause});
  }
  console.Print(TextTable({"kind", "factor", "95 %", "stops", "cause"}, rows));
  console.Print(engine.absolute
                    ? "\nCones and turns of axes are not learnt.\n"
                    : "\nFactors are relative to the first kind: what a sample of these "
                      "pictures stands for\nis not known (--pixels says it). Cones and "
                      "turns of axes are not learnt.\n");
}

Result<void> Learn(const EngineOptions& options, Console& console) {
  if (options.files.size() % 2 != 0) {
    return WrongUsage("engine learn", "takes pairs: RIG.preset.json and the picture of that rig");
  }
  LearntEngine engine;
  for (std::size_t i = 0; i < options.files.size(); i += 2) {
    const auto found = LearnPicture(options.files[i], options.files[i + 1], options);
    if (!found) return tl::unexpected(found.error());
    if (i > 0 && found->absolute != engine.absolute) {
      return Refused("mixed_scales", options.files[i + 1],
                     "is exposed, an earlier picture of unknown scale, or the other way round; "
                     "say with --pixels what a sample stands for");
    }
    engine.absolute = found->absolute;
    Join(found->kind, engine.kinds, console);
  }
  if (!engine.absolute) {
    if (engine.kinds.size() == 1) {
      return Refused("scale_unknown", options.files[1],
                     "is linear, and nobody said what a sample stands for: one kind alone has no "
                     "ratio. Say it with --pixels, or bring another kind's picture");
    }
    MakeRelative(engine);
  }
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  const auto text = EngineText(engine, GeneratorName(), options.output);
  if (!text) return tl::unexpected(text.error());
  if (!options.output.empty()) {
    if (auto written = WriteOutputs({{options.output, *text}}, options.force); !written) {
      return written;
    }
  }
  PrintEngine(engine, console);
  if (!options.output.empty()) console.Print("wrote " + options.output + "\n");
  const auto node = [](const LearntKind& kind) -> Node {
    return {{"kind", LightKindName(kind.kind)},
            {"factor", kind.factor},
            {"u95_relative", kind.u95_relative},
            {"cause", kind.cause}};
  };
  console.PrintDocument({{"absolute", engine.absolute},
                         {"kinds", Node::List(engine.kinds, node)},
                         {"file", Node::UnlessEmpty(options.output)}});
  return {};
}

}  // namespace

Run BuildEngine(CLI::App& parser) {
  auto options = std::make_shared<EngineOptions>();
  parser.require_subcommand(1);
  CLI::App* const learn =
      parser.add_subcommand("learn", "A factor for each kind of light in rendered rigs");
  learn->fallthrough();
  learn
      ->add_option("files", options->files,
                   "Pairs: the STEM.preset.json of a rig that was exported, and its picture")
      ->required();
  learn->add_option("-o,--output", options->output, "ENGINE.json, for export");
  learn
      ->add_option("--pixels", options->pixels,
                   "What a sample of an EXR is: exposed by the rig's exposure, cd/m2, or watts of "
                   "683 lm (Blender) [not known: ratios between kinds]")
      ->check(OneOf(kPixelWords));
  learn->add_flag("--force", options->force, "Replace a file that lightcal did not write");
  return [options](Console& console) { return Learn(*options, console); };
}

}  // namespace lightcal::app
