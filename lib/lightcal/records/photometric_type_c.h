// SPDX-License-Identifier: Apache-2.0
// Distributions of any type as type C, which every format and engine knows.
#pragma once

#include "lightcal/core/result.h"
#include "lightcal/records/photometric_file.h"

namespace lightcal {

// A table of type A or B sampled as type C for formats and engines that know no other: every 2.5
// degrees of C, every degree of gamma, or finer where the file is. Type C comes back as it is.
[[nodiscard]] Result<PhotometricFile> AsTypeC(PhotometricFile file);

// The table as type C with nadir along the lamp's aim, which for type A is its own (0, 0). Type C
// comes back as it is, B and A are sampled as by AsTypeC.
[[nodiscard]] Result<IntensityTable> AboutItsAim(IntensityTable table);

}  // namespace lightcal
