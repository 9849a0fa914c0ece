// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

#include "lightcal/records/field_reader.h"
#include "lightcal/records/json_codec.h"
#include "lightcal/records/reading_codec.h"
#include "lightcal/records/session_reader.h"
#include "lightcal/records/session_toml.h"
#include "lightcal/records/shot_captures.h"

namespace lightcal {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSessionFile = "session.toml";
constexpr std::string_view kJournalFile = "readings.jsonl";
constexpr std::string_view kCapturesFolder = "captures";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

struct SessionPaths {
  fs::path toml;
  fs::path journal;
  fs::path captures;
  fs::path directory;
  std::string stem;
};

std::string NameOfDirectory(const fs::path& directory) {
  std::error_code error;
  const fs::path whole = fs::absolute(directory, error).lexically_normal();
  const fs::path name = whole.has_filename() ? whole.filename() : whole.parent_path().filename();
  return name.empty() ? "session" : name.string();
}

SessionPaths PathsOf(const std::string& path) {
  const fs::path given(path);
  std::error_code error;
  if (fs::is_directory(given, error)) {
    return {given / kSessionFile, given / kJournalFile, given / kCapturesFolder, given,
            NameOfDirectory(given)};
  }
  const fs::path directory = given.has_parent_path() ? given.parent_path() : fs::path(".");
  if (given.filename() == kSessionFile) {
    return {given, directory / kJournalFile, directory / kCapturesFolder, directory,
            NameOfDirectory(directory)};
  }
  const std::string stem = given.stem().string();
  return {given, directory / (stem + "." + std::string(kJournalFile)),
          directory / (stem + "." + std::string(kCapturesFolder)), directory, stem};
}

Result<std::string> ReadWhole(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.is_open() || stream.bad()) {
    return Failed("unreadable", path, "cannot be read as a file");
  }
  return text;
}

Result<std::string> ReadRegular(const fs::path& path, const TextReader& read) {
  std::error_code error;
  if (fs::is_regular_file(path, error)) {
    if (auto text = read(path.string())) return text;
  }
  return Failed("unreadable", path.string(), "cannot be read as a file");
}

Result<std::string> ReadSessionFile(const SessionPaths& paths, const std::string& given,
                                    const TextReader& read) {
  std::error_code error;
  if (fs::exists(paths.toml, error)) return ReadRegular(paths.toml, read);
  const bool hidden = error == std::errc::permission_denied;
  const bool directory = fs::is_directory(given, error);
  if (hidden || (directory && MayNotLookInto(given))) {
    return Failed("no_permission", paths.directory.string(),
                  "this user may not look into the directory; give read and search permission "
                  "(chmod u+rx), or run as the user who owns it");
  }
  if (directory) {
    return Failed("not_found", given,
                  "no session.toml in this directory; create one that begins with lightcal = 1 "
                  "and describes a [[light]] with name and kind");
  }
  return Failed("not_found", given,
                "no such session; give a directory that holds a session.toml, or a .toml file");
}

// Takes the rows of a journal into a session.
class JournalReader {
 public:
  JournalReader(LoadedSession& loaded, std::string file_name)
      : loaded_(loaded), file_name_(std::move(file_name)) {}

  void Read(std::string_view text) {
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    for (int number = 1; !text.empty(); ++number) {
      const std::size_t end = text.find('\n');
      const bool closed = end != std::string_view::npos;
      std::string_view line = text.substr(0, end);
      text.remove_prefix(closed ? end + 1 : text.size());
      if (line.ends_with('\r')) line.remove_suffix(1);
      const bool blank = line.find_first_not_of(" \t") == std::string_view::npos;
      if (!blank) ReadLine(line, number, closed, text.empty());
    }
  }

 private:
  static constexpr double kMostLines = 2e9;

  void ReadLine(std::string_view line, int number, bool closed, bool last) {
    const std::string where = file_name_ + ":" + std::to_string(number);
    if (const auto undone = UndoneLine(line)) return TakeBack(*undone, where);
    number_ = number;
    records::LitKeys keys;
    auto reading = records::ReadingFromLine(line, where, keys);
    if (reading && keys.given) {
      TakeLitReading(*std::move(reading), std::move(keys), where);
    } else if (reading) {
      TakeReading(*std::move(reading), where);
    } else if (last && (reading.error().torn || (!closed && reading.error().syntax))) {
      WarnTorn(where);
    } else {
      Reject(where, reading.error().error.message);
    }
  }

  // The line that this one takes back, 0 for the last reading; absent where it is no such line.
  static std::optional<int> UndoneLine(std::string_view line) {
    if (line.find("undo") == std::string_view::npos) return std::nullopt;
    const auto node = records::ParseJson(line);
    if (!node || node->members.size() != 1) return std::nullopt;
    const records::Node* const undo = node->Find("undo");
    if (undo == nullptr) return std::nullopt;
    if (undo->kind == records::Node::Kind::kBoolean && undo->boolean) return 0;
    const bool counts = undo->IsNumber() && undo->number >= 1.0 && undo->number <= kMostLines &&
                        undo->number == std::floor(undo->number);
    return counts ? std::optional(static_cast<int>(undo->number)) : std::nullopt;
  }

  void TakeBack(int line, const std::string& where) {
    const auto taken = line == 0 ? taken_.empty() ? taken_.end() : taken_.end() - 1
                                 : std::ranges::find(taken_, line, &Taken::line);
    if (taken == taken_.end()) {
      return Reject(where, line == 0 ? "there is no reading above it to take back"
                                     : "line " + std::to_string(line) +
                                           " holds no reading that it could take back");
    }
    // Of its own kind as many stand behind it in the session as in the journal.
    const auto behind = std::count_if(taken + 1, taken_.end(),
                                      [&](const Taken& one) { return one.lit == taken->lit; });
    Session& session = loaded_.session;
    if (taken->lit) {
      session.lit_readings.erase(session.lit_readings.end() - 1 - behind);
    } else {
      session.readings.erase(session.readings.end() - 1 - behind);
    }
    taken_.erase(taken);
  }

  void TakeReading(Reading reading, const std::string& where) {
    if (reading.light.empty()) {
      Reject(where, "light is missing");
    } else if (const auto strange = records::FindStrangeName(loaded_.session, reading)) {
      Reject(where, strange->message);
    } else {
      loaded_.session.readings.push_back({std::move(reading), where});
      taken_.push_back({number_, false});
    }
  }

  void TakeLitReading(Reading reading, records::LitKeys keys, const std::string& where) {
    if (const auto strange = records::FindStrangeName(loaded_.session, reading, keys)) {
      Reject(where, strange->message);
    } else {
      loaded_.session.lit_readings.push_back(
          {std::move(reading), where, std::move(keys.lit), std::move(keys.distances)});
      taken_.push_back({number_, true});
    }
  }

  void Reject(const std::string& where, const std::string& reason) {
    loaded_.warnings.push_back({"bad_reading", where, reason + "; this row is not used"});
  }

  void WarnTorn(const std::string& where) {
    loaded_.warnings.push_back(
        {"torn_journal", where,
         "the last line stops in the middle, as after a crash; it is ignored. Take that reading "
         "again if it matters"});
  }

  LoadedSession& loaded_;
  std::string file_name_;
  struct Taken {
    int line = 0;
    bool lit = false;  // of several lamps
  };
  std::vector<Taken> taken_;  // of the journal's readings, in their order
  int number_ = 0;            // of the line that is read
};

}  // namespace

std::string JournalPath(const std::string& session_path) {
  return PathsOf(session_path).journal.string();
}

bool MayNotLookInto(const std::string& directory) {
  std::error_code error;
  if (fs::exists(fs::path(directory) / kSessionFile, error)) return false;
  if (error == std::errc::permission_denied) return true;
  fs::directory_iterator(directory, error);
  return error == std::errc::permission_denied;
}

std::string CapturesPath(const std::string& session_path) {
  return PathsOf(session_path).captures.string();
}

Result<LoadedSession> LoadSession(const std::string& path) { return LoadSession(path, ReadWhole); }

Result<LoadedSession> LoadSession(const std::string& path, const TextReader& read) {
  const SessionPaths paths = PathsOf(path);
  const auto text = ReadSessionFile(paths, path, read);
  if (!text) return tl::unexpected(text.error());
  auto loaded = records::ParseSession(*text, paths.toml.filename().string());
  if (!loaded) return loaded;
  Session& session = loaded->session;
  session.directory = paths.directory.string();
  session.stem = paths.stem;
  if (session.name.empty()) session.name = paths.stem;
  session.input_files.push_back(paths.toml.string());
  if (auto added = records::AddShotCaptures(paths.captures, read, *loaded); !added) {
    return Propagate(std::move(added));
  }
  std::error_code error;
  if (fs::exists(paths.journal, error)) {
    const auto journal = ReadRegular(paths.journal, read);
    if (!journal) return tl::unexpected(journal.error());
    session.input_files.push_back(paths.journal.string());
    JournalReader(*loaded, paths.journal.filename().string()).Read(*journal);
  }
  SpreadLitReadings(session);
  if (auto split = SplitStates(session); !split) return Propagate(std::move(split));
  return loaded;
}

}  // namespace lightcal
