// SPDX-License-Identifier: Apache-2.0
// What LibRaw and the tags know of an opened RAW -> FrameInfo.
#pragma once

#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/frame.h"
#include "lightcal_devices/captures/raw_tags.h"

namespace lightcal {

// Black, white and maximum as they stand now: LibRaw knows some only after it decoded the samples.
[[nodiscard]] SensorLevels SensorLevelsOf(const LibRaw& raw, const Periodic2d<std::uint8_t>& cfa);

// Refused: unsupported_picture (a colour filter array lightcal does not know).
[[nodiscard]] Result<FrameInfo> FrameInfoOf(const LibRaw& raw, const RawTags& tags,
                                            const std::string& path);

}  // namespace lightcal
