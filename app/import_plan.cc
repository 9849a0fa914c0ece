// SPDX-License-Identifier: Apache-2.0
#include "import_plan.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <utility>

#include "input_files.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/records/session_codec.h"
#include "session_names.h"
#include "spectrum_csv.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

std::string FileNamePart(std::string_view name) {
  std::string part(name);
  std::ranges::replace_if(
      part, [](unsigned char c) { return c < 0x80 && std::isalnum(c) == 0; }, '_');
  return part;
}

// The captures of the session, those on the disk and those to come.
class Captures {
 public:
  explicit Captures(const Session& session) : directory_(session.directory) {}

  // Where the file lies relative to the session, "" when it lies elsewhere.
  [[nodiscard]] std::string InSession(const std::string& path) const {
    std::error_code error;
    const fs::path base = fs::weakly_canonical(directory_.empty() ? "." : directory_, error);
    const fs::path relative = fs::weakly_canonical(path, error).lexically_relative(base);
    const bool outside = error || relative.empty() || *relative.begin() == "..";
    return outside ? "" : relative.generic_string();
  }

  // captures/<name>, or with a part of its hash where other contents have that name already.
  std::string Add(const std::string& name, const std::string& contents) {
    const fs::path wanted(name);
    const std::string marked = wanted.stem().string() + "-" +
                               devices::Sha256Hex(contents).substr(0, 8) +
                               wanted.extension().string();
    for (const std::string& candidate : {name, marked}) {
      const std::string relative = "captures/" + candidate;
      const std::string path = (directory_ / relative).string();
      const auto planned = std::ranges::find(files_, path, &OutputFile::path);
      const bool taken_here = planned != files_.end() && planned->contents != contents;
      if (taken_here) continue;
      if (planned != files_.end()) return relative;
      const auto there = ReadOutput(path);
      if (there && *there == contents) return relative;
      if (there && candidate != marked) continue;
      files_.push_back({path, contents});
      return relative;
    }
    return "captures/" + marked;
  }
  [[nodiscard]] std::vector<OutputFile> Take() { return std::move(files_); }

 private:
  fs::path directory_;
  std::vector<OutputFile> files_;
};

// Readings the session holds, each as often as it holds it.
class HeldReadings {
 public:
  explicit HeldReadings(const Session& session) {
    VisitReadings(session,
                  [this](const SessionReading& row) { ++held_[ReadingToJson(row.reading)]; });
  }
  // Whether the session holds this reading of the file: the n-th alike, if it holds n of them.
  bool Holds(const std::string& json) { return ++in_file_[json] <= held_[json]; }
  // After a file the session holds what it held or what the file has, whichever is more.
  void EndFile() {
    for (const auto& [json, count] : in_file_) held_[json] = std::max(held_[json], count);
    in_file_.clear();
  }

 private:
  std::map<std::string, int> held_;
  std::map<std::string, int> in_file_;
};

class Planner {
 public:
  Planner(const Session& session, const ImportSettings& settings)
      : session_(session), settings_(settings), captures_(session), held_(session) {}

  Result<void> Add(const std::string& path) {
    NoteInput(path);
    auto imported = devices::ImportFile(path, settings_.table);
    if (!imported) return Propagate(std::move(imported));
    auto readings = ReadingsOf(path, *imported);
    if (!readings) return Propagate(std::move(readings));
    PlannedFile planned{path, imported->format, readings->size(), {}};
    for (Reading& reading : *readings) {
      if (auto completed = Complete(reading, path); !completed) return completed;
      const std::string json = ReadingToJson(reading);
      auto as_read_back = ReadingFromJson(json, path);
      if (!as_read_back) return Propagate(std::move(as_read_back));
      if (!settings_.again && held_.Holds(ReadingToJson(*as_read_back))) continue;
      planned.readings.push_back(std::move(*as_read_back));
    }
    held_.EndFile();
    Warn(planned, std::move(imported->warnings));
    plan_.files.push_back(std::move(planned));
    return {};
  }

  ImportPlan Finish() {
    plan_.captures = captures_.Take();
    return std::move(plan_);
  }

 private:
  void Warn(const PlannedFile& planned, Warnings warnings) {
    plan_.warnings.insert(plan_.warnings.end(), warnings.begin(), warnings.end());
    const std::size_t held = planned.found - planned.readings.size();
    if (held == 0) return;
    plan_.warnings.push_back({"already_imported", planned.path,
                              std::to_string(held) + " of " + std::to_string(planned.found) +
                                  " readings are in the session already and are not added again; "
                                  "--force adds them"});
  }

  Result<std::vector<Reading>> ReadingsOf(const std::string& path, ImportedFile& imported) {
    if (imported.spectra.empty()) {
      if (settings_.column.empty()) return imported.readings;
      return Refused("unknown_column", path, "holds no spectra, so --column means nothing for it");
    }
    std::size_t first = 0;
    std::size_t last = imported.spectra.size();
    if (!settings_.column.empty()) {
      auto index = FindSpectrum(imported, settings_.column);
      if (!index) {
        return Refused(index.error().code, path, settings_.column + ": " + index.error().message);
      }
      first = *index;
      last = first + 1;
      imported.warnings = WarningsAbout(imported, first);
    }
    std::vector<Reading> readings;
    for (std::size_t i = first; i < last; ++i) {
      auto reading = imported.readings[i];
      const Warnings about = WarningsAbout(imported, i);
      if (const Warning* const doubt = IlluminanceDoubt(about);
          doubt != nullptr && !settings_.color_only) {
        return Refused("illuminance_ambiguous", doubt->subject,
                       doubt->message + "; --color-only takes its colour alone");
      }
      auto capture = Capture(path, imported, i);
      if (!capture) return Propagate(std::move(capture));
      reading.spectrum_file = *capture;
      readings.push_back(std::move(reading));
    }
    return readings;
  }

  // Where the session keeps spectrum i.
  Result<std::string> Capture(const std::string& path, const ImportedFile& imported,
                              std::size_t i) {
    const ImportedSpectrum& one = imported.spectra[i];
    const fs::path source(path);
    const bool absolute = one.spectrum.quantity == SpectralQuantity::kIrradiance;
    const bool strip = settings_.color_only && absolute;
    // A table of which the line says something says too little of itself to who reads it later.
    const bool said = !settings_.table.columns.empty() ||
                      settings_.table.decimals != devices::DecimalSign::kUnsaid;
    if (imported.spectra.size() > 1 || strip || said) {
      const std::string part = one.name.empty() ? std::to_string(i + 1) : FileNamePart(one.name);
      const std::string name = source.stem().string() +
                               (imported.spectra.size() > 1 ? "-" + part : "") +
                               (strip ? "-color" : "") + ".csv";
      return captures_.Add(
          name, SpectrumCsv(one.spectrum, one.name + " of " + source.filename().string(), !strip));
    }
    if (std::string inside = captures_.InSession(path); !inside.empty()) return inside;
    const auto bytes = ReadInputFile(path);
    if (!bytes) return tl::unexpected(bytes.error());
    return captures_.Add(source.filename().string(), *bytes);
  }

  // Fills what the file leaves open, from the command line.
  Result<void> Complete(Reading& reading, const std::string& path) {
    if (auto known = CheckLightOfFile(reading.light); !known) return known;
    if (reading.light.empty()) reading.light = settings_.light;
    if (reading.light.empty() && session_.lights.size() == 1) {
      reading.light = session_.lights.front().name;
    }
    if (reading.light.empty()) {
      return Refused(
          "light_missing", path,
          "does not say which light it reads; add --light" + DidYouMean("", session_.lights));
    }
    if (reading.meter.empty()) reading.meter = settings_.meter;
    if (reading.state.empty()) reading.state = settings_.state;
    if (settings_.lamp_off) reading.lamp = LampState::kOff;
    if (settings_.shadow_card) reading.shadow_card = true;
    if (settings_.color_only) reading.illuminance.reset();
    if (auto named = CheckNames(session_, reading.light, reading.meter); !named) return named;
    if (auto fits = CheckState(session_, reading); !fits) return fits;
    return CheckDistance(reading, path);
  }

  // A column of fixtures may hold what the lamp is, not which it is.
  Result<void> CheckLightOfFile(const std::string& named) const {
    const bool one = !settings_.light.empty() || session_.lights.size() == 1;
    if (named.empty() || !one || FindLight(session_, named) != nullptr) return {};
    const std::string& meant =
        settings_.light.empty() ? session_.lights.front().name : settings_.light;
    return Refused("unknown_light", named,
                   "the session has no such light" + DidYouMean(named, session_.lights) +
                       "; if the column says what the lamp is and not which, leave it out, for "
                       "instance --columns -,distance_m,illuminance_lx: the rows are then of " +
                       meant);
  }

  Result<void> CheckDistance(Reading& reading, const std::string& path) const {
    if (!reading.illuminance) {
      const bool color = reading.cct || reading.xy || !reading.spectrum_file.empty();
      if (!color) return Refused("no_color", path, "has no colour; leave --color-only out");
      if (!reading.distance) reading.distance = settings_.distance;
      return {};
    }
    const LightKind kind = FindLight(session_, reading.light)->kind;
    const bool needs_none = kind == LightKind::kDirectional || kind == LightKind::kDome;
    if (reading.position_m) return {};
    if (!reading.distance) reading.distance = settings_.distance;
    if (reading.distance || needs_none) return {};
    return Refused("distance_missing", reading.light,
                   path +
                       " does not say how far the meter was from the lamp; add --distance 0.5m, "
                       "or columns position_x_m, position_y_m and position_z_m of the meter's "
                       "place, or --color-only to take its colour alone");
  }

  const Session& session_;
  const ImportSettings& settings_;
  Captures captures_;
  HeldReadings held_;
  ImportPlan plan_;
};

}  // namespace

Result<ImportPlan> PlanImport(const Session& session, const std::vector<std::string>& files,
                              const ImportSettings& settings) {
  Planner planner(session, settings);
  for (const std::string& path : files) {
    if (auto added = planner.Add(path); !added) return Propagate(std::move(added));
  }
  return planner.Finish();
}

}  // namespace lightcal::app
