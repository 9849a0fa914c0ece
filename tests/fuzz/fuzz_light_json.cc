// SPDX-License-Identifier: Apache-2.0
// A light.json that is taken can be written; the writing is a fixed point.
#include "lightcal/records/light_codec.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  const auto file = lightcal::LightFileFromJson(lightcal::fuzz::TextOf(data, size), "light.json");
  if (!file) {
    lightcal::fuzz::RequireGoodError(file.error());
    return 0;
  }
  const auto text = lightcal::LightFileToJson(*file);
  Require(text.has_value());
  const auto again = lightcal::LightFileFromJson(*text, "light.json");
  Require(again.has_value());
  Require(lightcal::LightFileToJson(*again).value_or("") == *text);
  return 0;
}
