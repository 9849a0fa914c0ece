// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/plan_merge.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lightcal/core/numbers_text.h"
#include "lightcal/imaging/bracket/all_saturated.h"
#include "lightcal/imaging/bracket/encoded_errors.h"
#include "lightcal/imaging/bracket/exposure_ratios.h"
#include "lightcal/imaging/bracket/noise_shares.h"
#include "lightcal/imaging/bracket/sampled.h"
#include "lightcal/imaging/bracket/top_values.h"

namespace lightcal {
namespace {

constexpr std::size_t kSamples = 300'000;
constexpr double kNoiseDisagreement = 0.2;  // relative, of variances
constexpr double kMiddleSignal = 0.2;
constexpr double kStandsOut = 8.0;    // standard deviations of the dark
constexpr double kLeastShare = 1e-5;  // of the samples that must stand out
constexpr double kEncodedFloor = 0.003;

double MeanOf(std::span<const NoiseProfile> planes, double NoiseProfile::* member) {
  double sum = 0.0;
  for (const NoiseProfile& plane : planes) sum += plane.*member;
  return sum / static_cast<double>(planes.size());
}

// Of the mean of n x n samples, whose own is given.
NoiseProfile NoiseOfMean(const NoiseProfile& noise, int n) {
  const double count = static_cast<double>(n) * n;
  return {noise.scale / count, noise.offset / count};
}

std::optional<std::vector<NoiseProfile>> NoiseInFiles(const MergeRequest& request,
                                                      std::span<const std::size_t> order) {
  if (request.noise_in_file.size() != order.size()) return std::nullopt;
  std::vector<NoiseProfile> noise;
  for (const std::size_t i : order) {
    const auto& planes = request.noise_in_file[i];
    if (planes.empty()) return std::nullopt;
    noise.push_back(
        NoiseOfMean({MeanOf(planes, &NoiseProfile::scale), MeanOf(planes, &NoiseProfile::offset)},
                    request.samples_averaged));
    if (!(noise.back().scale >= 0.0) || !(noise.back().offset > 0.0)) return std::nullopt;
  }
  return noise;
}

double VarianceAt(const NoiseProfile& noise, double signal) {
  return noise.scale * signal + noise.offset;
}

// Of codes that nothing else tells of: a middling sensor's, and an error of one code in 8 bits
// (rounding, compression), by the steps of the curve in the dark and at middle grey.
NoiseProfile NoiseOfCodes(const ResponseCurves& response, int channels) {
  constexpr float kGrey = 0.18F;
  const auto& curve = response.signal_of_code[channels == 3 ? 1 : 0];
  NoiseProfile noise = kMiddlingNoise;
  if (curve.size() > 256) return noise;
  const auto step = [&](std::size_t code) { return double{curve[code + 1]} - curve[code]; };
  const auto grey =
      static_cast<std::size_t>(std::ranges::lower_bound(curve, kGrey) - curve.begin());
  const double dark = step(1) * step(1);
  noise.offset += dark;
  noise.scale +=
      std::max(0.0, (std::pow(step(std::max<std::size_t>(grey, 1) - 1), 2) - dark) / kGrey);
  return noise;
}

// The variance that the rounding of dark codes leaves, which levels above hide when noise is found.
double RoundingOf(const ResponseCurves& response, int channels) {
  constexpr std::size_t kDark = 6;  // codes; a power law's first step is far below its second
  const auto& curve = response.signal_of_code[channels == 3 ? 1 : 0];
  const double step = double{curve[std::min(kDark, curve.size() - 1)]} / kDark;
  return step * step / 12.0;
}

// Noise of every frame in the merge's order, and where it is from.
Result<void> ChooseNoise(const SampledSignals& signals, const MergeRequest& request,
                         std::span<const SignalFrame> frames, PlannedMerge& planned) {
  const std::size_t n = frames.size();
  if (request.noise) {
    planned.noise_source = NoiseSource::kGiven;
    planned.plan.noise.assign(n, NoiseOfMean(*request.noise, request.samples_averaged));
    return {};
  }
  std::vector<double> shares;
  for (const SignalFrame& frame : frames) {
    shares.push_back(frame.shares ? frame.shares->Mean(frame.width, frame.height) : 1.0);
  }
  const auto estimate = EstimateNoise(signals, planned.plan.exposure, shares);
  if (const auto file = NoiseInFiles(request, planned.order)) {
    planned.noise_source = request.noise_of_camera ? NoiseSource::kCamera : NoiseSource::kFile;
    planned.plan.noise = *file;
    if (!estimate) return {};
    const double ratio =
        VarianceAt(*estimate, kMiddleSignal) / VarianceAt((*file)[n / 2], kMiddleSignal);
    if (std::abs(ratio - 1.0) > kNoiseDisagreement) {
      planned.warnings.push_back(
          {"noise_disagrees", frames[n / 2].name,
           "the frames scatter " + RoundedText(ratio, 2) + " times what the " +
               (request.noise_of_camera ? "camera's profile" : "file's NoiseProfile") +
               " says (variance), which is used: the scene moved, or the profile is wrong; "
               "{merge.noise} replaces it"});
    }
    return {};
  }
  planned.noise_source = NoiseSource::kEstimated;
  planned.plan.noise.assign(
      n, estimate.value_or(NoiseOfMean(kMiddlingNoise, request.samples_averaged)));
  if (frames[0].response != nullptr) {
    for (NoiseProfile& noise : planned.plan.noise) {
      noise.offset =
          std::max(noise.offset, RoundingOf(*frames[0].response, frames[0].channels) /
                                     (request.samples_averaged * request.samples_averaged));
    }
  }
  if (estimate) return {};
  if (n == 1 && frames[0].response != nullptr) {
    planned.plan.noise.assign(1, NoiseOfCodes(*frames[0].response, frames[0].channels));
  } else if (n == 1) {
    return Refused("one_frame", frames[0].name,
                   "a single frame does not show its own noise, and its file does not name it; "
                   "give more frames or a DNG with NoiseProfile");
  }
  planned.noise_source = NoiseSource::kAssumed;
  planned.warnings.push_back({"noise_assumed", frames[0].name,
                              "no two frames share enough to show their noise; that of a middling "
                              "sensor" +
                                  std::string(n == 1 ? ", or a code," : "") + " is assumed"});
  return {};
}

// All of ln(level) that a bracket of codes sees, and its standard deviation, each level as often.
// An anchor may be at either end, so two sigma of a power's reach are what it does over all of it.
double RangeOfLevels(const MergePlan& plan) {
  return std::log(plan.exposure.back() / plan.exposure.front() / kEncodedFloor);
}
double SpreadOfLevels(const MergePlan& plan) { return RangeOfLevels(plan) / std::sqrt(12.0); }

// Frames whose samples are all the same as another's: the same file twice.
std::vector<bool> Duplicates(const SampledSignals& signals) {
  std::vector<bool> duplicate(signals.frames.size(), false);
  for (std::size_t j = 1; j < signals.frames.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      if (signals.frames[i] == signals.frames[j]) duplicate[j] = true;
    }
  }
  return duplicate;
}

double ShareAbove(std::span<const float> signals, std::span<const float> clip, double share) {
  std::size_t above = 0;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    if (double{signals[i]} >= share * double{clip[i]}) ++above;
  }
  return static_cast<double>(above) / static_cast<double>(signals.size());
}

tl::unexpected<Error> AllBlack(const std::string& frame) {
  return Refused("all_black", frame,
                 "nothing stands out of the noise in any frame; expose longer, take the lens cap "
                 "off");
}

// Refusals that need no model: nothing to see in any frame.
Result<void> CheckContents(const SampledSignals& signals, std::span<const SignalFrame> frames,
                           std::span<const double> label) {
  if (std::ranges::all_of(signals.frames, [](const auto& frame) {
        return std::ranges::none_of(frame, [](float y) { return y > 0.0F; });
      })) {
    return AllBlack(frames.back().name);
  }
  const auto shortest =
      static_cast<std::size_t>(std::min_element(label.begin(), label.end()) - label.begin());
  if (std::all_of(signals.frames.begin(), signals.frames.end(), [&](const auto& frame) {
        return ShareAbove(frame, signals.clip, 0.9) > 0.9999;
      })) {
    return AllSaturated(frames[shortest].name);
  }
  return {};
}

// The longest frame must show something beyond its own read noise.
Result<void> CheckDark(const SampledSignals& signals, const PlannedMerge& planned,
                       std::span<const SignalFrame> frames) {
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double stands_out = kStandsOut * std::sqrt(planned.plan.noise[i].offset);
    std::size_t seen = 0;
    for (const float y : signals.frames[i]) seen += y > stands_out ? 1U : 0U;
    const double needed =
        std::max(8.0, kLeastShare * static_cast<double>(signals.frames[i].size()));
    if (static_cast<double>(seen) >= needed) return {};
  }
  return AllBlack(frames.back().name);
}

tl::unexpected<Error> LabelsTellNothing(const std::string& frame) {
  return Refused("exposures_disagree", frame,
                 "beside each other the frames were not exposed as their tags or {merge.exposures} "
                 "say, and which exposure is wrong they tell so little that the picture would be "
                 "anything; check the exposures, take more frames, or state a curve that was kept "
                 "from another bracket ({merge.response})");
}

template <class T>
void Permute(std::vector<T>& values, std::span<const std::size_t> order) {
  std::vector<T> sorted;
  sorted.reserve(order.size());
  for (const std::size_t i : order) sorted.push_back(std::move(values[i]));
  values = std::move(sorted);
}

// Leaves out frames that are there twice; `kept` are the indices that stay.
std::vector<std::size_t> DropDuplicates(SampledSignals& signals, std::vector<SignalFrame>& frames,
                                        Warnings& warnings) {
  const std::vector<bool> duplicate = Duplicates(signals);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!duplicate[i]) {
      kept.push_back(i);
      continue;
    }
    warnings.push_back({"duplicate_frame", frames[i].name,
                        "holds the same samples as an earlier frame and is left out: twice the "
                        "same noise is no second measurement"});
  }
  Permute(signals.frames, kept);
  Permute(frames, kept);
  return kept;
}

Result<ExposureRatios> RatiosOf(const SampledSignals& signals, const MergeRequest& request,
                                std::span<const double> label,
                                std::span<const SignalFrame> frames) {
  if (request.keep_labels || frames.size() == 1) {
    ExposureRatios ratios;
    for (const double l : label) ratios.ln_exposure.push_back(std::log(l));
    ratios.sd_ln.assign(label.size(), frames.size() == 1 ? 0.0 : kLabelSd);
    ratios.measured.assign(label.size(), false);
    ratios.power_sd = request.power_sd;
    return ratios;
  }
  std::vector<std::string> names;
  for (const SignalFrame& frame : frames) names.push_back(frame.name);
  const bool stated = frames.front().response != nullptr;
  return MeasureExposureRatios(signals, label, names,
                               stated ? std::optional(CurvePower{}) : std::nullopt);
}

// Pixels that another frame and the labels foretell to be well exposed here, and those that are.
struct Foretold {
  double lit = 0.0, seen = 0.0;
};

Foretold ForetellBy(const SampledSignals& signals, std::size_t other, std::size_t frame,
                    double ratio) {
  constexpr double kWellLit = 0.03, kClear = 0.01, kBelow = 0.9;  // shares of the clip
  const PairClips clips = ClipsOfPair(signals, other, frame);
  Foretold foretold;
  for (std::size_t i = 0; i < clips.clip.size(); ++i) {
    const double clip = clips.clip[i];
    const double known = signals.frames[other][i];
    const bool clear = known > kClear * clip && known < kBelow * clip;
    if (clear && ratio * known > kWellLit * clip) foretold.lit += 1.0;
    if (double{signals.frames[frame][i]} > 0.5 * kWellLit * clip) foretold.seen += 1.0;
  }
  return foretold;
}

// The others, those of the most similar exposure first.
std::vector<std::size_t> OthersByLabel(std::span<const double> label, std::size_t frame) {
  std::vector<std::size_t> others;
  for (std::size_t j = 0; j < label.size(); ++j) {
    if (j != frame) others.push_back(j);
  }
  const auto apart = [&](std::size_t j) { return std::abs(std::log(label[j] / label[frame])); };
  std::ranges::sort(others, {}, apart);
  return others;
}

// A frame whose exposure nobody could measure (a lens cap, a flash that did not fire) is no dark
// frame where the labels foretell light: merged, its zeros would count as a measurement. Counted
// over the whole picture, so that a lamp that moved between frames stays seen.
Result<void> CheckLit(const SampledSignals& signals, std::span<const double> label,
                      const std::vector<bool>& measured, std::span<const SignalFrame> frames) {
  constexpr double kLitSamples = 64.0, kSeenOfLit = 0.1;  // the latter of those foretold
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (measured[i]) continue;
    for (const std::size_t j : OthersByLabel(label, i)) {
      const Foretold foretold = ForetellBy(signals, j, i, label[i] / label[j]);
      if (foretold.lit < kLitSamples) continue;
      if (foretold.seen >= kSeenOfLit * foretold.lit) break;
      return Refused("exposures_disagree", frames[i].name,
                     "it shows next to nothing where " + frames[j].name +
                         " and their exposures, as tags or {merge.exposures} say, foretell a "
                         "well exposed picture (a lens cap? a flash that did not fire?); leave "
                         "this frame out");
    }
  }
  return {};
}

}  // namespace

Result<PlannedMerge> PlanMerge(std::vector<SignalFrame>& frames, const MergeRequest& request) {
  if (frames.empty()) return Refused("no_frames", "merge", "no frame was given");
  PlannedMerge planned;
  FindClipping(frames, request.done);
  std::vector<FrameTops> tops = FindTops(frames, request.done);
  ClipHeldTops(frames, tops, request.label_exposure);
  SampledSignals signals = SampleRows(frames, kSamples, request.done);
  const std::vector<std::size_t> kept = DropDuplicates(signals, frames, planned.warnings);
  std::vector<double> label;
  for (const std::size_t i : kept) label.push_back(request.label_exposure[i]);
  Permute(tops, kept);
  if (auto checked = CheckContents(signals, frames, label); !checked) {
    return Propagate(std::move(checked));
  }
  auto ratios = RatiosOf(signals, request, label, frames);
  if (!ratios) return Propagate(std::move(ratios));
  if (auto lit = CheckLit(signals, label, ratios->measured, frames); !lit) {
    return Propagate(std::move(lit));
  }
  planned.warnings.insert(planned.warnings.end(), ratios->warnings.begin(), ratios->warnings.end());

  std::vector<std::size_t> order(frames.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return ratios->ln_exposure[i] < ratios->ln_exposure[j];
  });
  Permute(frames, order);
  Permute(signals.frames, order);
  Permute(tops, order);
  for (const std::size_t i : order) {
    planned.order.push_back(kept[i]);
    planned.ln_exposure.push_back(ratios->ln_exposure[i]);
    planned.sd_ln.push_back(ratios->sd_ln[i]);
    planned.measured.push_back(ratios->measured[i]);
    planned.plan.exposure.push_back(
        std::exp(ratios->ln_exposure[i] - ratios->ln_exposure[order.front()]));
  }
  const auto joined = std::count(planned.measured.begin(), planned.measured.end(), true);
  planned.gauge_sd =
      std::hypot(kLabelSd / std::sqrt(static_cast<double>(std::max<std::ptrdiff_t>(joined, 1))),
                 ratios->gauge_sd);
  planned.plan.usable = ratios->linear_to;
  planned.plan.part_sd = ratios->part_sd;
  planned.plan.fixed_pattern /= request.samples_averaged;
  for (const auto& frame : signals.frames) {
    planned.usable_share.push_back(1.0 - ShareAbove(frame, signals.clip, planned.plan.usable));
  }
  if (frames.front().response != nullptr) planned.plan.floor = kEncodedFloor;
  if (auto chosen = ChooseNoise(signals, request, frames, planned); !chosen) {
    return Propagate(std::move(chosen));
  }
  ClipContradictedTops(frames, tops, planned.plan, planned.sd_ln);
  if (auto dark = CheckDark(signals, planned, frames); !dark) return Propagate(std::move(dark));
  if (frames.size() == 1) {
    planned.warnings.push_back({"one_frame", frames[0].name,
                                "a single frame: its range is the sensor's, its noise what the "
                                "file says"});
  }
  const auto merger = BracketMerger::Make(frames, planned.plan);
  if (!merger) return tl::unexpected(merger.error());
  const auto done = [&](std::size_t k) {
    if (request.done) request.done(planned.order[k]);
  };
  planned.plan.fixed_pattern = EstimateFixedPattern(*merger, done);
  if (frames.front().response != nullptr) {
    auto errors = MeasureEncodedErrors(*merger, signals, done);
    if (request.stated_response) {
      CheckStatedCurve(errors, frames.front().name, planned.warnings);
    } else {
      errors.toe = ToeOf(*frames.front().response, std::min(frames.front().channels, 3),
                         planned.plan.exposure.back());
      errors.misfit = std::min(errors.misfit, kMostMisfit);
    }
    constexpr double kMostOfReach = 2.5;  // sigma as a share of the picture
    const double of_reach = 0.5 * request.power_reach * RangeOfLevels(planned.plan);
    if (of_reach > kMostOfReach) return LabelsTellNothing(frames.front().name);
    errors.misfit =
        std::hypot(errors.misfit, ratios->power_sd * SpreadOfLevels(planned.plan), of_reach);
    planned.plan.encoded = std::make_shared<const EncodedErrors>(std::move(errors));
  }
  return planned;
}

}  // namespace lightcal
