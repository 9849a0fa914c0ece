// SPDX-License-Identifier: Apache-2.0
// Whatever a Gossen meter sends: a finite illuminance of five digits at most, or a named error.
#include <cmath>

#include "lightcal_devices/meters/gossen/frame.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  namespace gossen = lightcal::devices::gossen;
  const auto line = lightcal::fuzz::TextOf(data, size);
  if (const auto number = lightcal::devices::gossen::DecodeError(line)) {
    Require(*number >= 0 && *number <= 9999);
    Require(!lightcal::devices::gossen::ErrorOf(*number, "gossen").code.empty());
  }
  const auto shown = lightcal::devices::gossen::DecodeMeasurement(line);
  if (shown) {
    Require(shown->counts >= 0 && shown->counts <= 99999);
    Require(std::isfinite(lightcal::devices::LuxFromDisplay(*shown)));
  } else {
    Require(shown.error().code == "bad_reply" || shown.error().code == "luminance_head");
  }
  const auto identity = lightcal::devices::gossen::DecodeIdentity(line);
  Require(identity || identity.error().code == "bad_reply");
  return 0;
}
