// SPDX-License-Identifier: Apache-2.0
// Whatever comes in, a reply is refused with a reason or holds four digits.
#include <cmath>
#include <span>

#include "lightcal_devices/meters/pce174/frame.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  namespace pce174 = lightcal::devices::pce174;
  const auto bytes = std::as_bytes(std::span(data, size));
  const auto measurement = lightcal::devices::pce174::DecodeMeasurement(bytes);
  if (measurement) {
    Require(lightcal::devices::pce174::MayBeginFrame(bytes));
    Require(measurement->mode != "?");
    const double lux = lightcal::devices::LuxFromDisplay(measurement->raw);
    Require(std::isfinite(lux) && lux >= 0.0 && lux <= 999900.0 * 11.0);
  } else {
    Require(!measurement.error().message.empty());
  }
  return 0;
}
