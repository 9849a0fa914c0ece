// SPDX-License-Identifier: Apache-2.0
#include "validate/validate_session.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "input_files.h"
#include "lightcal/calibrate/session_files.h"
#include "lightcal/records/session_codec.h"
#include "lightcal/records/session_reader.h"
#include "lightcal_devices/captures/bracket.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

struct NamedFile {
  std::string name;   // relative to the session, may be a wildcard
  std::string where;  // who names it
};

std::vector<NamedFile> FilesNamedBy(const Session& session) {
  std::vector<NamedFile> files;
  const auto add = [&](const std::string& name, const std::string& where) {
    if (!name.empty()) files.push_back({name, where});
  };
  for (const LightDescription& light : session.lights) add(light.distribution_file, light.name);
  VisitReadings(session,
                [&](const SessionReading& row) { add(row.reading.spectrum_file, row.where); });
  for (const CaptureDescription& capture : session.captures) {
    add(capture.frames, capture.where);
    add(capture.camera, capture.where);
    add(capture.spectrum_file, capture.where);
    if (!capture.wall) continue;
    add(capture.wall->board_frame, capture.where);
    add(capture.wall->board_views, capture.where);
    add(capture.wall->off_frames, capture.where);
  }
  return files;
}

std::optional<Error> FirstMissing(const Session& session) {
  for (const NamedFile& file : FilesNamedBy(session)) {
    const std::string pattern = PathInSession(session, file.name);
    if (devices::ExpandFiles(std::span(&pattern, 1))) continue;
    return Error{ErrorKind::kRefused, "not_found", file.where,
                 "names \"" + file.name + "\", which is not in " + session.directory +
                     "; put it there or correct the name"};
  }
  return std::nullopt;
}

// The first row that no fit would use becomes the error, the others stay warnings.
std::optional<Error> FirstBadRow(Warnings& warnings) {
  const auto bad = std::ranges::find(warnings, "bad_reading", &Warning::code);
  if (bad == warnings.end()) return std::nullopt;
  Error error{ErrorKind::kRefused, bad->code, bad->subject, bad->message};
  warnings.erase(bad);
  return error;
}

std::string ContentsOf(const Session& session) {
  // One of all lit lamps stands there once for each of them.
  std::set<std::string_view> rows;
  VisitReadings(session, [&](const SessionReading& row) { rows.insert(row.where); });
  std::string text =
      Counted(session.lights.size(), "light") + ", " + Counted(rows.size(), "reading");
  if (!session.captures.empty()) text += ", " + Counted(session.captures.size(), "capture");
  if (!session.camera_frames.empty()) {
    text += ", " + Counted(session.camera_frames.size(), "set") + " of camera frames";
  }
  return text;
}

// The session.toml or NAME.toml whose journal this is; "" = none lies there.
std::string SessionOfJournal(const fs::path& journal) {
  std::error_code error;
  std::string stem = journal.filename().string();
  stem.erase(std::min(stem.find('.'), stem.size()));
  for (const std::string& name : {std::string("session.toml"), stem + ".toml"}) {
    const fs::path toml = journal.parent_path() / name;
    if (!fs::is_regular_file(toml, error)) continue;
    const fs::path its_journal = JournalPath(toml.string());
    if (its_journal.filename() == journal.filename()) return toml.string();
  }
  return "";
}

void ValidateAlone(std::string_view text, FileVerdict& verdict) {
  std::size_t readings = 0;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    const std::string where =
        fs::path(verdict.path).filename().string() + ":" + std::to_string(number);
    const auto reading = ReadingFromJson(line, where);
    readings += reading ? 1 : 0;
    const bool torn = !reading && text.empty() && end == std::string_view::npos;
    if (torn) {
      verdict.warnings.push_back(
          {"torn_journal", where, "the last line stops in the middle and is ignored"});
    } else if (!reading && !verdict.error) {
      verdict.error = reading.error();
    }
  }
  verdict.holds = Counted(readings, "reading") + "; its session.toml is not beside it";
}

}  // namespace

std::string Counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

void ValidateSession(FileVerdict& verdict) {
  verdict.format = "session";
  auto loaded = LoadSession(verdict.path, InputSources().read_text);
  if (!loaded) {
    verdict.error = std::move(loaded).error();
    return;
  }
  verdict.version = "1";
  verdict.holds = ContentsOf(loaded->session);
  verdict.warnings = std::move(loaded->warnings);
  verdict.error = FirstBadRow(verdict.warnings);
  if (!verdict.error) verdict.error = FirstMissing(loaded->session);
}

void ValidateJournal(std::string_view text, FileVerdict& verdict) {
  verdict.format = "journal";
  const fs::path journal(verdict.path);
  const std::string session = SessionOfJournal(journal);
  if (session.empty()) {
    ValidateAlone(text, verdict);
    return;
  }
  auto loaded = LoadSession(session, InputSources().read_text);
  if (!loaded) {
    verdict.error = std::move(loaded).error();
    return;
  }
  const std::string prefix = journal.filename().string() + ":";
  for (Warning& warning : loaded->warnings) {
    if (warning.subject.starts_with(prefix)) verdict.warnings.push_back(std::move(warning));
  }
  const auto rows = std::ranges::count_if(loaded->session.readings, [&](const SessionReading& row) {
    return row.where.starts_with(prefix);
  });
  verdict.holds = Counted(static_cast<std::size_t>(rows), "reading");
  verdict.error = FirstBadRow(verdict.warnings);
}

}  // namespace lightcal::app
