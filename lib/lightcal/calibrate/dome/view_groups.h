// SPDX-License-Identifier: Apache-2.0
// The frames of several brackets, one after another -> each bracket's.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/sources.h"

namespace lightcal {

// `frames` files a group, in the order of their times where every file has one and they differ,
// else as they were given. In every group the same ratios of exposure come in the same order.
// Refused: bracket_count (files are no multiple of `frames`), bracket_pattern (a group whose
// exposures are not those of the first one's, or are all one), naming the file; and as
// Sources::read_frame_info.
[[nodiscard]] Result<std::vector<std::vector<std::string>>> GroupBrackets(
    std::vector<std::string> files, int frames, const Sources& sources);

}  // namespace lightcal
