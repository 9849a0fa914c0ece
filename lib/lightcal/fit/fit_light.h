// SPDX-License-Identifier: Apache-2.0
// Session -> FittedLight.
#pragma once

#include <iterator>
#include <string>
#include <vector>

#include "lightcal/core/progress.h"
#include "lightcal/core/result.h"
#include "lightcal/records/accuracy_profile.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal {

// Spectral readings are handed in as chromaticities: whoever loads the session resolves
// Reading::spectrum_file first (the fit opens no files).
struct FitSettings {
  double tolerance_relative = 0.01;  // of the effect gate
  std::string effects = "auto";      // auto | all | none | +a,-b
  bool monte_carlo = false;          // intervals by sampling (monte_carlo.h) instead of covariance
  EstimatorChoice estimator{};
  CctMethod cct_method = CctMethod::kExact;
  bool time_effects = false;  // effects' cost_ns measured here and now, not as declared
  Progress progress{};        // of sampling, over all lights
};

struct FittedSession {
  LightFile lights;                  // provenance left empty for the caller
  Warnings warnings;                 // prior_conflict, row_rejected, bimodal, cct_withheld, ...
  std::vector<std::string> notes{};  // what sampling found, a sentence a light

  void Warn(Warnings&& more) {
    warnings.insert(warnings.end(), std::make_move_iterator(more.begin()),
                    std::make_move_iterator(more.end()));
  }
};

// Fits every light of the session:
//   E = I g(r)/r^2 cos(tilt) + E0,  r = d + d0,  g the finite source's factor (1 for a point),
// and what the walls throw back (light/wall_prior.h), by weighted least squares of ln E with d0
// under the prior of its fixture (light/fixture.h), E0 = 0 unless lamp-off readings or, where no
// wall shines, four distances tell it (estimate_light.h); shadow-card readings are subtracted from
// the readings at their distance. A light without position_m whose readings give theirs is located
// (locate.h). A light that was never read answers from its data sheet (everything a prior), or,
// beside others that were read, is left out with the warning no_readings. A reading with a fault
// (FaultOf) is rejected and counted, with the warning row_rejected, as in a journal. Refused: as
// CheckSession, and no_readings, no_valid_readings, over_range, units_ambiguous (readings apart by
// a ratio of units), increasing_with_distance, negative_distance, underdetermined (a strength open
// by a factor of 1000 each way), out_of_range, bad_beam, bad_effects, and as LocateLamp: of the
// first light that cannot be fitted, with those of all the others in Error::others.
[[nodiscard]] Result<FittedSession> FitSession(const Session& session, const FitSettings& settings);

// Illuminance this light would give a meter facing it at `distance`, with the 95 % interval
// of the model alone and of one further reading with relative sigma `sigma_relative`: the mixture
// of light.in_room without its walls, each ln E normal, or one normal where that is empty.
struct PredictedIlluminance {
  Uncertain model_lx;
  Uncertain reading_lx;
};
[[nodiscard]] Result<PredictedIlluminance> PredictIlluminance(const FittedLight& light,
                                                              Metres distance,
                                                              double sigma_relative);

// What a meter facing the lamp will see where it was measured, light from the walls and other light
// with it: the mixture of light.in_room, each ln E normal. Absent where no wall's light was fitted.
// Refused: as PredictIlluminance.
struct IlluminanceInRoom {
  Uncertain whole_lx;
  Uncertain reading_lx;  // one further reading
  Uncertain walls_lx;    // of whole_lx
};
[[nodiscard]] Result<std::optional<IlluminanceInRoom>> PredictInRoom(const FittedLight& light,
                                                                     Metres distance,
                                                                     double sigma_relative);

// A place in the room, a meter's unit normal there, and what the lamp alone gives it per candela.
struct PlaceInRoom {
  Vec3 position_m{};
  Vec3 normal{};
  double direct_per_candela = 0.0;  // lx/cd
};
// The same of a lamp whose place was sought, at a place: ln E normal about light.located.
[[nodiscard]] std::optional<Uncertain> PredictInRoom(const FittedLight& light,
                                                     const PlaceInRoom& at);

// The one next reading that helps this light most, as a sentence: "read again at 1.4 m, facing the
// lamp: the distance offset is still a prior".
[[nodiscard]] std::string NextStep(const Session& session, const FittedLight& light);

}  // namespace lightcal
