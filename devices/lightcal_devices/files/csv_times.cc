// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/csv_times.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstdio>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/files/delimited_text.h"

namespace lightcal::devices::files {
namespace {

// Whole seconds or milliseconds since 1970, as loggers of the web write them.
std::string TimeSinceEpoch(std::string_view digits) {
  constexpr std::size_t kSecondDigits = 10, kMilliDigits = 13;
  constexpr std::int64_t kMillis = 1000;
  std::int64_t count = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), count);
  const bool whole = read.ec == std::errc() && read.ptr == digits.data() + digits.size();
  if (!whole || (digits.size() != kSecondDigits && digits.size() != kMilliDigits)) return {};
  const bool in_millis = digits.size() == kMilliDigits;
  const std::chrono::sys_seconds at{std::chrono::seconds(in_millis ? count / kMillis : count)};
  const auto day = std::chrono::floor<std::chrono::days>(at);
  const std::chrono::year_month_day date{day};
  const std::chrono::hh_mm_ss time{at - day};
  std::array<char, 40> text{};
  const int size = std::snprintf(
      text.data(), text.size(), "%04d-%02u-%02uT%02d:%02d:%02d", static_cast<int>(date.year()),
      static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
      static_cast<int>(time.hours().count()), static_cast<int>(time.minutes().count()),
      static_cast<int>(time.seconds().count()));
  std::string iso(text.data(), static_cast<std::size_t>(size));
  if (in_millis) {
    const int rest =
        std::snprintf(text.data(), text.size(), ".%03d", static_cast<int>(count % kMillis));
    iso.append(text.data(), static_cast<std::size_t>(rest));
  }
  return iso + "Z";
}

// A stamp of slashes: its first two numbers, and the rest by 24 hours.
struct SlashStamp {
  int first = 0, second = 0, year = 0, hour = 0;
  std::string rest;  // ":05:00"
};
std::optional<SlashStamp> SlashStampOf(std::string_view cell) {
  SlashStamp stamp;
  int used = 0;
  const std::string text(TrimBlanks(cell));
  const int read = std::sscanf(text.c_str(), "%2d/%2d/%4d%*[ ,T]%2d%n", &stamp.first, &stamp.second,
                               &stamp.year, &stamp.hour, &used);
  constexpr int kNumbers = 4, kHalfDay = 12;
  if (read != kNumbers || used == 0) return std::nullopt;
  std::string rest = text.substr(static_cast<std::size_t>(used));
  std::string half = LowerAscii(rest);
  std::erase(half, '.');
  const bool am = half.ends_with("am"), pm = half.ends_with("pm");
  if (am || pm) {
    if (stamp.hour < 1 || stamp.hour > kHalfDay) return std::nullopt;
    stamp.hour = stamp.hour % kHalfDay + (pm ? kHalfDay : 0);
    rest = rest.substr(0, rest.find_first_of("aApP"));
  }
  stamp.rest = TrimBlanks(rest);
  return stamp;
}

std::string IsoOf(const SlashStamp& stamp, bool day_first) {
  const int day = day_first ? stamp.first : stamp.second;
  const int month = day_first ? stamp.second : stamp.first;
  return IsoTime(std::to_string(stamp.year) + "-" + std::to_string(month) + "-" +
                     std::to_string(day) + " " + std::to_string(stamp.hour) + stamp.rest,
                 DateOrder::kYearFirst);
}

}  // namespace

std::string TimeOfCell(std::string_view cell) {
  if (cell.size() >= 10 && cell.find_first_not_of("0123456789") == std::string_view::npos) {
    return TimeSinceEpoch(cell);
  }
  const bool year_first = cell.size() >= 10 && (cell[4] == '-' || cell[4] == '/');
  if (year_first) return IsoTime(cell, DateOrder::kYearFirst);
  // 01.03.2026 is the first of March wherever points are written; 01/03/2026 either.
  const std::size_t date = cell.find_first_not_of("0123456789.");
  const std::string_view day_first = cell.substr(0, date);
  return std::ranges::count(day_first, '.') == 2 ? IsoTime(cell, DateOrder::kDayFirst) : "";
}

std::optional<std::vector<std::string>> TimesOfCells(const std::vector<std::string_view>& cells) {
  constexpr int kMonths = 12;
  bool day_first = false, month_first = false;
  for (const std::string_view cell : cells) {
    const auto stamp = SlashStampOf(cell);
    day_first = day_first || (stamp && stamp->first > kMonths);
    month_first = month_first || (stamp && stamp->second > kMonths);
  }
  std::vector<std::string> times;
  for (const std::string_view cell : cells) {
    if (TrimBlanks(cell).empty()) {
      times.emplace_back();
      continue;
    }
    const auto stamp = SlashStampOf(cell);
    if (stamp && day_first == month_first) return std::nullopt;
    times.push_back(stamp ? IsoOf(*stamp, day_first) : TimeOfCell(TrimBlanks(cell)));
    if (times.back().empty()) return std::nullopt;
  }
  return times;
}

}  // namespace lightcal::devices::files
