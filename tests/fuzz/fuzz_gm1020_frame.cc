// SPDX-License-Identifier: Apache-2.0
// Whatever comes in, a frame is refused with a reason or shows a number twelve bits can hold.
#include <cmath>
#include <span>

#include "lightcal_devices/meters/gm1020/frame.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  namespace gm1020 = lightcal::devices::gm1020;
  const auto bytes = std::as_bytes(std::span(data, size));
  const auto live = lightcal::devices::gm1020::DecodeLive(bytes);
  if (live) {
    Require(lightcal::devices::gm1020::MayBeginFrame(bytes));
    Require(std::abs(live->temperature_C) <= 3276.8);
    const double lux = lightcal::devices::LuxFromDisplay(live->shown);
    Require(std::isfinite(lux) && lux >= 0.0 && lux <= 409500.0);
  } else {
    Require(!live.error().message.empty());
  }
  return 0;
}
