// SPDX-License-Identifier: Apache-2.0
// What an estimate says of its readings one by one, and of itself.
#pragma once

#include <optional>
#include <string>

#include "lightcal/fit/estimate_light.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/fit/model/prepare.h"
#include "lightcal/fit/model/robust.h"

namespace lightcal::fit {

// What is to be said of the first place that one meter read twice with more between than it
// repeats, though no more than one lamp's light drifts.
[[nodiscard]] std::optional<std::string> FirstUnrepeated(const Observations& observations);

// The warnings row_rejected, bimodal and suspicious_reading.
void WarnOfRows(const RobustEstimate& estimate, const Prepared& prepared,
                const Observations& observations, const std::string& light, Warnings& warnings);

// Which of the parameters the readings decided, which their priors; data_sheet among these where
// the maker's figures are rows of the estimate.
void NameLearned(const Estimation& estimation, const Covariance& covariance, bool distance_law,
                 FitDiagnostics& diagnostics);

// Readings used and rejected, scatter and leave-one-out of an estimate whose learned parameters are
// named.
void FillDiagnostics(const RobustEstimate& estimate, const Prepared& prepared,
                     const Observations& observations, LightEstimate& out);

// Scatter that sigma explains in fewer than one of twenty sessions widens every row by the Birge
// ratio sqrt(chi2/dof). Widening by every ratio above 1 would make honest intervals too wide.
[[nodiscard]] double BirgeRatio(const Estimation& estimation, const Theta& theta, int dof);

// Every lit reading against the model; `all` are the rows before any was rejected.
void FillResiduals(const RobustEstimate& estimate, const Estimation& all, const Prepared& prepared,
                   const Observations& observations, LightEstimate& out);

}  // namespace lightcal::fit
