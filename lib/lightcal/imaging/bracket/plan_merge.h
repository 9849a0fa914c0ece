// SPDX-License-Identifier: Apache-2.0
// Everything a merge has to find out before it touches every pixel: clip, exposures, noise.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/imaging/bracket/merge_bracket.h"
#include "lightcal/imaging/bracket/signal.h"
#include "lightcal/records/frame.h"

namespace lightcal {

struct MergeRequest {
  // Of each frame, from tags: any common unit (time ISO / N^2), above 0.
  std::vector<double> label_exposure;
  bool keep_labels = false;  // exposures were found with the response of codes, or are not asked
  bool stated_response = false;                          // of codes: not found from the frames
  double power_sd = 0.0, power_reach = 0.0;              // of encoded frames: CodeExposures
  std::optional<NoiseProfile> noise;                     // known for all frames; else
  std::vector<std::vector<NoiseProfile>> noise_in_file;  // of each frame, may be empty
  bool noise_of_camera = false;  // the latter comes from a camera's profile, not from the files
  // Samples are means of n x n (AverageFrame): what is known of noise and pixels above, or assumed,
  // is of single ones.
  int samples_averaged = 1;
  FrameDone done;  // of the frames as given
};

enum class NoiseSource { kGiven, kCamera, kFile, kEstimated, kAssumed };

struct PlannedMerge {
  MergePlan plan;  // for frames in the order below
  // order[i] = which of the frames given is the merge's i-th; shortest exposure first.
  std::vector<std::size_t> order;
  std::vector<double> ln_exposure;  // of the merge's i-th frame, in the labels' unit
  std::vector<double> sd_ln;
  std::vector<bool> measured;
  std::vector<double> usable_share;  // of each frame's samples, below the level believed
  // Of the gauge: what the labels leave uncertain about all exposures together (1 sigma, relative).
  double gauge_sd = 0.0;
  NoiseSource noise_source = NoiseSource::kEstimated;
  // duplicate_frame, ratio_from_label, exposure_off, labels_disagree, noise_disagrees,
  // noise_assumed, one_frame
  Warnings warnings;
};

// Sorts `frames` by their true exposure and sets their clip.
// Refused: all_saturated, all_black (nothing stands out of the noise), one_frame (a single frame
// whose noise nobody knows), exposures_disagree (as MeasureExposureRatios; and a frame that shows
// next to nothing where the labels and another frame foretell light), no_frames.
[[nodiscard]] Result<PlannedMerge> PlanMerge(std::vector<SignalFrame>& frames,
                                             const MergeRequest& request);

}  // namespace lightcal
