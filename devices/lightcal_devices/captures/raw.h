// SPDX-License-Identifier: Apache-2.0
// Camera RAW and DNG files -> sensor values with their levels and exposure (LibRaw, in a process of
// its own: a file made to harm ends that process and is refused).
#pragma once

#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/frame.h"

namespace lightcal::devices {

class OpenFiles;  // mapped_file.h: here and below, opens the file where given

// True where the name ends as those of camera RAW files do; says nothing of the file.
[[nodiscard]] bool LooksLikeRaw(const std::string& path);

// The file's tags only: no sample is decoded.
// Fails: not_found, unreadable. Refused: unknown_format, bad_picture (truncated or corrupt),
// unsupported_picture (float or layered RAW that LibRaw cannot give as sensor values). Fails
// besides: no_process.
[[nodiscard]] Result<FrameInfo> ReadRawInfo(const std::string& path, OpenFiles* files = nullptr);

// The sensor values themselves: uint16, the active area, black not subtracted, nothing scaled,
// demosaiced or clamped. Where rows or columns have a black of their own (DNG BlackLevelDeltaV, H),
// float, that part of it taken off.
// Fails and refuses as ReadRawInfo; Fails: no_scratch_space.
[[nodiscard]] Result<Frame> ReadRaw(const std::string& path,
                                    SampleStore store = SampleStore::kMemory,
                                    OpenFiles* files = nullptr);

}  // namespace lightcal::devices
