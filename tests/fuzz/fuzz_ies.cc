// SPDX-License-Identifier: Apache-2.0
// An IES file that is read is a lamp, and what is written of it reads back as the same file.
#include <cmath>

#include "lightcal/records/photometric_codec.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  const auto tilt = [](const std::string& name) -> lightcal::Result<std::string> {
    Require(name.find('/') == std::string::npos && name.front() != '.');
    return std::string("1 2 0 90 1 .9");
  };
  const auto read = lightcal::IesFromText(lightcal::fuzz::TextOf(data, size), "lamp.ies", tilt);
  if (!read) {
    lightcal::fuzz::RequireGoodError(read.error());
    return 0;
  }
  const double flux = read->file.table.Flux().value();
  Require(std::isfinite(flux) && flux >= 0.0);
  const std::string text = lightcal::IesText(read->file);
  const auto again = lightcal::IesFromText(text, "again.ies");
  // Angles closer together than their printed digits may collapse.
  if (again) Require(lightcal::IesText(again->file) == text);
  return 0;
}
