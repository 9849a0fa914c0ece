// SPDX-License-Identifier: Apache-2.0
#include "taken_back.h"

#include <filesystem>
#include <functional>
#include <utility>

#include "input_files.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/printable.h"
#include "lightcal/records/journal.h"
#include "lightcal/records/session_codec.h"
#include "lightcal/records/session_reader.h"
#include "session_names.h"

namespace lightcal::app {
namespace {

// The journal's last reading that is meant.
Result<TakenBack> TakeBackMeant(const Session& session, const std::string& session_path,
                                const std::function<bool(const Reading&)>& meant) {
  const std::string journal = JournalPath(session_path);
  const std::string name = std::filesystem::path(journal).filename().string() + ":";
  std::optional<TakenBack> last;
  int last_line = 0;
  const auto look = [&](const auto& row) {
    if (!row.where.starts_with(name) || !meant(row.reading)) return;
    const int line = std::stoi(row.where.substr(name.size()));
    if (line >= last_line) last = TakenBack{row.where, row.reading}, last_line = line;
  };
  VisitReadings(session, look);
  for (const LitReading& row : session.lit_readings) look(row);
  if (!last) return Refused("nothing_to_undo", journal, "holds no such reading to take back");
  if (auto written = AppendUndoToJournal(journal, last_line); !written) {
    return Propagate(std::move(written));
  }
  return *std::move(last);
}

}  // namespace

std::string SayTakenBack(const Reading& reading) {
  const std::string lux =
      reading.illuminance ? " " + RoundedText(reading.illuminance->value(), 4) + " lx" : "";
  const std::string distance =
      reading.distance ? " at " + RoundedText(reading.distance->value(), 4) + " m" : "";
  const std::string state = reading.state.empty() ? "" : ", " + StateText(reading.state);
  return Printable(reading.light) + lux + distance + Printable(state);
}

Result<TakenBack> TakeBackLast(const std::string& session_path, const std::string& light,
                               Console& console) {
  const auto loaded = LoadSession(session_path, InputSources().read_text);
  if (!loaded) return tl::unexpected(loaded.error());
  console.Warn(loaded->warnings);
  if (!light.empty()) {
    if (auto named = CheckNames(loaded->session, light, ""); !named) {
      return Propagate(std::move(named));
    }
  }
  return TakeBackMeant(loaded->session, session_path, [&](const Reading& reading) {
    return light.empty() || reading.light == light;
  });
}

Result<TakenBack> TakeBackThis(const std::string& session_path, const Reading& reading) {
  const auto loaded = LoadSession(session_path, InputSources().read_text);
  if (!loaded) return tl::unexpected(loaded.error());
  // As the journal gives it back.
  const auto held = ReadingFromJson(ReadingToJson(reading), session_path);
  if (!held) return tl::unexpected(held.error());
  const std::string json = ReadingToJson(*held);
  return TakeBackMeant(loaded->session, session_path,
                       [&](const Reading& other) { return ReadingToJson(other) == json; });
}

}  // namespace lightcal::app
