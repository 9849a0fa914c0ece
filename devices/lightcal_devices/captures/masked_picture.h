// SPDX-License-Identifier: Apache-2.0
// A picture some of whose pixels hold no light: for who measures regions of it and can do without.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/frame.h"

namespace lightcal {

struct MaskedPicture {
  Frame frame;                      // samples of masked pixels are 0
  std::vector<std::size_t> masked;  // ascending, y * width + x: NaN, infinite or beyond 1e30
};
// As ReadPicture (picture.h), but for bad_samples.
[[nodiscard]] Result<MaskedPicture> ReadMaskedPicture(const std::string& path);

}  // namespace lightcal
