// SPDX-License-Identifier: Apache-2.0
// Distributions of any type as type C, which every format and engine knows.
#pragma once

#include "lightcal/core/result.h"
#include "lightcal/records/photometric_file.h"

namespace lightcal {

// A table of type A or B sampled as type C for formats, engines and sessions that know no other:
// every 2.5 degrees of C, every degree of gamma, or finer where the file is. (0, 0) becomes nadir,
// the lamp's aim. Type C comes back as it is.
[[nodiscard]] Result<IntensityTable> AsTypeC(IntensityTable table);
[[nodiscard]] Result<PhotometricFile> AsTypeC(PhotometricFile file);

}  // namespace lightcal
