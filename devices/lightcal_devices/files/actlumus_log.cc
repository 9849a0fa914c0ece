// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/actlumus_log.h"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/files/delimited_text.h"

namespace lightcal::devices::files {
namespace {

constexpr std::string_view kTimeColumn = "DATE/TIME";
constexpr std::string_view kLightColumn = "LIGHT";
constexpr std::string_view kDeviceKey = "DEVICE_ID :";

class LogReader {
 public:
  explicit LogReader(std::string_view name) : name_(name) { file_.format = "actlumus"; }

  Result<void> TakeRow(int line, std::span<const std::string> cells) {
    if (cells.empty()) return {};
    if (!light_column_) return TakeHeader(cells);
    const std::string time = IsoTime(cells.front(), DateOrder::kDayFirst);
    const auto lux =
        *light_column_ < cells.size() ? ParseNumber(cells[*light_column_]) : std::nullopt;
    if (time.empty() || !lux || *lux < 0.0) {
      if (bad_rows_++ == 0) first_bad_line_ = line;
      return {};
    }
    Reading reading;
    reading.illuminance = Lux(*lux);
    reading.time = time;
    reading.device = device_;
    file_.readings.push_back(std::move(reading));
    return {};
  }

  Result<ImportedFile> Finish() {
    if (file_.readings.empty()) {
      return Refused("no_rows", name_, "holds no row with a time and an illuminance");
    }
    if (bad_rows_ > 0) {
      file_.warnings.push_back({"bad_row", AtLine(name_, first_bad_line_),
                                std::to_string(bad_rows_) +
                                    " rows without a time or an illuminance are left out, this "
                                    "is the first"});
    }
    return std::move(file_);
  }

 private:
  Result<void> TakeHeader(std::span<const std::string> cells) {
    const std::string& first = cells.front();
    if (first.starts_with(kDeviceKey)) {
      device_ = "actlumus:" + std::string(TrimBlanks(first.substr(kDeviceKey.size())));
    }
    if (first != kTimeColumn) return {};
    const auto light = std::ranges::find(cells, kLightColumn);
    if (light == cells.end()) {
      return Refused("no_rows", name_, "its table has no column LIGHT");
    }
    light_column_ = static_cast<std::size_t>(light - cells.begin());
    return {};
  }

  std::string name_;
  ImportedFile file_;
  std::string device_ = "actlumus";
  std::optional<std::size_t> light_column_;
  int bad_rows_ = 0;
  int first_bad_line_ = 0;
};

}  // namespace

bool IsActlumusLog(std::string_view text) {
  const std::string_view beginning = text.substr(0, 4096);
  return beginning.starts_with("#ActLogModel") ||
         beginning.find("Condor Instruments Report") != std::string_view::npos;
}

Result<ImportedFile> ReadActlumusLog(std::string_view text, std::string_view name) {
  LogReader reader(name);
  const auto read = ForEachRow(text, ';', [&](int line, std::span<const std::string> cells) {
    return reader.TakeRow(line, cells);
  });
  if (!read) return tl::unexpected(read.error());
  return reader.Finish();
}

}  // namespace lightcal::devices::files
