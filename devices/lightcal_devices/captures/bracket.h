// SPDX-License-Identifier: Apache-2.0
// Files -> the frames of one bracket, in order of exposure, with exposures that can be trusted.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/records/frame.h"
#include "lightcal_devices/captures/raw.h"

namespace lightcal {

// What the session or the command line says against the files; recorded in the frames
// (exposure.overridden).
struct BracketOverrides {
  std::vector<Seconds> exposure;  // one a file, in the order of the files; empty = from the files
  std::optional<double> f_number;
  std::optional<double> t_stop;  // of the two that one stands which is given
  std::optional<double> iso;
};

struct Bracket {
  std::vector<FrameInfo> frames;  // shortest exposure first; frames without a time keep file order
  // duplicate_frame (left out), repeated_exposure, mixed_iso, mixed_aperture, mixed_focus,
  // no_exposure_time, exposure_tags_disagree, lens_shading_not_applied
  Warnings warnings;
};

// Paths and wildcards (*, ?, [..]) -> files: each wildcard's matches by name, digits as numbers.
// Fails: not_found (nothing matches).
[[nodiscard]] Result<std::vector<std::string>> ExpandFiles(std::span<const std::string> patterns);

// Reads every file's tags. The frames must be of one size, one meaning and one colour filter
// pattern. A frame without exposure time is kept with time absent (the merge measures ratios or
// refuses).
// Refused: mixed_size, mixed_kind, exposure_count (overrides and files differ in number), and as
// ReadRawInfo and ReadPictureInfo.
[[nodiscard]] Result<Bracket> OpenBracket(std::span<const std::string> patterns,
                                          const BracketOverrides& overrides = {});

// The frame's samples; their exposure is that of `info`, overrides included. Fails besides:
// file_changed.
[[nodiscard]] Result<Frame> LoadFrame(const FrameInfo& info,
                                      SampleStore store = SampleStore::kMemory);

// One picture of any kind: RAW by ReadRaw, others by ReadPicture.
[[nodiscard]] Result<FrameInfo> ReadFrameInfo(const std::string& path);
[[nodiscard]] Result<Frame> ReadFrame(const std::string& path,
                                      SampleStore store = SampleStore::kMemory);

}  // namespace lightcal
