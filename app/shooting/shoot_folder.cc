// SPDX-License-Identifier: Apache-2.0
#include "shooting/shoot_folder.h"

#include <cctype>
#include <filesystem>
#include <optional>
#include <system_error>

#include "output_files.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

// What no wildcard and no shell takes for more than a letter.
std::string PlainName(std::string name) {
  for (char& c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' ||
                       (static_cast<unsigned char>(c) & 0x80U) != 0;
    if (!plain) c = '_';
  }
  return name;
}

std::string TwoDigits(int number) { return (number < 10 ? "0" : "") + std::to_string(number); }

}  // namespace

ShootFolder ShootFolder::New(const std::string& captures, const std::string& light) {
  const std::string stem = (fs::path(captures) / (PlainName(light) + "-")).string();
  int number = 1;
  std::error_code ignored;
  while (fs::exists(stem + std::to_string(number), ignored)) ++number;
  return ShootFolder(stem + std::to_string(number));
}

Result<std::pair<ShootFolder, TetheredShoot>> ShootFolder::Unfinished(const std::string& captures,
                                                                      const std::string& light) {
  std::optional<std::pair<ShootFolder, TetheredShoot>> last;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(captures, ignored)) {
    ShootFolder folder(entry.path().string());
    const std::string record = folder.PathOf(std::string(kTetheredShootFile));
    if (!fs::exists(record, ignored)) continue;
    const auto text = ReadOutput(record);
    if (!text) return tl::unexpected(text.error());
    auto shoot = TetheredShootFromJson(*text, record);
    if (!shoot) return Propagate(std::move(shoot));
    if (shoot->complete || (!light.empty() && shoot->light != light)) continue;
    const bool later = !last || std::pair(shoot->time, folder.path()) >
                                    std::pair(last->second.time, last->first.path());
    if (later) last.emplace(std::move(folder), *std::move(shoot));
  }
  if (!last) {
    return Failed("nothing_to_resume", captures,
                  "no bracket" + (light.empty() ? "" : " of " + light) + " was broken off here");
  }
  return *std::move(last);
}

bool ShootFolder::Has(const ShotFrame& frame) const {
  std::error_code ignored;
  return !frame.file.empty() && fs::is_regular_file(PathOf(frame.file), ignored);
}

std::string ShootFolder::PathOf(const std::string& file) const {
  return (fs::path(path_) / file).string();
}

Result<void> ShootFolder::Save(const TetheredShoot& shoot) const {
  return WriteOutputs({{PathOf(std::string(kTetheredShootFile)), TetheredShootToJson(shoot)}},
                      true);
}

Result<std::string> ShootFolder::Fetch(devices::TetheredCamera& camera,
                                       const devices::StoredPicture& file, int number) const {
  const std::string extension = fs::path(file.name).extension().string();
  const std::string name = "frame_" + TwoDigits(number) +
                           (extension.empty() ? "" : "." + PlainName(extension.substr(1)));
  const auto fetch = [&](const std::string& temporary) { return camera.Download(file, temporary); };
  if (auto written = WriteOutputsWith({{PathOf(name), "", fetch}}, true); !written) {
    return Propagate(std::move(written));
  }
  return name;
}

}  // namespace lightcal::app
