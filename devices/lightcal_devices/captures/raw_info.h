// SPDX-License-Identifier: Apache-2.0
// What LibRaw and the tags know of a RAW -> FrameInfo.
#pragma once

#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/frame.h"
#include "lightcal_devices/captures/raw_answer.h"

namespace lightcal::devices {

// Refused: unsupported_picture (a colour filter array lightcal does not know), bad_picture (numbers
// no RAW has).
[[nodiscard]] Result<FrameInfo> FrameInfoOf(const RawAnswer& answer, const std::string& path);

}  // namespace lightcal::devices
