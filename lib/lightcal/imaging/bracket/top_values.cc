// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/top_values.h"

#include <algorithm>
#include <cmath>

#include "lightcal/core/parallel.h"
#include "lightcal/imaging/bracket/sampled.h"

namespace lightcal {
namespace {

constexpr std::size_t kTopPlaces = 64;
constexpr double kThirdStop = 1.2;         // as labels round it: 1/60 and 1/50 s
constexpr double kContradictSigmas = 5.0;  // as the merge's own (signal_kernels.cc)

bool IsUnknown(const SignalFrame& frame, std::size_t channel) {
  return frame.clip[channel] > kClipUnknownFrom;
}

FrameTops TopsOf(const SignalFrame& frame) {
  FrameTops tops;
  std::vector<float> row(frame.row_samples());
  for (int y = 0; y < frame.height; ++y) {
    ReadSignals(frame, y, 0, row);
    const auto& channels = frame.channel[static_cast<std::size_t>(y % frame.row_period)];
    for (std::size_t i = 0; i < row.size(); ++i) {
      const auto channel = static_cast<std::size_t>(channels[i % kLanes]);
      TopValue& top = tops[channel];
      if (row[i] < top.value || !(row[i] > 0.0F) || !IsUnknown(frame, channel)) continue;
      if (row[i] > top.value) top = {row[i], {}};
      if (top.places.size() < kTopPlaces) top.places.push_back({y, i});
    }
  }
  return tops;
}

float SignalAt(const SignalFrame& frame, const TopValue::Place& place) {
  std::array<float, kLanes> lanes{};
  const std::size_t first = place.sample / kLanes * kLanes;
  ReadSignals(frame, place.y, first,
              std::span(lanes).first(std::min<std::size_t>(kLanes, frame.row_samples() - first)));
  return lanes[place.sample - first];
}

float HighestOf(std::span<const FrameTops> tops, std::size_t channel) {
  float highest = 0.0F;
  for (const FrameTops& frame : tops) highest = std::max(highest, frame[channel].value);
  return highest;
}

void SetClip(std::span<SignalFrame> frames, std::size_t channel, float clip) {
  for (SignalFrame& frame : frames) frame.clip[channel] = clip;
}

bool IsHeldByTwo(std::span<const SignalFrame> frames, std::span<const FrameTops> tops,
                 std::span<const double> label, std::size_t channel, float value) {
  for (std::size_t a = 0; a < frames.size(); ++a) {
    if (tops[a][channel].value != value) continue;
    for (std::size_t b = 0; b < frames.size(); ++b) {
      if (!(label[b] > kThirdStop * label[a]) || tops[b][channel].value != value) continue;
      if (std::ranges::any_of(tops[a][channel].places, [&](const TopValue::Place& place) {
            return SignalAt(frames[b], place) == value;
          })) {
        return true;
      }
    }
  }
  return false;
}

// What the frames before `longer` say of it, and the variance of its distance from what it holds.
struct ForetoldSignal {
  double value = 0.0, variance = 0.0;
};

ForetoldSignal ForetoldAt(std::span<const SignalFrame> frames, const MergePlan& plan,
                          std::size_t longer, const TopValue::Place& place, double held) {
  double sum = 0.0, exposure = 0.0, shot = 0.0, read = 0.0;
  for (std::size_t k = 0; k < longer; ++k) {
    sum += SignalAt(frames[k], place);
    exposure += plan.exposure[k];
    shot += plan.noise[k].scale * plan.exposure[k];
    read += plan.noise[k].offset;
  }
  const double ratio = plan.exposure[longer] / exposure;
  const double value = ratio * std::max(sum, 0.0);
  return {value, ratio * (shot * value / exposure + ratio * read) +
                     plan.noise[longer].scale * held + plan.noise[longer].offset +
                     std::pow(plan.fixed_pattern * value, 2)};
}

// Whether the frames before foretell more than the top of a frame, or of places that hold it alike
// unlike signals, whatever their exposures are.
bool IsContradicted(std::span<const SignalFrame> frames, const MergePlan& plan, double sd_ln,
                    std::size_t longer, const TopValue& top) {
  ForetoldSignal least, most;
  for (const TopValue::Place& place : top.places) {
    const ForetoldSignal one = ForetoldAt(frames, plan, longer, place, double{top.value});
    if (&place == top.places.data() || one.value < least.value) least = one;
    if (one.value > most.value) most = one;
  }
  const double sd = std::hypot(std::sqrt(most.variance), sd_ln * most.value);
  return most.value - double{top.value} > kContradictSigmas * sd ||
         most.value - least.value > kContradictSigmas * std::sqrt(most.variance + least.variance);
}

}  // namespace

std::vector<FrameTops> FindTops(std::span<const SignalFrame> frames, const FrameDone& done) {
  std::vector<FrameTops> tops(frames.size());
  const bool unknown = std::ranges::any_of(frames, [](const SignalFrame& frame) {
    return std::ranges::any_of(frame.clip, [](float clip) { return clip > kClipUnknownFrom; });
  });
  if (!unknown) return tops;
  ParallelFor(static_cast<int>(frames.size()), [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    tops[k] = TopsOf(frames[k]);
    if (done) done(k);
  });
  return tops;
}

void ClipHeldTops(std::span<SignalFrame> frames, std::span<const FrameTops> tops,
                  std::span<const double> label) {
  for (std::size_t c = 0; !tops.empty() && c < tops[0].size(); ++c) {
    const float highest = HighestOf(tops, c);
    if (highest > 0.0F && IsHeldByTwo(frames, tops, label, c, highest)) {
      SetClip(frames, c, highest);
    }
  }
}

void ClipContradictedTops(std::span<SignalFrame> frames, std::span<const FrameTops> tops,
                          const MergePlan& plan, std::span<const double> sd_ln) {
  for (std::size_t c = 0; !tops.empty() && c < tops[0].size(); ++c) {
    const float highest = HighestOf(tops, c);
    if (!(highest > 0.0F) || !IsUnknown(frames[0], c)) continue;
    float clip = 0.0F;
    for (std::size_t k = 1; k < frames.size(); ++k) {
      const TopValue& top = tops[k][c];
      if (top.value < kClippedFrom * highest) continue;
      if (IsContradicted(frames, plan, sd_ln[k], k, top)) clip = std::max(clip, top.value);
    }
    if (clip > 0.0F) SetClip(frames, c, clip);
  }
}

}  // namespace lightcal
