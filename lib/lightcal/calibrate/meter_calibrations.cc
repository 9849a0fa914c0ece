// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/meter_calibrations.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

namespace lightcal {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFile = "meters.toml";
constexpr std::chrono::days kValidity{366};

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

Result<MeterCalibrations> MeterCalibrations::Load(const std::vector<std::string>& directories,
                                                  const Sources& sources) {
  MeterCalibrations all;
  for (const std::string& directory : directories) {
    const std::string path = (fs::path(directory) / kFile).string();
    if (!sources.exists(path)) continue;
    const auto text = sources.read_text(path);
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
                        "meter and write factor and sigma_relative into meters.toml"});
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

}  // namespace lightcal
