// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/reading_time.h"

#include <charconv>
#include <chrono>
#include <cstddef>

namespace lightcal {
namespace {

// Takes a whole number of exactly `digits` digits off the front.
std::optional<int> TakeDigits(std::string_view& text, std::size_t digits) {
  int value = 0;
  if (text.size() < digits) return std::nullopt;
  const auto [end, error] = std::from_chars(text.data(), text.data() + digits, value);
  if (error != std::errc() || end != text.data() + digits || value < 0) return std::nullopt;
  text.remove_prefix(digits);
  return value;
}

bool Take(std::string_view& text, char c) {
  if (!text.starts_with(c)) return false;
  text.remove_prefix(1);
  return true;
}

// Days since 1970.
std::optional<double> TakeDay(std::string_view& text) {
  const auto year = TakeDigits(text, 4);
  if (!year || !Take(text, '-')) return std::nullopt;
  const auto month = TakeDigits(text, 2);
  if (!month || !Take(text, '-')) return std::nullopt;
  const auto day = TakeDigits(text, 2);
  if (!day) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(*year),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day))};
  if (!date.ok()) return std::nullopt;
  return static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
}

// Seconds east of Greenwich; the rest of the text must be a zone or nothing.
std::optional<double> ZoneOf(std::string_view text) {
  if (text.empty() || text == "Z") return 0.0;
  const bool west = text.front() == '-';
  if (!west && text.front() != '+') return std::nullopt;
  text.remove_prefix(1);
  const auto hours = TakeDigits(text, 2);
  const bool hours_alone = text.empty();
  Take(text, ':');
  const auto minutes = hours_alone ? std::optional(0) : TakeDigits(text, 2);
  if (!hours || !minutes || !text.empty()) return std::nullopt;
  const double east = 3600.0 * *hours + 60.0 * *minutes;
  return west ? -east : east;
}

// A fraction of a second, 0 where there is none.
double TakeFraction(std::string_view& text) {
  if (!Take(text, '.')) return 0.0;
  double value = 0.0;
  double unit = 0.1;
  for (; !text.empty() && text.front() >= '0' && text.front() <= '9'; unit *= 0.1) {
    value += unit * (text.front() - '0');
    text.remove_prefix(1);
  }
  return value;
}

}  // namespace

std::optional<double> SecondsOfTime(std::string_view iso8601) {
  const auto days = TakeDay(iso8601);
  if (!days || !(Take(iso8601, 'T') || Take(iso8601, ' '))) return std::nullopt;
  const auto hour = TakeDigits(iso8601, 2);
  if (!hour || !Take(iso8601, ':')) return std::nullopt;
  const auto minute = TakeDigits(iso8601, 2);
  const auto second = Take(iso8601, ':') ? TakeDigits(iso8601, 2) : std::optional(0);
  if (!minute || !second) return std::nullopt;
  const double fraction = TakeFraction(iso8601);
  const auto zone = ZoneOf(iso8601);
  if (!zone || *hour > 24 || *minute > 59 || *second > 60) return std::nullopt;
  return 86400.0 * *days + 3600.0 * *hour + 60.0 * *minute + *second + fraction - *zone;
}

bool IsTime(std::string_view iso8601) {
  if (SecondsOfTime(iso8601)) return true;
  return TakeDay(iso8601) && iso8601.empty();
}

}  // namespace lightcal
