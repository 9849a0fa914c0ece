// SPDX-License-Identifier: Apache-2.0
// lightcal engine: rigs to render, and what a renderer makes of each kind of light by its pictures
// of them.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "directory_name.h"
#include "input_files.h"
#include "lightcal/core/generator_name.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/check/learn_engine.h"
#include "lightcal/presets/learning_rigs.h"
#include "lightcal/presets/turned_panorama.h"
#include "lightcal_devices/captures/picture.h"
#include "one_of.h"
#include "output_files.h"
#include "target_words.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

struct EngineOptions {
  std::vector<std::string> files;
  std::string output, pixels, target;
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

// ---- learn ----

struct RigPair {
  std::string rig, picture;
};

// Of a folder: each rig that has a picture of its own name beside it.
Result<std::vector<RigPair>> PairsIn(const std::string& folder) {
  constexpr std::string_view kEnding = ".preset.json";
  constexpr std::array<std::string_view, 3> kPictures = {".exr", ".png", ".hdr"};
  std::vector<RigPair> pairs;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string path = entry.path().string();
    if (!path.ends_with(kEnding)) continue;
    const std::string stem = path.substr(0, path.size() - kEnding.size());
    for (const std::string_view ending : kPictures) {
      const std::string picture = stem + std::string(ending);
      if (!fs::exists(picture, error)) continue;
      pairs.push_back({path, picture});
      break;
    }
  }
  std::ranges::sort(pairs, {}, &RigPair::rig);
  if (!pairs.empty()) return pairs;
  return Refused("no_pictures", folder,
                 "has no NAME.preset.json with its picture NAME.exr or NAME.png beside it; write "
                 "rigs with engine rig, render each, and save the picture by the scene's name");
}

Result<std::vector<RigPair>> PairsOf(const std::vector<std::string>& files) {
  std::error_code error;
  if (files.size() == 1 && fs::is_directory(files.front(), error)) return PairsIn(files.front());
  if (files.size() % 2 != 0) {
    return WrongUsage("engine learn",
                      "takes pairs, RIG.preset.json and the picture of that rig, or one folder");
  }
  std::vector<RigPair> pairs;
  for (std::size_t i = 0; i < files.size(); i += 2) pairs.push_back({files[i], files[i + 1]});
  return pairs;
}

Result<RigPicture> OpenPair(const RigPair& pair, const EngineOptions& options) {
  const auto text = ReadInputFile(pair.rig);
  if (!text) return tl::unexpected(text.error());
  const auto rig = RigFromPreset(*text, pair.rig);
  if (!rig) return tl::unexpected(rig.error());
  NoteInput(pair.picture);
  const auto picture = devices::ReadPicture(pair.picture);
  if (!picture) return tl::unexpected(picture.error());
  const auto cards = MeasureCards(*picture, *rig);
  if (!cards) return tl::unexpected(cards.error());
  return RigPicture{pair.picture, *rig, *cards, UnitOf(options.pixels, picture->info.meaning)};
}

Result<std::optional<EngineConeLaw>> WrittenLaw(const std::string& target) {
  if (target.empty()) return std::optional<EngineConeLaw>();
  const auto row = FindPresetTarget(target);
  if (!row) return tl::unexpected(row.error());
  return row->cone;
}

// "smooth_in_angle, angles x 0.5"; "turned 90°".
std::string ShapeText(const LearntKind& kind) {
  std::string text;
  if (kind.cone) {
    text = kConeLawWords[static_cast<std::size_t>(kind.cone->law)];
    if (kind.cone->hard) {
      text += ", no penumbra";
    } else if (kind.cone->inner_times == 0.0) {
      text += ", no inner angle";
    } else if (kind.cone->outer_times != 1.0) {
      text += ", angles x " + RoundedText(kind.cone->outer_times, 3);
    }
  }
  if (kind.turn && !kind.turn->IsNone()) {
    text = std::string(MistakenTurns()[kind.turn->way].word);
    if (kind.turn->turn_deg != 0.0) text += " " + RoundedText(kind.turn->turn_deg, 3) + " deg";
  }
  if (kind.area_power != 0) text = kind.area_power < 0 ? "1/area [m2]" : "area [m2]";
  return text.empty() ? "-" : text;
}

void PrintEngine(const LearntEngine& engine, Console& console) {
  std::vector<std::vector<std::string>> rows;
  for (const LearntKind& kind : engine.kinds) {
    rows.push_back({std::string(LightKindName(kind.kind)), RoundedText(kind.factor, 5),
                    "± " + PercentText(kind.u95_relative), RoundedText(std::log2(kind.factor), 2),
                    ShapeText(kind), kind.cause});
  }
  console.Print(TextTable({"kind", "factor", "95 %", "stops", "shape", "cause"}, rows));
  if (!engine.absolute) {
    console.Print(
        "\nFactors are relative to the first kind: what a sample of these pictures stands for\n"
        "is not known (--pixels says it).\n");
  }
  if (!engine.exposure_applied) {
    console.Print("\nThe camera's exposure is not applied: samples are cd/m2.\n");
  }
}

Result<void> Learn(const EngineOptions& options, Console& console) {
  const auto written = WrittenLaw(options.target);
  if (!written) return tl::unexpected(written.error());
  const auto pairs = PairsOf(options.files);
  if (!pairs) return tl::unexpected(pairs.error());
  std::vector<RigPicture> pictures;
  for (const RigPair& pair : *pairs) {
    auto picture = OpenPair(pair, options);
    if (!picture) return tl::unexpected(picture.error());
    pictures.push_back(*std::move(picture));
  }
  const auto found = LearnEngine(pictures, *written);
  if (!found) return tl::unexpected(found.error());
  const LearntEngine& engine = found->engine;
  console.Warn(found->warnings);
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  const auto text = EngineText(engine, GeneratorName(), options.output);
  if (!text) return tl::unexpected(text.error());
  if (!options.output.empty()) {
    if (auto done = WriteOutputs({{options.output, *text}}, options.force); !done) return done;
  }
  PrintEngine(engine, console);
  if (!options.output.empty()) console.Print("wrote " + options.output + "\n");
  Node document = EngineNode(engine);
  document.Put("file", Node::UnlessEmpty(options.output));
  console.PrintDocument(document);
  return {};
}

// ---- rig ----

Result<void> WriteRigs(const EngineOptions& options, Console& console) {
  PresetOptions preset;
  preset.spots = SpotForm::kCone;
  if (!options.files.empty()) {
    const auto text = ReadInputFile(options.files.front());
    if (!text) return tl::unexpected(text.error());
    auto engine = EngineFrom(*text, options.files.front());
    if (!engine) return Propagate(std::move(engine));
    preset.engine = std::make_shared<const LearntEngine>(*std::move(engine));
  }
  auto rigs = LearningRigs(options.target, preset, GeneratorName());
  if (!rigs) return Propagate(std::move(rigs));
  std::vector<OutputFile> files;
  for (PresetFile& file : *rigs) files.push_back({std::move(file.name), std::move(file.contents)});
  PlaceUnder(options.output, files);
  if (auto written = WriteOutputs(files, options.force); !written) return written;
  console.Print(WroteLine(files, options.output) +
                "\nRender each scene with its camera, save the picture by the scene's name beside "
                "it\n(point.rig.exr), and: lightcal engine learn " +
                options.output + " --to " + options.target + " --pixels ... -o mine.json\n");
  console.PrintDocument({{"files", PathsOf(files)}});
  return {};
}

}  // namespace

Run BuildEngine(CLI::App& parser) {
  auto options = std::make_shared<EngineOptions>();
  parser.require_subcommand(1);
  CLI::App* const learn = parser.add_subcommand(
      "learn", "Factors, cone law and turn of panoramas in pictures of rendered rigs");
  learn->fallthrough();
  learn
      ->add_option("files", options->files,
                   "Pairs: the STEM.preset.json of a rig that was exported, and its picture; or a "
                   "folder of them, alike in name")
      ->required();
  learn->add_option("-o,--output", options->output, "ENGINE.json, for export");
  learn
      ->add_option("--pixels", options->pixels,
                   "What a sample of an EXR is: exposed by the rig's exposure, cd/m2, or watts of "
                   "683 lm (Blender) [not known: ratios between kinds]")
      ->check(OneOf(kPixelWords));
  learn
      ->add_option("--to", options->target,
                   "The preset that was rendered; its cones are learnt from cards off the axis")
      ->check(OneOf(TargetWords()));
  learn->add_flag("--force", options->force, "Replace a file that lightcal did not write");
  CLI::App* const rig =
      parser.add_subcommand("rig", "Scenes to render: a lamp of each kind, cards about it");
  rig->fallthrough();
  rig->add_option("--to", options->target, "The preset to render")
      ->required()
      ->check(OneOf(TargetWords()));
  rig->add_option("-o,--output", options->output, "Directory of the scenes")
      ->required()
      ->check(DirectoryName());
  rig->add_option("--engine", options->files,
                  "With what was learnt undone, to see that it then renders right")
      ->expected(1);
  rig->add_flag("--force", options->force, "Replace files that lightcal did not write");
  return [options, rig](Console& console) {
    return rig->parsed() ? WriteRigs(*options, console) : Learn(*options, console);
  };
}

}  // namespace lightcal::app
