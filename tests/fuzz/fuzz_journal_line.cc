// SPDX-License-Identifier: Apache-2.0
// A journal line that is taken can be written again, and then reads as the same line.
#include "lightcal/records/session_codec.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  const auto reading = lightcal::ReadingFromJson(lightcal::fuzz::TextOf(data, size), "line");
  if (!reading) {
    lightcal::fuzz::RequireGoodError(reading.error());
    return 0;
  }
  const std::string line = lightcal::ReadingToJson(*reading);
  Require(line.find('\n') == std::string::npos);
  const auto again = lightcal::ReadingFromJson(line, "line");
  Require(again.has_value());
  Require(lightcal::ReadingToJson(*again) == line);
  return 0;
}
