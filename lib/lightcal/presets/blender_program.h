// SPDX-License-Identifier: Apache-2.0
// The part of <stem>.blender.py that is the same for every preset.
#pragma once

#include <string_view>

namespace lightcal {

// Before and after the preset's JSON, which stands between them in a raw quoted string.
extern const std::string_view kBlenderProgramHead;
extern const std::string_view kBlenderProgramTail;

}  // namespace lightcal
