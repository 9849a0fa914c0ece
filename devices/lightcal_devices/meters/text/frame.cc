// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/text/frame.h"

#include <array>
#include <string>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal_devices/transport/framing.h"
#include "lightcal_devices/transport/tape.h"

namespace lightcal::devices::text {
namespace {

constexpr double kHighestLx = 1e6;

tl::unexpected<Error> BadLine(std::string_view line, const std::string& what) {
  return Failed(std::string(kBadReply), "\"" + EscapedBytes(AsBytes(line)) + "\"",
                what +
                    "; a line is an illuminance, with a colour temperature if known: 192, "
                    "17.8fc or 192,5600");
}

bool IsComment(std::string_view line) {
  return line.starts_with('#') || line.starts_with(';') || line.starts_with("//");
}

// Where the second field begins: at a comma, semicolon or tab, or at a blank before a digit.
std::size_t FirstFieldEnd(std::string_view line) {
  const auto separator = line.find_first_of(",;\t");
  if (separator != std::string_view::npos) return separator;
  for (auto blank = line.find(' '); blank != std::string_view::npos;
       blank = line.find(' ', blank + 1)) {
    if (blank + 1 < line.size() && line[blank + 1] >= '0' && line[blank + 1] <= '9') return blank;
  }
  return std::string_view::npos;
}

}  // namespace

Result<std::optional<TextReading>> DecodeLine(std::string_view given) {
  const std::string_view line = TrimBlanks(given);
  if (line.empty() || IsComment(line)) return std::nullopt;
  const std::size_t end = FirstFieldEnd(line);
  std::string_view first = TrimBlanks(line.substr(0, end));
  if (IsOverloadWord(first)) return BadLine(line, "says no number; " + std::string(kWriteALimit));
  const char limit = LimitSignOf(first);
  if (limit != '\0') first.remove_prefix(1);
  const auto illuminance = ParseIlluminance(first);
  if (!illuminance) return BadLine(line, "is no illuminance");
  if (illuminance->value() < 0.0 || illuminance->value() > kHighestLx) {
    return BadLine(line, "is no possible illuminance");
  }
  TextReading reading{*illuminance, std::nullopt, limit == '>', limit == '<'};
  if (end == std::string_view::npos) return reading;
  const auto cct = ParseTemperature(TrimBlanks(line.substr(end + 1)));
  if (!cct || !IsTemperatureOfLamp(*cct)) {
    return BadLine(line, "holds something else than a colour temperature after its illuminance");
  }
  reading.cct = *cct;
  return reading;
}

}  // namespace lightcal::devices::text
