// SPDX-License-Identifier: Apache-2.0
// lightcal import: what instruments export, into a session's journal.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <string_view>

#include "commands.h"
#include "distribution_plan.h"
#include "gdtf_import.h"
#include "import_plan.h"
#include "input_files.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal/records/journal.h"
#include "lightcal/records/session_codec.h"
#include "lightcal/records/session_reader.h"
#include "lightcal_devices/captures/raw.h"
#include "one_of.h"

namespace lightcal::app {
namespace {

constexpr std::size_t kShownReadings = 20;  // rows of the table; --json lists them all

constexpr std::array<std::string_view, 2> kDecimalWords = {"point", "comma"};

struct ImportOptions {
  std::vector<std::string> files;
  std::string session;
  std::string distance;
  std::string state;
  std::string decimals;
  ImportSettings settings;
};

std::string Cell(const std::optional<double>& value, int digits, const char* unit) {
  return value ? RoundedText(*value, digits) + unit : "";
}
template <class Quantity>
std::optional<double> ValueOf(const std::optional<Quantity>& quantity) {
  return quantity ? std::optional(quantity->value()) : std::nullopt;
}

std::string PlaceText(const Vec3& at) {
  return Joined(at, ", ", [](double metres) { return RoundedText(metres, 3); }) + " m";
}

std::string ReadingsTable(const ImportPlan& plan) {
  std::vector<std::vector<std::string>> rows;
  std::size_t more = 0;
  for (const PlannedFile& file : plan.files) {
    for (const Reading& reading : file.readings) {
      if (rows.size() == kShownReadings) {
        ++more;
        continue;
      }
      rows.push_back({file.path, file.format, reading.light,
                      reading.position_m ? PlaceText(*reading.position_m)
                                         : Cell(ValueOf(reading.distance), 4, " m"),
                      Cell(ValueOf(reading.illuminance), 4, " lx"),
                      Cell(ValueOf(reading.cct), 4, " K"),
                      reading.duv ? DuvText(*reading.duv) : std::string(), reading.spectrum_file});
    }
  }
  std::string text = TextTable(
      {"file", "format", "light", "distance or place", "illuminance", "CCT", "Duv", "spectrum"},
      rows);
  if (more > 0) text += "... and " + std::to_string(more) + " more\n";
  return text;
}

Node ToJson(const ImportPlan& plan, const std::string& journal,
            const std::vector<PlannedDistribution>& distributions) {
  std::vector<Node> readings;
  for (const PlannedFile& file : plan.files) {
    for (const Reading& reading : file.readings) readings.push_back(DocumentOf(reading));
  }
  const auto file_node = [](const PlannedFile& file) -> Node {
    return {{"file", file.path},
            {"format", file.format},
            {"readings", file.found},
            {"imported", file.readings.size()}};
  };
  const auto distribution_node = [](const PlannedDistribution& one) -> Node {
    return {{"light", one.light},
            {"flux_lm", one.flux_lm},
            {"peak_cd", one.peak_cd},
            {"written", !one.files.empty()}};
  };
  return {{"journal", journal},
          {"files", Node::List(plan.files, file_node)},
          {"imported", readings.size()},
          {"readings", readings},
          {"distributions", Node::UnlessEmpty(Node::List(distributions, distribution_node))}};
}

std::size_t CountReadings(const ImportPlan& plan) {
  std::size_t count = 0;
  for (const PlannedFile& file : plan.files) count += file.readings.size();
  return count;
}

// All readings or none.
Result<void> AppendAll(const ImportPlan& plan, const std::string& journal) {
  std::vector<Reading> all;
  for (const PlannedFile& file : plan.files) {
    all.insert(all.end(), file.readings.begin(), file.readings.end());
  }
  return AppendToJournal(journal, all);
}

Result<ImportSettings> SettingsOf(const ImportOptions& options) {
  ImportSettings settings = options.settings;
  if (!options.decimals.empty()) {
    settings.table.decimals = options.decimals == kDecimalWords.front()
                                  ? devices::DecimalSign::kPoint
                                  : devices::DecimalSign::kComma;
  }
  if (!options.state.empty()) {
    auto state = ParseFixtureState(options.state);
    if (!state) return Propagate(std::move(state));
    settings.state = *std::move(state);
  }
  if (options.distance.empty()) return settings;
  auto distance = ParseLength(options.distance);
  if (!distance) return Propagate(std::move(distance));
  if (distance->value() <= 0.0) {
    return Refused("bad_distance", options.distance, "a distance is above 0, e.g. 0.5m or 20in");
  }
  settings.distance = *distance;
  return settings;
}

// Photometric files describe a light and hold no reading; they go beside the journal.
Result<std::vector<PlannedDistribution>> PlanDistributions(const Session& session,
                                                           const ImportOptions& options,
                                                           Console& console) {
  std::vector<PlannedDistribution> plans;
  for (const std::string& path : options.files) {
    if (!IsPhotometricName(path)) continue;
    auto plan = PlanDistribution(session, path, options.settings.light);
    if (!plan) return Propagate(std::move(plan));
    console.Warn(plan->warnings);
    plans.push_back(std::move(*plan));
  }
  return plans;
}

// Fixtures are told, not written: what of them a session uses its person pastes.
Result<void> TellFixtures(const ImportOptions& options, Console& console) {
  Node fixtures = Node::Array();
  for (const std::string& path : options.files) {
    if (!IsGdtfName(path)) {
      return WrongUsage(path, "is no .gdtf as the others are; import it by itself");
    }
    if (!fixtures.items.empty()) console.Print("\n");
    auto told = TellGdtf(path, console);
    if (!told) return Propagate(std::move(told));
    fixtures.items.push_back(*std::move(told));
  }
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  console.PrintDocument({{"fixtures", std::move(fixtures)}});
  return {};
}

// Pictures are no readings: a session names them, and its fit reads them.
Result<void> CheckNoPictures(const ImportOptions& options) {
  constexpr std::array kRendered = {".exr", ".hdr",  ".pic",  ".jpg",  ".jpeg", ".png",
                                    ".tif", ".tiff", ".heic", ".webp", ".avif", ".dpx"};
  for (const std::string& path : options.files) {
    const std::string name = LowerAscii(path);
    const bool rendered = std::ranges::any_of(
        kRendered, [&](std::string_view extension) { return name.ends_with(extension); });
    if (!rendered && !devices::LooksLikeRaw(path)) continue;
    const std::filesystem::path file(path);
    const std::string light = options.settings.light.empty() ? "key" : options.settings.light;
    return Refused(
        "picture_file", path,
        "is a picture and no meter's file. Put the frames beside session.toml and name them there, "
        "for instance of a grey card:\n  [[capture]]\n  light = \"" +
            light + "\"\n  frames = \"captures/*" + file.extension().string() +
            "\"\n  use = \"card\"          # or source (the lamp itself), wall, ball, dome\n"
            "  reflectance = 0.18\n  distance_m = 1.0\n`lightcal fit` then reads them; `lightcal "
            "merge` makes one picture in cd/m2 of a bracket, `lightcal dome` lamps of a panorama");
  }
  return {};
}

Result<void> RunImport(const ImportOptions& options, Console& console) {
  if (auto readable = CheckNoPictures(options); !readable) return readable;
  if (std::ranges::any_of(options.files, IsGdtfName)) return TellFixtures(options, console);
  if (options.session.empty()) {
    return WrongUsage("--session", "is required: the session directory or .toml file to add to");
  }
  const auto settings = SettingsOf(options);
  if (!settings) return tl::unexpected(settings.error());
  const auto loaded = LoadSession(options.session, InputSources().read_text);
  if (!loaded) return tl::unexpected(loaded.error());
  console.Warn(loaded->warnings);
  const auto distributions = PlanDistributions(loaded->session, options, console);
  if (!distributions) return tl::unexpected(distributions.error());
  std::vector<std::string> with_readings = options.files;
  std::erase_if(with_readings, IsPhotometricName);
  const auto plan = PlanImport(loaded->session, with_readings, *settings);
  if (!plan) return tl::unexpected(plan.error());
  console.Warn(plan->warnings);
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  const std::string journal = JournalPath(options.session);
  for (const PlannedDistribution& one : *distributions) {
    if (auto written = WriteOutputs(one.files, settings->again); !written) return written;
    console.Note(one.light + ": " + RoundedText(one.flux_lm, 4) + " lm, peak " +
                 RoundedText(one.peak_cd, 4) + " cd" +
                 (one.files.empty() ? ", in the session already" : ""));
  }
  if (auto written = WriteOutputs(plan->captures, false); !written) return written;
  if (auto appended = AppendAll(*plan, journal); !appended) return appended;
  const std::size_t count = CountReadings(*plan);
  if (count > 0) console.Print(ReadingsTable(*plan));
  console.PrintDocument(ToJson(*plan, journal, *distributions));
  if (with_readings.empty()) return {};
  console.Note(count == 0 ? "nothing new; " + journal + " is unchanged"
                          : std::to_string(count) + (count == 1 ? " reading" : " readings") +
                                " appended to " + journal);
  return {};
}

}  // namespace

Run BuildImport(CLI::App& parser) {
  auto options = std::make_shared<ImportOptions>();
  ImportSettings& settings = options->settings;
  parser
      .add_option("files", options->files,
                  "Sekonic, UPRtek, JETI, TM-27, Argyll, ActLumus exports or CSV with units in "
                  "the column names; a .zip of one; .ies and .ldt as the light's distribution; "
                  ".gdtf: what a fixture's file says, and its [[light]] to paste")
      ->required();
  parser.add_option("-s,--session", options->session,
                    "Session directory or .toml file; a .gdtf needs none");
  parser.add_option("-l,--light", settings.light, "Which light was read, unless the file names it");
  parser.add_option("-d,--distance", options->distance,
                    "From the lamp to the meter (0.5m, 20in), unless the file gives it");
  parser.add_option("-m,--meter", settings.meter, "Which [[meter]] of the session read it");
  parser.add_option("--state", options->state,
                    "What the fixture's controls said, unless the file says it: "
                    "dimmer=50,cct_K=4000 (any names)");
  parser
      .add_option("--columns", settings.table.columns,
                  "What a table's columns are, in their order, whatever its header says: "
                  "distance_m,illuminance_lx; - leaves one out; blanks may part them (.dat, .prn)")
      ->delimiter(',');
  parser
      .add_option("--decimals", options->decimals,
                  "What parts decimals in a table whose numbers leave it open (8,120)")
      ->check(OneOf(kDecimalWords));
  parser.add_option("--column", settings.column, "One spectrum of several: its name or number");
  parser.add_flag("--color-only", settings.color_only,
                  "Take the colour and leave the illuminance, which needs a distance");
  auto* off = parser.add_flag("--lamp-off", settings.lamp_off, "Read with the lamp switched off");
  parser.add_flag("--shadow-card", settings.shadow_card, "Read with the direct beam blocked")
      ->excludes(off);
  parser.add_flag("--force", settings.again, "Add readings the session holds already again");
  return [options](Console& console) { return RunImport(*options, console); };
}

}  // namespace lightcal::app
