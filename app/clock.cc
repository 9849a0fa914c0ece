// SPDX-License-Identifier: Apache-2.0
#include "clock.h"

#include <array>
#include <charconv>
#include <cstdlib>
#include <ctime>
#include <string_view>

namespace lightcal::app {
namespace {

std::string Iso8601(std::time_t time) {
  std::tm utc{};
  if (::gmtime_r(&time, &utc) == nullptr) return "";
  std::array<char, 32> text{};
  const std::size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return {text.data(), length};
}

}  // namespace

std::optional<std::string> SourceDateIso8601() {
  const char* fixed = std::getenv("SOURCE_DATE_EPOCH");
  if (fixed == nullptr) return std::nullopt;
  const std::string_view text(fixed);
  std::time_t value = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size()) return std::nullopt;
  return Iso8601(value);
}

std::string MomentIso8601() {
  if (auto fixed = SourceDateIso8601()) return *std::move(fixed);
  std::timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  std::string text = Iso8601(now.tv_sec);
  constexpr long kNanosecondsEach = 1'000'000;
  const std::string milliseconds = std::to_string(1000 + now.tv_nsec / kNanosecondsEach);
  return text.insert(text.size() - 1, "." + milliseconds.substr(1));
}

std::string NowIso8601() { return SourceDateIso8601().value_or(Iso8601(std::time(nullptr))); }

}  // namespace lightcal::app
