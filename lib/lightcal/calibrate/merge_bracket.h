// SPDX-License-Identifier: Apache-2.0
// Pictures of one scene, differently exposed -> its luminance in cd/m^2, with a sigma.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/imaging/bracket/merge_frames.h"
#include "lightcal/records/response_curves.h"
#include "lightcal/records/sources.h"

namespace lightcal {

// The response of codes that `name` is a word for, or the table in the file at `path`.
// Refused: bad_response. Fails: not_found, unreadable.
[[nodiscard]] Result<ResponseCurves> ReadResponse(const std::string& name, const std::string& path,
                                                  const Sources& sources);

// The frames of a bracket that was opened before.   Refused: as MergeFrames.
[[nodiscard]] Result<MergedBracket> MergeBracket(const Bracket& bracket, const Sources& sources,
                                                 const BracketMergeRequest& request);

// Files, or wildcards. Refused: as Sources::open_bracket and MergeFrames.
[[nodiscard]] Result<MergedBracket> MergeBracket(const std::vector<std::string>& files,
                                                 const Sources& sources,
                                                 const BracketMergeRequest& request);

}  // namespace lightcal
