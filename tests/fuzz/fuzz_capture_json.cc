// SPDX-License-Identifier: Apache-2.0
// A capture.json that is taken can be written, and reads back.
#include "lightcal/records/tethered_shoot.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  const auto shoot =
      lightcal::TetheredShootFromJson(lightcal::fuzz::TextOf(data, size), "capture.json");
  if (!shoot) {
    lightcal::fuzz::RequireGoodError(shoot.error());
    return 0;
  }
  for (const auto& frame : shoot->frames) Require(frame.file.find('/') == std::string::npos);
  const auto text = lightcal::TetheredShootToJson(*shoot);
  const auto again = lightcal::TetheredShootFromJson(text, "capture.json");
  Require(again.has_value());
  Require(lightcal::TetheredShootToJson(*again) == text);
  return 0;
}
