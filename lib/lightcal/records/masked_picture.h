// SPDX-License-Identifier: Apache-2.0
// A picture some of whose pixels hold no light: for who can do without them, and says so.
#pragma once

#include <cstddef>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/frame.h"

namespace lightcal {

struct MaskedPicture {
  // Masked pixels hold what FillMasked makes of them.
  Frame frame;
  std::vector<std::size_t> masked;  // ascending, y * width + x: NaN, infinite or beyond 1e30
};

// bad_samples: how many pixels are masked, which is the first, and that their neighbours stand in.
[[nodiscard]] Warning WarningOfMasked(const MaskedPicture& picture);

}  // namespace lightcal
