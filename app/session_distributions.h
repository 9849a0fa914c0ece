// SPDX-License-Identifier: Apache-2.0
// The photometric files of a session's lights.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/session.h"
#include "output_files.h"

namespace lightcal::app {

// Fills the distribution of every photometric light: from its `distribution` file, else from
// captures/<light>.ies or .ldt, where `import` puts it. The table becomes type C about the lamp's
// own aim; its flux stands for the data sheet's where the session gives none. A light without a
// file stays as it is. Tables are thinned to `step_deg` where it is above 0 (thin_table.h). Files
// read are noted as inputs. Fails: as ReadPhotometricFile. Refused:
// several_distributions.
[[nodiscard]] Result<void> ResolveDistributions(double step_deg, Session& session,
                                                Warnings& warnings);

// Whether a file's name ends as photometric files do: .ies, .ldt.
[[nodiscard]] bool IsPhotometricName(const std::string& path);

// What importing a photometric file for a light would write: captures/<light>.ies or .ldt. Empty
// where the session holds the very file. Refused: light_missing, unknown_light, kind_mismatch,
// several_distributions, and as ReadPhotometricFile.
struct PlannedDistribution {
  std::string light;
  double flux_lm = 0.0, peak_cd = 0.0;
  std::vector<OutputFile> files;
  Warnings warnings;
};
[[nodiscard]] Result<PlannedDistribution> PlanDistribution(const Session& session,
                                                           const std::string& path,
                                                           const std::string& light);

}  // namespace lightcal::app
