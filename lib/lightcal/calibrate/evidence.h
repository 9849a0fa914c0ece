// SPDX-License-Identifier: Apache-2.0
// What measuring a session brings to light beside its readings.
#pragma once

#include <string>
#include <vector>

#include "lightcal/calibrate/captures/recorded_picture.h"
#include "lightcal/calibrate/spectral_doubt.h"
#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/result.h"
#include "lightcal/records/fixture_state.h"

namespace lightcal {

// The spectrum of a light, or of one state of its controls (lamp_spectra.h).
struct NamedSpectrum {
  std::string light;
  std::string file;  // as the session names it
  Spectrum spectrum;
  FixtureState state{};
  SpectralDoubt doubt{};
};

struct Evidence {
  std::vector<std::string> files;  // that were read, each once, in this order
  std::vector<NamedSpectrum> spectra;
  std::vector<RecordedPicture> pictures;
  Warnings warnings;

  void AddFile(const std::string& path);
  // At no state of its controls; where that has none yet.
  void AddSpectrum(const std::string& light, const std::string& file, const Spectrum& spectrum);
  void AddWarnings(const Warnings& more);
};

}  // namespace lightcal
