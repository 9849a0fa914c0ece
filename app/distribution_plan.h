// SPDX-License-Identifier: Apache-2.0
// What importing a photometric file for a light would write.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/session.h"
#include "output_files.h"

namespace lightcal::app {

// Whether a file's name ends as photometric files do: .ies, .ldt.
[[nodiscard]] bool IsPhotometricName(const std::string& path);

struct PlannedDistribution {
  std::string light;
  double flux_lm = 0.0, peak_cd = 0.0;
  std::vector<OutputFile> files;  // captures/<light>.ies or .ldt; none where it is there already
  Warnings warnings;
};
// Refused: light_missing, unknown_light, kind_mismatch, several_distributions, and as
// ReadPhotometricFile.
[[nodiscard]] Result<PlannedDistribution> PlanDistribution(const Session& session,
                                                           const std::string& path,
                                                           const std::string& light);

}  // namespace lightcal::app
