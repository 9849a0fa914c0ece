// SPDX-License-Identifier: Apache-2.0
// lightcal lights: a folder of fitted lights, to search and to look at.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "commands.h"
#include "lamp_words.h"
#include "library/light_library.h"
#include "library/light_search.h"
#include "light_input.h"
#include "light_summary.h"
#include "light_table.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/printable.h"
#include "lightcal/presets/light_distribution.h"
#include "lightcal/records/light_codec.h"
#include "lightcal/report/contact_sheet.h"
#include "output_files.h"
#include "picture_file.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;
struct LightsOptions {
  std::string library;
  SearchWords search;
  std::vector<std::string> inputs;  // of add
  std::string as;                   // of add
  std::string name;                 // of show, remove and rename
  std::string output, title;        // of sheet
  bool force = false;
};

Result<std::string> LibraryOf(const LightsOptions& options) {
  return options.library.empty() ? DefaultLibrary() : options.library;
}

Result<std::vector<LibraryLight>> Found(const LightsOptions& options, Console& console) {
  const auto folder = LibraryOf(options);
  if (!folder) return tl::unexpected(folder.error());
  Warnings warnings;
  auto lights = LightsInFolder(*folder, warnings);
  console.Warn(warnings);
  if (!lights) return lights;
  return Search(*std::move(lights), options.search);
}

Node LibraryNode(const LibraryLight& entry) {
  Node node = LightSummary(entry.light);
  node.Put("file", entry.path);
  node.Put("time", Node::UnlessEmpty(entry.provenance.time));
  return node;
}

// "2026-05-01" of an ISO 8601 time.
std::string DayOf(const std::string& time) { return time.substr(0, time.find('T')); }

std::string Table(const std::vector<LibraryLight>& lights) {
  std::vector<std::vector<std::string>> rows;
  for (const LibraryLight& entry : lights) {
    const FittedLight& light = entry.light;
    const auto& cct = light.color.cct_K;
    const std::string day = DayOf(entry.provenance.time);
    rows.push_back({light.name, std::string(LightKindName(light.kind)), Headline(light),
                    light.flux_lm ? ValueAndInterval(*light.flux_lm, "lm") : kNone,
                    cct ? KelvinText(*cct) : kNone, day.empty() ? kNone : day,
                    fs::path(entry.path).filename().string()});
  }
  return TextTable({"light", "kind", "intensity (95 %)", "flux", "CCT", "measured", "file"}, rows);
}

Result<void> List(const LightsOptions& options, Console& console) {
  const auto lights = Found(options, console);
  if (!lights) return tl::unexpected(lights.error());
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  console.Print(lights->empty() ? "no light fits\n" : Table(*lights));
  console.PrintDocument({{"lights", Node::List(*lights, LibraryNode)}});
  return {};
}

Result<void> Add(const LightsOptions& options, Console& console) {
  const auto folder = LibraryOf(options);
  if (!folder) return tl::unexpected(folder.error());
  std::vector<LightFile> files;
  std::size_t count = 0;
  for (const std::string& input : options.inputs) {
    auto file = LightsIn(input);
    if (!file) return Propagate(std::move(file));
    count += file->lights.size();
    files.push_back(*std::move(file));
  }
  if (!options.as.empty()) {
    if (count != 1) {
      return WrongUsage(
          "--as", "names one light, these are " + std::to_string(count) + "; add them one by one");
    }
    files.front().lights.front().name = options.as;
  }
  std::vector<std::string> written;
  for (const LightFile& file : files) {
    const auto paths = AddToLibrary(file, *folder);
    if (!paths) return tl::unexpected(paths.error());
    for (const std::string& path : *paths) {
      written.push_back(path);
      console.Print("wrote " + path + "\n");
    }
  }
  console.PrintDocument({{"files", written}});
  return {};
}

// The one light of that name; a part of a name serves where it is one light's only.
Result<LibraryLight> OneCalled(const std::string& name, std::vector<LibraryLight> lights) {
  std::vector<LibraryLight> exact;
  for (const LibraryLight& entry : lights) {
    const bool by_file = fs::path(entry.path).stem() == name || entry.path == name;
    if (entry.light.name == name || by_file) exact.push_back(entry);
  }
  if (exact.empty()) {
    SearchWords words;
    words.name = name;
    auto matching = Search(std::move(lights), words);
    if (!matching) return Propagate(std::move(matching));
    exact = *std::move(matching);
  }
  if (exact.size() == 1) return exact.front();
  if (exact.empty()) {
    return Refused("unknown_light", name, "no light is called so; lightcal lights list shows all");
  }
  const std::string files = Joined(
      exact, ", ", [](const LibraryLight& entry) { return fs::path(entry.path).stem().string(); });
  return Refused("several_lights", name,
                 "is found in several (" + files + "): give the name of one");
}

Result<void> Show(const LightsOptions& options, Console& console) {
  auto lights = Found(options, console);
  if (!lights) return Propagate(std::move(lights));
  const auto entry = OneCalled(options.name, *std::move(lights));
  if (!entry) return tl::unexpected(entry.error());
  const LightFile file{{entry->light}, entry->provenance};
  if (const auto json = LightFileToJson(file); !json) return tl::unexpected(json.error());
  console.Print(LightTable(file) + "\n" + FitTable(file) + "\n" + BudgetTable(entry->light));
  for (const InputFile& input : entry->provenance.inputs) {
    console.Print("from " + input.path + "\n");
  }
  console.Print("file " + entry->path + "\n");
  Node document = DocumentOf(file);
  document.Put("file", entry->path);
  console.PrintDocument(document);
  return {};
}

// By its whole name or its file's: a part is enough to look at a light, not to take it away.
Result<LibraryLight> ExactlyCalled(const std::string& name,
                                   const std::vector<LibraryLight>& lights) {
  auto entry = OneCalled(name, lights);
  if (!entry) return entry;
  const bool exact =
      entry->light.name == name || entry->path == name || fs::path(entry->path).stem() == name;
  if (exact) return entry;
  return Refused("unknown_light", name,
                 "no light is called just so; did you mean \"" + Printable(entry->light.name) +
                     "\" (" + fs::path(entry->path).stem().string() + ")?");
}

Result<void> Remove(const LightsOptions& options, Console& console) {
  const auto lights = Found(options, console);
  if (!lights) return tl::unexpected(lights.error());
  const auto entry = ExactlyCalled(options.name, *lights);
  if (!entry) return tl::unexpected(entry.error());
  if (auto removed = RemoveFromLibrary(*entry, *lights); !removed) return removed;
  console.Print("removed " + entry->path + "\n");
  console.PrintDocument({{"removed", std::vector{entry->path}}});
  return {};
}

Result<void> Rename(const LightsOptions& options, Console& console) {
  const auto lights = Found(options, console);
  if (!lights) return tl::unexpected(lights.error());
  const auto entry = ExactlyCalled(options.name, *lights);
  if (!entry) return tl::unexpected(entry.error());
  if (auto free = RefuseTakenName(*entry, options.as, *lights); !free) return free;
  LightFile renamed{{entry->light}, entry->provenance};
  renamed.lights.front().name = options.as;
  const auto written = AddToLibrary(renamed, fs::path(entry->path).parent_path().string());
  if (!written) return tl::unexpected(written.error());
  if (auto removed = RemoveFromLibrary(*entry, *lights); !removed) return removed;
  console.Print(entry->path + " is " + written->front() + " now\n");
  console.PrintDocument({{"removed", std::vector{entry->path}}, {"files", *written}});
  return {};
}

std::string NoteOf(const LibraryLight& entry) {
  const std::string day = DayOf(entry.provenance.time);
  const std::string file = fs::path(entry.path).filename().string();
  return day.empty() ? file : day + " · " + file;
}

Result<OutputFile> SheetFile(const LightsOptions& options,
                             const std::vector<report::SheetLight>& lights) {
  const std::string ending = LowerAscii(fs::path(options.output).extension().string());
  if (ending == ".html") {
    return OutputFile{options.output, report::ContactSheetPage(lights, options.title)};
  }
  if (auto named = CheckPictureName("-o", options.output); !named) {
    return WrongUsage("-o", "\"" + options.output + "\" must end in .html, .svg or .png");
  }
  return PictureFile(options.output, report::ContactSheetSvg(lights, options.title));
}

// A spot whose cone nobody told would be drawn as a point.
Result<std::optional<IntensityTable>> KnownDistribution(const FittedLight& light) {
  if (light.kind == LightKind::kSpot && !light.outer_deg) return std::nullopt;
  return DistributionOf(light);
}

Result<void> Sheet(const LightsOptions& options, Console& console) {
  const auto lights = Found(options, console);
  if (!lights) return tl::unexpected(lights.error());
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  if (lights->empty()) {
    return Refused("no_lights", "sheet", "no light fits; lightcal lights list shows all");
  }
  std::vector<report::SheetLight> tiles;
  for (const LibraryLight& entry : *lights) {
    auto distribution = KnownDistribution(entry.light);
    if (!distribution) return Propagate(std::move(distribution));
    tiles.push_back({entry.light, *std::move(distribution), NoteOf(entry)});
  }
  auto sheet = SheetFile(options, tiles);
  if (!sheet) return Propagate(std::move(sheet));
  if (auto written = WriteOutputs({*sheet}, options.force); !written) return written;
  console.Print("wrote " + sheet->path + "\n");
  console.PrintDocument({{"files", std::vector{sheet->path}}, {"lights", tiles.size()}});
  return {};
}

void AddSearch(CLI::App& verb, SearchWords& search) {
  verb.add_option("--cct", search.cct, "Colour temperature: 3000..3500, 5000.. (K)")
      ->type_name("RANGE");
  verb.add_option("--lm", search.lm, "Flux: 500.., 100..800 (lm)")->type_name("RANGE");
  verb.add_option("--cd", search.cd, "Intensity: 1000.. (cd)")->type_name("RANGE");
  verb.add_option("--lx", search.lx, "Illuminance of directional lights and domes (lx)")
      ->type_name("RANGE");
  verb.add_option("--kind", search.kind, "point, spot, rect ...");
  verb.add_option("name,--name", search.name, "Part of the name or of the file's name");
  verb.add_option("--sort", search.sort,
                  "name, kind, cct, lm, cd, lx or time; -cd: largest first [name]");
}

}  // namespace

Run BuildLights(CLI::App& parser) {
  auto options = std::make_shared<LightsOptions>();
  auto run = std::make_shared<Result<void> (*)(const LightsOptions&, Console&)>(&List);
  parser.add_option("--library", options->library,
                    "Folder of light.json files [~/.local/share/lightcal/lights]");
  const auto verb = [&](const char* name, const char* summary,
                        Result<void> (*what)(const LightsOptions&, Console&)) {
    CLI::App* const sub = parser.add_subcommand(name, summary);
    sub->fallthrough();
    sub->final_callback([run, what] { *run = what; });
    return sub;
  };
  AddSearch(*verb("list", "The lights that fit, one a line", &List), options->search);
  CLI::App* const add = verb("add", "Copies lights into the library", &Add);
  add->add_option("lights", options->inputs, "light.json files, presets, sessions that were run")
      ->required();
  add->add_option("--as", options->as, "The name the light is to have there");
  CLI::App* const show = verb("show", "All that is known of one light", &Show);
  show->add_option("name", options->name, "Its name, its file's, or a part that is no other's")
      ->required();
  CLI::App* const remove = verb("remove", "Takes one light out of the library", &Remove);
  remove->add_option("name", options->name, "Its name or its file's")->required();
  CLI::App* const rename = verb("rename", "Gives one light another name", &Rename);
  rename->add_option("name", options->name, "Its name or its file's")->required();
  rename->add_option("new_name", options->as, "The name it is to have")->required();
  CLI::App* const sheet = verb("sheet", "A contact sheet: a tile for each light", &Sheet);
  AddSearch(*sheet, options->search);
  sheet->add_option("-o,--output", options->output, "sheet.html, .svg or .png")->required();
  sheet->add_option("--title", options->title, "Heading of the sheet")
      ->default_str("Lights")
      ->capture_default_str();
  sheet->add_flag("--force", options->force, "Replace a file that lightcal did not write");
  options->title = "Lights";
  parser.require_subcommand(0, 1);
  return [options, run](Console& console) { return (*run)(*options, console); };
}

}  // namespace lightcal::app
