// SPDX-License-Identifier: Apache-2.0
// Whatever a program called spotread prints is a report of finite figures or a refusal.
#include <cmath>

#include "lightcal_devices/meters/spotread/frame.h"
#include "lightcal_devices/meters/spotread/meter.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  namespace spotread = lightcal::spotread;
  const auto text = lightcal::fuzz::TextOf(data, size);
  Require(spotread::CalibrationInstructions(text).size() < 1000);
  Require(spotread::TellingLine(text, spotread::EndingOf(text)).size() < 1000);
  static_cast<void>(spotread::VersionIn(text));
  std::size_t from = 0;
  while (spotread::NextSituation(text, from) != spotread::Situation::kNone) {
    Require(from <= size);
  }
  const auto report = spotread::DecodeReport(text);
  if (!report) {
    Require(report.error().code == spotread::kBadReply && !report.error().message.empty());
    return 0;
  }
  if (!report->illuminance_lx) return 0;
  Require(std::isfinite(*report->illuminance_lx) && *report->illuminance_lx >= 0.0);
  if (report->spectrum) {
    Require(report->spectrum->values.size() == report->spectrum->wavelengths_nm.size());
    Require(report->spectrum->values.size() >= 2);
  }
  const auto reading = spotread::ReadingFromReport(*report, "spotread:fuzz");
  Require(reading.reading.illuminance->value() == *report->illuminance_lx);
  if (reading.reading.xy) {
    Require(std::isfinite(reading.reading.xy->x) && std::isfinite(reading.reading.xy->y));
  }
  return 0;
}
