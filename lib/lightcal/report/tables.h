// SPDX-License-Identifier: Apache-2.0
// The tables under a light's figures.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lightcal/records/fitted_light.h"
#include "lightcal/report/report_extras.h"

namespace lightcal::report {

// A heading over a table of label and value; the values are HTML.
[[nodiscard]] std::string PairTable(std::string_view heading,
                                    const std::vector<std::pair<std::string, std::string>>& rows);

// How sure, and why: readings, degrees of freedom, rms, leave-one-out, learned, prior.
[[nodiscard]] std::string FitTable(const FitDiagnostics& fit);
// Every reading against the model.
[[nodiscard]] std::string ReadingTable(const std::vector<ResidualRow>& rows);
// What each engine makes of a dome's picture six ways; "" where no picture was given.
[[nodiscard]] std::string AroundTable(std::string_view light, const std::vector<ParityRow>& rows);
// What each engine makes of the light where a meter stood, and whether the engine was run.
[[nodiscard]] std::string ParityTable(std::string_view light, const std::vector<ParityRow>& rows);
// Where the uncertainty comes from: share of the variance, and what would halve each part.
[[nodiscard]] std::string BudgetTable(const std::vector<BudgetPart>& budget);
// The same of a measured distribution: standard deviations of its peak and its flux by cause.
[[nodiscard]] std::string DistributionBudgetTable(const FittedLight& light);

// The gate: what was considered, at most how large, what came of it.
[[nodiscard]] std::string EffectTable(const std::vector<EffectReport>& effects);

}  // namespace lightcal::report
