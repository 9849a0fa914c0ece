// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/shot_captures.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "lightcal/records/session_toml.h"
#include "lightcal/records/tethered_shoot.h"

namespace lightcal::records {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> RecordsBelow(const fs::path& captures) {
  std::vector<fs::path> records;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(captures, error)) {
    const fs::path record = entry.path() / kTetheredShootFile;
    std::error_code ignored;
    if (fs::is_regular_file(record, ignored)) records.push_back(record);
  }
  std::ranges::sort(records);
  return records;
}

bool PersonDescribes(const Session& session, const fs::path& folder) {
  const auto normal = [](const fs::path& path) { return path.lexically_normal(); };
  return std::ranges::any_of(session.captures, [&](const CaptureDescription& capture) {
    return normal(fs::path(capture.frames).parent_path()) == normal(folder);
  });
}

std::string HowFar(const TetheredShoot& shoot) {
  const auto taken = std::ranges::count_if(
      shoot.frames, [](const ShotFrame& frame) { return !frame.file.empty(); });
  return std::to_string(taken) + " of " + std::to_string(shoot.frames.size()) + " frames";
}

Result<void> AddOne(const fs::path& record, const TextReader& read, LoadedSession& loaded) {
  Session& session = loaded.session;
  const auto text = read(record.string());
  if (!text) return Failed("unreadable", record.string(), "cannot be read as a file");
  const fs::path folder = record.parent_path().lexically_proximate(session.directory);
  const std::string where = (folder / kTetheredShootFile).generic_string();
  auto shoot = TetheredShootFromJson(*text, where);
  if (!shoot) return Propagate(std::move(shoot));
  if (PersonDescribes(session, folder)) return {};
  if (!shoot->complete) {
    loaded.warnings.push_back(
        {"unfinished_capture", folder.generic_string(),
         "broken off after " + HowFar(*shoot) +
             " and not used; {ShootBracket} {shoot.resume} goes on, or delete the "
             "folder"});
    return {};
  }
  if (!shoot->capture) {
    loaded.warnings.push_back({"capture_not_described", folder.generic_string(),
                               "its frames are not used: describe them in a [[capture]] of "
                               "session.toml (use, and what that needs)"});
    return {};
  }
  if (const auto strange = FindStrangeName(session, *shoot->capture)) {
    return Refused(strange->code, where, strange->message);
  }
  session.captures.push_back(*std::move(shoot->capture));
  session.input_files.push_back(record.string());
  return {};
}

}  // namespace

Result<void> AddShotCaptures(const fs::path& captures, const TextReader& read,
                             LoadedSession& loaded) {
  for (const fs::path& record : RecordsBelow(captures)) {
    if (auto added = AddOne(record, read, loaded); !added) return added;
  }
  return {};
}

}  // namespace lightcal::records
