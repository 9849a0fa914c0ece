// SPDX-License-Identifier: Apache-2.0
// Whatever a program called spotread prints is a report of finite figures or a refusal.
#include <cmath>

#include "lightcal_devices/meters/spotread/frame.h"
#include "lightcal_devices/meters/spotread/meter.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  namespace spotread = lightcal::devices::spotread;
  const auto text = lightcal::fuzz::TextOf(data, size);
  Require(lightcal::devices::spotread::CalibrationInstructions(text).size() < 1000);
  Require(
      lightcal::devices::spotread::TellingLine(text, lightcal::devices::spotread::EndingOf(text))
          .size() < 1000);
  static_cast<void>(lightcal::devices::spotread::VersionIn(text));
  std::size_t from = 0;
  while (lightcal::devices::spotread::NextSituation(text, from) !=
         lightcal::devices::spotread::Situation::kNone) {
    Require(from <= size);
  }
  const auto report = lightcal::devices::spotread::DecodeReport(text);
  if (!report) {
    Require(report.error().code == lightcal::devices::spotread::kBadReply &&
            !report.error().message.empty());
    return 0;
  }
  if (!report->illuminance_lx) return 0;
  Require(std::isfinite(*report->illuminance_lx) && *report->illuminance_lx >= 0.0);
  if (report->spectrum) {
    Require(report->spectrum->values.size() == report->spectrum->wavelengths_nm.size());
    Require(report->spectrum->values.size() >= 2);
  }
  const auto reading = lightcal::devices::spotread::ReadingFromReport(*report, "spotread:fuzz");
  Require(reading.reading.illuminance->value() == *report->illuminance_lx);
  if (reading.reading.xy) {
    Require(std::isfinite(reading.reading.xy->x) && std::isfinite(reading.reading.xy->y));
  }
  return 0;
}
