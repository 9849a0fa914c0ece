// SPDX-License-Identifier: Apache-2.0
// A EULUMDAT file that is read is a lamp; what is written of it can be read again.
#include <cmath>

#include "lightcal/records/photometric_codec.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  const auto read = lightcal::EulumdatFromText(lightcal::fuzz::TextOf(data, size), "lamp.ldt");
  if (!read) {
    lightcal::fuzz::RequireGoodError(read.error());
    return 0;
  }
  const double flux = read->file.table.Flux().value();
  Require(std::isfinite(flux) && flux >= 0.0);
  const auto text = lightcal::EulumdatText(read->file);
  Require(text.has_value());
  // Nothing in a file is "nan" or "inf", whatever came in.
  const auto again = lightcal::EulumdatFromText(*text, "again.ldt");
  if (!again) lightcal::fuzz::RequireGoodError(again.error());
  return 0;
}
