// SPDX-License-Identifier: Apache-2.0
// What `merge` was asked, and the bracket merged by it.
#pragma once

#include <string>
#include <vector>

#include "console.h"
#include "lightcal/core/result.h"
#include "lightcal/imaging/bracket/merge_frames.h"
#include "lightcal/imaging/bracket/shutter_check.h"
#include "lightcal/records/sources.h"

namespace lightcal::app {

struct MergeOptions {
  std::vector<std::string> frames;
  std::string output, sigma, response, response_output;
  std::vector<std::string> exposures;
  std::string f_number, t_stop, iso;
  std::string anchor, anchor_sigma = "5%";
  std::vector<double> noise;
  std::string space, white;
  std::string camera, nd, lamp_class, cos4;
  bool no_flat = false;
  std::string align = "off", mains, pwm;
  bool uncompressed = false, force = false;
};

// A bracket whose frames are named and timed, not yet read.
struct OpenedMerge {
  Sources sources;
  BracketMergeRequest request;  // a sigma, where options.sigma names its file
  Bracket bracket;
  LampsOnSet lamps;
};
// Wrong usage: what cannot be read. Refused: as Sources::open_bracket, RefuseHopelessShutter.
[[nodiscard]] Result<OpenedMerge> OpenMerge(const MergeOptions& options);
// Warnings go to the console. Refused: as MergeBracket.
[[nodiscard]] Result<MergedBracket> MergeOpened(const OpenedMerge& opened, Console& console);
// "frames", "scale", "clipped_fraction", "noise", "crop", "camera", "width", "height".
[[nodiscard]] Node DocumentOf(const MergedBracket& merged);

}  // namespace lightcal::app
