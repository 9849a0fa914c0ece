// SPDX-License-Identifier: Apache-2.0
#include "lightcal/tradeoff/knobs.h"

#include <array>

namespace lightcal::tradeoff {
namespace {

using Words = std::string_view;

constexpr std::array<Words, 3> kEffects = {"all", "auto", "none"};
constexpr std::array<Words, 2> kSources = {"exact", "point"};
constexpr std::array<Words, 5> kPatches = {"48", "12", "6", "4", "2"};
constexpr std::array kPatchCounts = {48, 12, 6, 4, 2};
constexpr std::array<Words, 2> kRejections = {"robust", "none"};
constexpr std::array<Words, 2> kSwitch = {"on", "off"};
constexpr std::array<Words, 3> kParts = {"all", "half", "third"};
constexpr std::array<Words, 4> kSteps = {"as measured", "5 nm", "10 nm", "20 nm"};
constexpr std::array kStepsNm = {0.0, 5.0, 10.0, 20.0};
constexpr std::array<Words, 4> kIntervals = {"100000 draws", "10000 draws", "1000 draws",
                                             "covariance"};
constexpr std::array kDraws = {100000, 10000, 1000, 0};
constexpr std::array<Words, 4> kTables = {"as in the file", "2.5 deg", "5 deg", "10 deg"};
constexpr std::array kTableStepsDeg = {0.0, 2.5, 5.0, 10.0};
constexpr std::array<Words, 5> kSizes = {"full", "half averaged", "half", "quarter averaged",
                                         "quarter"};
constexpr std::array kStrides = {1, 2, 2, 4, 4};
constexpr std::array<Words, 2> kRatios = {"measured", "labels"};

constexpr std::array<Knob, 16> kKnobs = {{
    {"effects", "which effects the gate lets in", Stage::kFit, kEffects, 1,
     [](AccuracyProfile& p, std::size_t i) { p.effects = kEffects[i]; }},
    {"source_model", "the size of the lamp near the meter", Stage::kFit, kSources, 0,
     [](AccuracyProfile& p, std::size_t i) { p.estimator.exact_source = i == 0; }},
    {"bounce_patches", "patches along each side of the room's walls", Stage::kFit, kPatches, 2,
     [](AccuracyProfile& p, std::size_t i) { p.estimator.bounce_patches = kPatchCounts[i]; }},
    {"solver", "how the estimate is solved", Stage::kFit, kSolverWords, 1,
     [](AccuracyProfile& p, std::size_t i) { p.estimator.solver = static_cast<SolverChoice>(i); }},
    {"rejection", "whether readings that disagree are found", Stage::kFit, kRejections, 0,
     [](AccuracyProfile& p, std::size_t i) { p.estimator.reject = i == 0; }},
    {"leave_one_out", "predicting each reading from the others", Stage::kFit, kSwitch, 0,
     [](AccuracyProfile& p, std::size_t i) { p.estimator.leave_one_out = i == 0; }},
    {"intervals", "draws behind the 95 % intervals", Stage::kFit, kIntervals, 3,
     [](AccuracyProfile& p, std::size_t i) { p.estimator.interval_samples = kDraws[i]; }},
    {"readings", "readings of each light that count", Stage::kFit, kParts, 0,
     [](AccuracyProfile& p, std::size_t i) { p.reading_stride = static_cast<int>(i) + 1; }},
    {"spectral_step", "step of the spectra", Stage::kSpectra, kSteps, 0,
     [](AccuracyProfile& p, std::size_t i) { p.spectral_step_nm = kStepsNm[i]; }},
    {"table_step", "step of photometric tables", Stage::kExport, kTables, 0,
     [](AccuracyProfile& p, std::size_t i) { p.table_step_deg = kTableStepsDeg[i]; }},
    {"cct_method", "colour temperature of a chromaticity", Stage::kFit, kCctMethodWords, 0,
     [](AccuracyProfile& p, std::size_t i) { p.cct_method = static_cast<CctMethod>(i); }},
    {"frames", "frames of a bracket", Stage::kPictures, kParts, 0,
     [](AccuracyProfile& p, std::size_t i) { p.pictures.frame_stride = static_cast<int>(i) + 1; }},
    {"pixels", "size at which pictures are merged, by averaging or by leaving out",
     Stage::kPictures, kSizes, 0,
     [](AccuracyProfile& p, std::size_t i) {
       p.pictures.pixel_stride = kStrides[i];
       p.pictures.average_pixels = i % 2 == 1;
     }},
    {"merge_estimator", "how a sample is made of its frames", Stage::kPictures,
     kMergeEstimatorWords, 0,
     [](AccuracyProfile& p, std::size_t i) {
       p.pictures.estimator = static_cast<MergeEstimator>(i);
     }},
    {"exposure_ratios", "exposures relative to each other", Stage::kPictures, kRatios, 0,
     [](AccuracyProfile& p, std::size_t i) { p.pictures.measure_ratios = i == 0; }},
    {"frame_checks", "looking for flicker and for what moved", Stage::kPictures, kSwitch, 0,
     [](AccuracyProfile& p, std::size_t i) { p.pictures.check_frames = i == 0; }},
}};

}  // namespace

std::span<const Knob> Knobs() { return kKnobs; }

AccuracyProfile StrictProfile(double tolerance_relative) {
  AccuracyProfile profile;
  for (const Knob& knob : kKnobs) knob.set(profile, 0);
  profile.tolerance_relative = tolerance_relative;
  return profile;
}

AccuracyProfile StrictCheckProfile(double tolerance_relative) {
  AccuracyProfile profile = StrictProfile(tolerance_relative);
  profile.estimator.solver = SolverChoice::kQuick;
  profile.estimator.bounce_patches = 64;
  profile.estimator.interval_samples /= 2;
  return profile;
}

}  // namespace lightcal::tradeoff
