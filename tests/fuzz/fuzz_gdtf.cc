// SPDX-License-Identifier: Apache-2.0
// A fixture's archive, or its description alone, is read into finite numbers or refused.
#include <cmath>

#include "lightcal_devices/files/gdtf_file.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  const auto bytes = lightcal::fuzz::TextOf(data, size);
  for (const bool archive : {true, false}) {
    const auto fixture = archive ? lightcal::devices::GdtfFromArchive(bytes, "file")
                                 : lightcal::devices::GdtfFromDescription(bytes, "file");
    if (!fixture) {
      Require(!fixture.error().code.empty() && !fixture.error().message.empty());
      continue;
    }
    for (const auto& beam : fixture->beams) {
      Require(!beam.flux_lm || std::isfinite(*beam.flux_lm));
      Require(!beam.beam_deg || (*beam.beam_deg >= 0.0 && *beam.beam_deg <= 360.0));
    }
    for (const auto& emitter : fixture->emitters) {
      for (const auto& one : emitter.measurements) Require(one.physical_percent > 0.0);
    }
    Require(!lightcal::GdtfDescription(*fixture).empty());
  }
  return 0;
}
