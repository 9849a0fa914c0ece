// SPDX-License-Identifier: Apache-2.0
// Whatever an attribute holds is one finite number or a refusal that names the attribute.
#include <cmath>

#include "lightcal_devices/meters/iio/frame.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  namespace iio = lightcal::devices::iio;
  const auto text = lightcal::fuzz::TextOf(data, size);
  const auto number = lightcal::devices::iio::DecodeNumber(text, "in_illuminance_raw");
  if (!number) {
    Require(number.error().code == lightcal::devices::iio::kBadReply);
    Require(number.error().subject == "in_illuminance_raw");
    return 0;
  }
  Require(std::isfinite(number->value) && number->step > 0.0 && number->step <= 1.0);
  const auto value = lightcal::devices::iio::ValueOf(
      {.input = std::nullopt, .raw = *number, .offset = *number, .scale = *number});
  Require(value && std::isfinite(value->value) && std::isfinite(value->step));
  return 0;
}
