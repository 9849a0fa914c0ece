// SPDX-License-Identifier: Apache-2.0
// Session -> FittedLight.
#pragma once

#include <string_view>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal {

// Spectral readings are handed in as chromaticities: whoever loads the session resolves
// Reading::spectrum_file first (the fit opens no files).
struct FitSettings {
  double tolerance_relative = 0.01;  // of the effect gate
  std::string effects = "auto";      // auto | all | none | +a,-b
};

struct FittedSession {
  LightFile lights;   // provenance left empty for the caller
  Warnings warnings;  // prior_conflict, row_rejected, bimodal, cct_withheld, ...
};

// Fits every light of the session. Refused: no_readings, no_valid_readings, units_ambiguous (readings
// that differ by a factor of 100 in distance or 10.76 in illuminance), increasing_with_distance, ...
[[nodiscard]] Result<FittedSession> FitSession(const Session& session, const FitSettings& settings);

// Illuminance this light would give a meter facing it at `distance`, with the 95 % interval
// of the model alone and of one further reading with relative sigma `sigma_relative`.
struct PredictedIlluminance {
  Uncertain model_lx;
  Uncertain reading_lx;
};
[[nodiscard]] Result<PredictedIlluminance> PredictIlluminance(const FittedLight& light,
                                                              Metres distance,
                                                              double sigma_relative);

}  // namespace lightcal
