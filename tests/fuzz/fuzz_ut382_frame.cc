// SPDX-License-Identifier: Apache-2.0
// Whatever comes in, a frame is refused with a reason or shows a number the display can show.
#include <cmath>
#include <span>

#include "lightcal_devices/meters/ut382/frame.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  namespace ut382 = lightcal::devices::ut382;
  const auto bytes = std::as_bytes(std::span(data, size));
  const auto display = lightcal::devices::ut382::DecodeDisplay(bytes);
  if (display) {
    Require(lightcal::devices::ut382::MayBeginFrame(bytes));
    const double lux = lightcal::devices::LuxFromDisplay(display->shown);
    Require(std::isfinite(lux) && lux >= 0.0 && lux <= 99990.0 * 11.0);
  } else {
    Require(!display.error().message.empty());
  }
  return 0;
}
