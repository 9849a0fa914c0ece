// SPDX-License-Identifier: Apache-2.0
// The frames of a bracket loaded and planned: all that a merge needs until the picture is made.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/imaging/bracket/align_frames.h"
#include "lightcal/imaging/bracket/merge_frames.h"
#include "lightcal/imaging/bracket/plan_merge.h"
#include "lightcal/imaging/bracket/response.h"
#include "lightcal/imaging/bracket/sample_corrections.h"
#include "lightcal/imaging/bracket/signal.h"
#include "lightcal/imaging/bracket/thin_frame.h"
#include "lightcal/imaging/camera/sensor_to_xyz.h"

namespace lightcal {

// Of the time that a merge takes, in the middle.
inline constexpr double kLoadingShare = 0.6;

struct PreparedFrames {
  std::vector<Frame> frames;  // as they are merged: made smaller where asked
  Thinning thinning;
  ResponseCurves response;
  std::vector<double> label_errors;  // CodeExposures::off of each frame, where they were measured
  bool labels_certain = true;        // CodeExposures::certain
  std::vector<SignalFrame> signals;
  PlannedMerge planned;
  std::optional<FrameAlignment> alignment;
  PictureColor color;
  std::vector<int> masked;  // x, y, x, y, ... of the whole picture: no number in some frame
  SampleCorrections corrections;
};

inline void Append(const Warnings& from, Warnings& to) {
  to.insert(to.end(), from.begin(), from.end());
}

// Frames load at once, from 512 MB of samples on into scratch files that lie in memory by bands.
// Refused as MergeFrames.
[[nodiscard]] Result<std::unique_ptr<PreparedFrames>> PrepareFrames(
    const BracketMergeRequest& request, const Bracket& bracket, const FrameLoader& load,
    Warnings& warnings);

}  // namespace lightcal
