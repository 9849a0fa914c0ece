// SPDX-License-Identifier: Apache-2.0
#include "guide/watch_view.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "light_table.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/printable.h"
#include "measuring.h"

namespace lightcal::app {
namespace {

constexpr std::size_t kSparks = 48;
constexpr double kOneLevel = 1e-3;  // of the largest value
// A meter at least this fast follows 120 Hz.
constexpr double kMainsHz = 120.0;

// Below a hundredth of a per cent there is nothing but rounding.
std::string SpreadText(double part) {
  constexpr double kLeast = 1e-4;
  return std::abs(part) < kLeast ? "< 0.01 %" : PercentText(part);
}

// Cut to so many characters.
std::string Fitted(const std::string& line, std::size_t columns) {
  std::size_t shown = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool begins = (static_cast<unsigned char>(line[i]) & 0xC0U) != 0x80U;
    if (begins && ++shown > columns) return line.substr(0, i);
  }
  return line;
}

}  // namespace

std::string Sparkline(std::span<const double> values) {
  constexpr std::array<std::string_view, 8> kLevels = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  if (values.empty()) return "";
  const auto [least, most] = std::ranges::minmax_element(values);
  const double span = *most - *least;
  const bool flat = !(span > kOneLevel * *most);
  std::string line;
  for (const double value : values) {
    const double part = flat ? 0.5 : (value - *least) / span;
    const auto level = static_cast<std::size_t>(part * 7.0 + 0.5);
    line += kLevels[std::min<std::size_t>(level, 7)];
  }
  return line;
}

std::string ReadingText(const Reading& reading) {
  std::string text = LuxText(reading);
  if (reading.cct) text += "  " + RoundedText(reading.cct->value(), 4) + " K";
  if (reading.duv) text += "  Duv " + DuvText(*reading.duv);
  return text;
}

std::string FlickerText(const Steadiness& steady) {
  if (!steady.modulation) return "flicker: three readings are needed";
  std::string text = "flicker " + SpreadText(*steady.modulation) + " (scatter " +
                     SpreadText(*steady.scatter_relative) + ")";
  if (steady.drift_per_minute_relative) {
    const double drift = *steady.drift_per_minute_relative;
    text += std::string(", drift ") + (drift < 0.0 ? "" : "+") + SpreadText(drift) + " a minute";
  }
  return text;
}

std::string PaceText(const Steadiness& steady) {
  if (!steady.rate_hz) return "";
  const double sees = 0.5 * *steady.rate_hz;
  return RoundedText(*steady.rate_hz, 2) + " readings a second show what is slower than " +
         RoundedText(sees, 2) + " Hz" + (sees < kMainsHz ? ", not the mains' 100 or 120 Hz" : "");
}

std::vector<std::string> WatchBlock(const WatchSeries& series,
                                    const std::optional<FittedLight>& light, std::size_t columns) {
  std::vector<double> lux;
  const auto& readings = series.readings();
  const std::size_t first = readings.size() - std::min(readings.size(), kSparks);
  for (std::size_t i = first; i < readings.size(); ++i) {
    lux.push_back(readings[i].illuminance->value());
  }
  const Steadiness steady = series.Steady();
  std::vector<std::string> lines = {
      std::to_string(series.count()) + ": " + ReadingText(readings.back()),
      Sparkline(lux) + "  " + RoundedText(steady.least_lx, 4) + " … " +
          RoundedText(steady.most_lx, 4) + " lx",
      FlickerText(steady)};
  if (const std::string pace = PaceText(steady); !pace.empty()) lines.push_back(pace);
  if (light) lines.push_back(light->name + " so far: " + Headline(*light));
  for (std::string& line : lines) line = Fitted(line, columns);
  return lines;
}

bool DrawnOver::Possible() {
  const char* const terminal = std::getenv("TERM");
  return ::isatty(STDOUT_FILENO) == 1 && terminal != nullptr &&
         std::string_view(terminal) != "dumb";
}

std::size_t DrawnOver::Columns() {
  constexpr std::size_t kUsual = 80;
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kUsual;
  return size.ws_col;
}

void DrawnOver::Draw(const std::vector<std::string>& lines) {
  std::string text;
  if (drawn_ > 0) text += "\x1b[" + std::to_string(drawn_) + "A";
  for (const std::string& line : lines) text += "\r" + Printable(line) + "\x1b[K\n";
  drawn_ = lines.size();
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
}

}  // namespace lightcal::app
