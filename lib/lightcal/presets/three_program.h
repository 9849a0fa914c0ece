// SPDX-License-Identifier: Apache-2.0
// The part of <stem>.three.js that is the same for every preset.
#pragma once

#include <string_view>

namespace lightcal {

// Before and after the preset's JSON.
extern const std::string_view kThreeProgramHead;
extern const std::string_view kThreeProgramTail;

}  // namespace lightcal
