// SPDX-License-Identifier: Apache-2.0
// What `lightcal dome` writes.
#pragma once

#include <string>

#include "lightcal/calibrate/dome/make_dome.h"
#include "lightcal/core/result.h"
#include "output_files.h"

namespace lightcal::app {

// The dome as it was read, tone-mapped, every light ringed and named, those that
// will be taken out in full lines.
[[nodiscard]] Result<OutputFile> DomePreview(const std::string& path, const MadeDome& made);

// The made dome as a lat-long OpenEXR of 32 bit floats. `made` must outlive the call.
[[nodiscard]] OutputWriter DomeExr(const std::string& path, const MadeDome& made,
                                   const DomeSettings& settings);

}  // namespace lightcal::app
