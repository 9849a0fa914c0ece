// SPDX-License-Identifier: Apache-2.0
// Files -> the frames of one bracket, in order of exposure, with exposures that can be trusted.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/bracket.h"
#include "lightcal/records/frame.h"
#include "lightcal_devices/captures/raw.h"

namespace lightcal::devices {

// Paths and wildcards (*, ?, [..]) -> files: each wildcard's matches by name, digits as numbers.
// Fails: not_found (nothing matches).
[[nodiscard]] Result<std::vector<std::string>> ExpandFiles(std::span<const std::string> patterns);

// Reads every file's tags. The frames must be of one size, one meaning and one colour filter
// pattern. A frame without exposure time is kept with time absent (the merge measures ratios or
// refuses).
// Refused: mixed_size, mixed_kind, exposure_count (overrides and files differ in number), and as
// ReadRawInfo and ReadPictureInfo.
[[nodiscard]] Result<Bracket> OpenBracket(std::span<const std::string> patterns,
                                          const BracketOverrides& overrides = {},
                                          OpenFiles* files = nullptr);

// The frame's samples; their exposure is that of `info`, overrides included. Fails besides:
// file_changed.
[[nodiscard]] Result<Frame> LoadFrame(const FrameInfo& info,
                                      SampleStore store = SampleStore::kMemory,
                                      OpenFiles* files = nullptr);

// One picture of any kind: RAW by ReadRaw, others by ReadPicture.
[[nodiscard]] Result<FrameInfo> ReadFrameInfo(const std::string& path, OpenFiles* files = nullptr);
[[nodiscard]] Result<Frame> ReadFrame(const std::string& path,
                                      SampleStore store = SampleStore::kMemory,
                                      OpenFiles* files = nullptr);

}  // namespace lightcal::devices
