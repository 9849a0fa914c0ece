// SPDX-License-Identifier: Apache-2.0
// Camera RAW and DNG files -> sensor values with their levels and exposure (LibRaw).
#pragma once

#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/frame.h"

namespace lightcal {

// True where the name ends as those of camera RAW files do; says nothing of the file.
[[nodiscard]] bool LooksLikeRaw(const std::string& path);

// The file's tags only: no sample is decoded.
// Fails: not_found, unreadable. Refused: unknown_format, bad_picture (truncated or corrupt),
// unsupported_picture (float or layered RAW that LibRaw cannot give as sensor values).
[[nodiscard]] Result<FrameInfo> ReadRawInfo(const std::string& path);

// Where decoded samples live. A scratch file is mapped and already deleted: the system drops its
// pages when memory is short, so that any number of frames can be open at once.
enum class SampleStore { kMemory, kScratchFile };

// The sensor values themselves: uint16, the active area, black not subtracted, nothing scaled,
// demosaiced or clamped; without a copy from LibRaw's buffer (kMemory).
// Fails and refuses as ReadRawInfo; Fails: no_scratch_space.
[[nodiscard]] Result<Frame> ReadRaw(const std::string& path,
                                    SampleStore store = SampleStore::kMemory);

}  // namespace lightcal
