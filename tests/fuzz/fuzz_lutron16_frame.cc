// SPDX-License-Identifier: Apache-2.0
// Whatever comes in, a frame is refused with a reason or holds eight digits.
#include <cmath>
#include <span>

#include "lightcal_devices/meters/lutron16/frame.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  namespace lutron16 = lightcal::devices::lutron16;
  const auto bytes = std::as_bytes(std::span(data, size));
  const auto measurement = lightcal::devices::lutron16::DecodeMeasurement(bytes);
  if (measurement) {
    Require(lightcal::devices::lutron16::MayBeginFrame(bytes));
    const double lux = lightcal::devices::LuxFromDisplay(measurement->shown);
    Require(std::isfinite(lux) && lux >= 0.0 && lux <= 99999999.0 * 11.0);
  } else {
    Require(!measurement.error().message.empty());
    Require(measurement.error().message.size() < 500);
  }
  return 0;
}
