// SPDX-License-Identifier: Apache-2.0
// The photometric files of a session's lights.
#pragma once

#include <string>
#include <vector>

#include "lightcal/calibrate/evidence.h"
#include "lightcal/core/result.h"
#include "lightcal/records/session.h"
#include "lightcal/records/sources.h"

namespace lightcal {

// A photometric light with its distribution: from its `distribution` file, else from
// captures/<light>.ies or .ldt. The table becomes type C about the lamp's own aim; its flux stands
// for the data sheet's where the session gives none. A light without a file stays as it is. Tables
// are thinned to `step_deg` where it is above 0 (thin_table.h). Fails and refused: as
// Sources::read_photometric. Refused: several_distributions.
[[nodiscard]] Result<LightDescription> WithDistribution(const Session& session,
                                                        const LightDescription& light,
                                                        double step_deg, const Sources& sources,
                                                        Evidence& evidence);

// captures/<light>.ies and .ldt, those that exist.
[[nodiscard]] std::vector<std::string> DistributionFilesOf(const Session& session,
                                                           const std::string& light,
                                                           const Sources& sources);

// several_distributions: both files describe one light.
[[nodiscard]] tl::unexpected<Error> SeveralDistributions(const std::string& light,
                                                         const std::string& one,
                                                         const std::string& other);

}  // namespace lightcal
