// SPDX-License-Identifier: Apache-2.0
// A Radiance header that is read has a positive, finite exposure and usable primaries.
#include <cmath>

#include "lightcal_devices/captures/radiance_header.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  const auto header =
      lightcal::devices::ParseRadianceHeader(lightcal::fuzz::TextOf(data, size), "picture.hdr");
  if (!header) {
    lightcal::fuzz::RequireGoodError(header.error());
    return 0;
  }
  Require(std::isfinite(header->exposure) && header->exposure > 0.0);
  if (!header->primaries) return 0;
  for (const auto& row : lightcal::XyzFromRgbMatrix(*header->primaries)) {
    for (const double entry : row) Require(!std::isnan(entry));
  }
  return 0;
}
