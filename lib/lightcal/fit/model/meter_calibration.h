// SPDX-License-Identifier: Apache-2.0
// What one instrument's own scale adds to everything it read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightcal/fit/estimate_light.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// 1 sigma of ln of a factor on all that the instruments read that saw the lamp lit: of several,
// each by the weight of its readings. 0: none has any.
[[nodiscard]] double SharedCalibration(const Observations& observations);

// One factor on every reading: ln I shifts by it, E0 grows with it; a part of its variance.
void AddCalibration(double calibration, LightEstimate& estimate);

// What makes the interval, with the scale called after what took the readings.
[[nodiscard]] std::vector<BudgetPart> BudgetWithScale(const Observations& observations,
                                                      std::vector<VariancePart> parts);

// The one meter that took every reading, if one did: its factor cancels in the ratio of two
// lamps.
[[nodiscard]] std::optional<MeterShare> MeterOf(const Session& session, const std::string& light,
                                                const Observations& observations);

// The part of the interval that more readings do not lower.
void ReportCalibration(const Observations& observations, std::vector<EffectReport>& effects);

}  // namespace lightcal::fit
