// SPDX-License-Identifier: Apache-2.0
// How much work each step of a calibration does: what `tradeoff` varies, and what a profile.json
// holds for `fit` and `run`.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "lightcal/colorimetry/cct_approximations.h"
#include "lightcal/core/result.h"
#include "lightcal/records/document.h"

namespace lightcal {

enum class SolverChoice : std::uint8_t {
  kFull,        // ceres::Solve to the last digit
  kQuick,       // Newton's steps or TinySolver, where both fail the full solver; the same to 1e-9
  kLoose,       // ceres::Solve to 1e-3 of the cost, without the last steps
  kClosedForm,  // the linear start alone
};
inline constexpr std::array<std::string_view, 4> kSolverWords = {"full", "quick", "loose",
                                                                 "closed_form"};

// How a sample of a bracket is made of its frames.
enum class MergeEstimator : std::uint8_t {
  kLikelihood,  // each frame by its own noise there: maximum likelihood
  kSums,        // signals and exposures summed: the same where shot noise rules
  kLongest,     // the longest frame that is not clipped there, alone
};
inline constexpr std::array<std::string_view, 3> kMergeEstimatorWords = {"likelihood", "sums",
                                                                         "longest"};

struct EstimatorChoice {
  SolverChoice solver = SolverChoice::kQuick;
  bool reject = true;         // robust starts and rejection of readings that disagree
  bool leave_one_out = true;  // the error of predicting each reading from the others
  bool exact_source = true;   // the size of lamps near the meter; false: each a point
  int bounce_patches = 6;     // along each side of each wall of the [room]
  int interval_samples = 0;   // draws behind the intervals (JCGM 101); 0: from the covariance
};

struct PictureChoice {
  int frame_stride = 1;         // every n-th frame of a bracket, the shortest among them
  int pixel_stride = 1;         // one of n blocks of the colour filter pattern, both ways
  bool average_pixels = false;  // the mean of the n x n blocks instead of the first of them
  MergeEstimator estimator = MergeEstimator::kLikelihood;
  bool measure_ratios = true;  // exposure ratios from the pixels; false: as the files say
  bool check_frames = true;    // for flicker and what moved between the frames
};

struct AccuracyProfile {
  double tolerance_relative = 0.01;  // of the effect gate
  std::string effects = "auto";      // auto | all | none | +a,-b
  EstimatorChoice estimator{};
  CctMethod cct_method = CctMethod::kExact;
  int reading_stride = 1;         // every n-th reading of a light, in the session's order
  double spectral_step_nm = 0.0;  // spectra thinned to this step; 0 = as they were measured
  double table_step_deg = 0.0;    // photometric tables thinned to this step; 0 = as in their files
  PictureChoice pictures{};
};

inline constexpr std::string_view kProfileSchema = "lightcal.profile/1";

[[nodiscard]] records::Node DocumentOf(const AccuracyProfile& profile);
// A profile.json.  Fails: not_finite.
[[nodiscard]] Result<std::string> AccuracyProfileToJson(const AccuracyProfile& profile);
// Refused: bad_profile, unknown_key. `where` names the file in messages. Keys left out keep their
// default; what `tradeoff` found about the profile ("measured") is passed over.
[[nodiscard]] Result<AccuracyProfile> AccuracyProfileFromJson(std::string_view text,
                                                              std::string_view where);

}  // namespace lightcal
