// SPDX-License-Identifier: Apache-2.0
// Whatever a line holds: nothing, a possible illuminance, or bad_reply.
#include <cmath>

#include "lightcal_devices/meters/text/frame.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  const auto line = lightcal::fuzz::TextOf(data, size);
  const auto reading = lightcal::devices::text::DecodeLine(line);
  if (!reading) {
    Require(reading.error().code == "bad_reply" && !reading.error().message.empty());
    return 0;
  }
  if (!*reading) return 0;
  const double lux = (*reading)->illuminance.value();
  Require(std::isfinite(lux) && lux >= 0.0 && lux <= 1e6);
  if ((*reading)->cct) {
    const double kelvin = (*reading)->cct->value();
    Require(std::isfinite(kelvin) && kelvin >= 1000.0 && kelvin <= 100000.0);
  }
  return 0;
}
