// SPDX-License-Identifier: Apache-2.0
// Readings as rows of the beam's problem, with what is known of the lamp beforehand. Internal to
// this room.
#pragma once

#include <cstddef>
#include <vector>

#include "lightcal/fit/beam/beam_profile.h"
#include "lightcal/fit/estimate_light.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

struct BeamRows {
  BeamReadings readings;
  SourceFrame frame;
  std::vector<std::size_t> observation;  // of each row
  bool placed = false;
};

// 1 sigma, relative, of an angle on a data sheet.
inline constexpr double kSheetAngle = 0.1;

// Mean of what was read with the lamp off, lux; 0 without.
[[nodiscard]] double AmbientOfOff(const Observations& observations);

// Lit readings first, then what was read behind cards. Without a model neither offset, walls nor
// cards: what a rough look at the beam needs.
[[nodiscard]] BeamRows RowsOfBeam(const Observations& observations, const LightDescription& light,
                                  const ForwardModel* model);

}  // namespace lightcal::fit
