// SPDX-License-Identifier: Apache-2.0
#include "meter_calibrations.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <optional>

#include "lightcal/records/session_codec.h"
#include "output_files.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFile = "meters.toml";
constexpr std::chrono::days kValidity{366};

std::optional<fs::path> SettingsDirectory() {
  if (const char* const settings = std::getenv("XDG_CONFIG_HOME"); settings && *settings) {
    return fs::path(settings) / "lightcal";
  }
  if (const char* const home = std::getenv("HOME"); home && *home) {
    return fs::path(home) / ".config" / "lightcal";
  }
  return std::nullopt;
}

std::optional<std::chrono::sys_days> DayOf(const std::string& iso8601) {
  int year = 0;
  unsigned month = 0;
  unsigned day = 0;
  if (std::sscanf(iso8601.c_str(), "%4d-%2u-%2u", &year, &month, &day) != 3) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(month),
                                         std::chrono::day(day)};
  if (!date.ok()) return std::nullopt;
  return std::chrono::sys_days(date);
}

bool IsOld(const MeterCalibration& calibration, const Reading& reading) {
  const auto calibrated = DayOf(calibration.date);
  const auto read = DayOf(reading.time);
  return calibrated && read && *read - *calibrated > kValidity;
}

}  // namespace

Result<MeterCalibrations> MeterCalibrations::Load(const std::string& session_path) {
  std::vector<fs::path> directories;
  if (!session_path.empty()) {
    directories.push_back(fs::path(JournalPath(session_path)).parent_path());
  }
  if (const auto settings = SettingsDirectory()) directories.push_back(*settings);
  MeterCalibrations all;
  for (const fs::path& directory : directories) {
    const std::string path = (directory / kFile).string();
    std::error_code error;
    if (!fs::exists(path, error)) continue;
    const auto text = ReadWholeFile(path);
    if (!text) return tl::unexpected(text.error());
    auto read = MeterCalibrationsFromToml(*text, path);
    if (!read) return Propagate(std::move(read));
    std::ranges::move(*read, std::back_inserter(all.calibrations_));
  }
  return all;
}

void MeterCalibrations::Apply(Reading& reading, Warnings& warnings) const {
  if (reading.device.empty() || !reading.illuminance) return;
  const auto found = std::ranges::find(calibrations_, reading.device, &MeterCalibration::device);
  if (found == calibrations_.end()) {
    if (reading.quality != MeterQuality::kBareSensor) return;
    warnings.push_back({"uncalibrated", reading.device,
                        "a bare sensor's lux are its maker's guess; compare it once with a lux "
                        "meter and write the factor into meters.toml"});
    return;
  }
  reading.illuminance = Lux(reading.illuminance->value() * found->factor);
  reading.calibration_factor = found->factor;
  if (found->sigma_relative) reading.sigma_relative = found->sigma_relative;
  if (IsOld(*found, reading)) {
    warnings.push_back({"calibration_old", reading.device,
                        "was calibrated on " + found->date +
                            ", more than a year before this reading; compare it again"});
  }
}

}  // namespace lightcal::app
