// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/merge_bracket.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "lightcal/core/statistics.h"
#include "lightcal/imaging/bracket/encoded_errors.h"
#include "lightcal/imaging/bracket/noise_shares.h"
#include "lightcal/imaging/bracket/signal_kernels.h"

namespace lightcal {
namespace {

constexpr double kLargestFixedPattern = 2.0;  // of the usual one
constexpr int kTile = 16;                     // samples of one place of the pattern, each way
constexpr int kStrips = 12;                   // of rows, spread over the picture
constexpr std::size_t kLeastTiles = 16;
constexpr std::size_t kTilesAsked = 4, kTilesAskedOfCodes = 20;  // the flattest of so many
constexpr double kTileSpread = 0.12;   // relative standard deviation of a tile's scatter
constexpr double kWellExposed = 0.03;  // relative noise of a sample, at most

std::vector<kernels::FrameConstants> ConstantsOf(const MergePlan& plan) {
  std::vector<kernels::FrameConstants> constants;
  const double first_scale = plan.noise[0].scale;
  double sum = 0.0;
  for (std::size_t i = 0; i < plan.exposure.size(); ++i) {
    const double t = plan.exposure[i];
    const NoiseProfile& noise = plan.noise[i];
    const double weight = first_scale > 0.0 && noise.scale > 0.0 ? first_scale / noise.scale : 1.0;
    sum += weight * t;
    constants.push_back({.exposure = static_cast<float>(t),
                         .poisson_weight = static_cast<float>(weight),
                         .prefix_reciprocal = static_cast<float>(1.0 / sum),
                         .shot = static_cast<float>(noise.scale * t),
                         .read = static_cast<float>(noise.offset),
                         .floor = static_cast<float>(plan.floor)});
  }
  return constants;
}

// A share of the clip, for each lane of each row of the pattern.
std::vector<kernels::Lanes> LimitsOf(const SignalFrame& frame, double share) {
  std::vector<kernels::Lanes> limits;
  for (const auto& channels : frame.channel) {
    auto& lanes = limits.emplace_back();
    for (std::size_t i = 0; i < lanes.size(); ++i) {
      lanes[i] = static_cast<float>(share) * frame.clip[static_cast<std::size_t>(channels[i])];
    }
  }
  return limits;
}

bool IsSound(const MergePlan& plan, std::size_t frames) {
  if (frames == 0 || plan.exposure.size() != frames || plan.noise.size() != frames) return false;
  for (std::size_t i = 0; i < frames; ++i) {
    const NoiseProfile& noise = plan.noise[i];
    if (!(plan.exposure[i] > 0.0) || (i > 0 && plan.exposure[i] < plan.exposure[i - 1])) {
      return false;
    }
    if (!(noise.scale >= 0.0) || !(noise.offset > 0.0)) return false;
  }
  return true;
}

}  // namespace

Result<BracketMerger> BracketMerger::Make(std::span<const SignalFrame> frames,
                                          const MergePlan& plan) {
  if (!IsSound(plan, frames.size())) {
    return Refused("bad_plan", frames.empty() ? "merge" : frames[0].name,
                   "exposures must be positive and ascending, one noise a frame with a positive "
                   "offset");
  }
  for (const SignalFrame& frame : frames) {
    const SignalFrame& one = frames[0];
    if (frame.width != one.width || frame.height != one.height || frame.channels != one.channels ||
        frame.row_period != one.row_period) {
      return Refused("mixed_size", frame.name, "differs in size or pattern from " + one.name);
    }
  }
  BracketMerger merger;
  merger.frames_ = frames;
  merger.plan_ = plan;
  // In units of the shortest frame: numbers stay near 1.
  for (double& exposure : merger.plan_.exposure) exposure /= plan.exposure[0];
  return merger;
}

namespace {

// Merges row by row; not for two threads at once.
class RowMerger {
 public:
  RowMerger(std::span<const SignalFrame> frames, const MergePlan& plan)
      : frames_(frames),
        plan_(plan),
        constants_(ConstantsOf(plan)),
        limits_(LimitsOf(frames[0], plan.usable)),
        clips_(LimitsOf(frames[0], 1.0)),
        signals_(frames.size() * kernels::kBlock),
        precisions_(signals_.size()) {
    if (std::ranges::any_of(frames, [](const auto& frame) { return frame.shares != nullptr; })) {
      shares_.assign(signals_.size(), 1.0F);
    }
    if (plan.encoded && !plan.encoded->places.factor.empty()) places_.resize(kernels::kBlock);
  }

  // Row y; how many of its samples are clipped in every frame. Pointers of `out` as those of
  // kernels::BlockOut, at the row's first sample; used is filled here.
  std::size_t Merge(int y, const kernels::BlockOut& out) {
    const auto pattern = static_cast<float>(plan_.fixed_pattern);
    const auto phase = static_cast<std::size_t>(y % frames_[0].row_period);
    const std::size_t row_samples = frames_[0].row_samples();
    std::size_t clipped = 0;
    for (std::size_t x = 0; x < row_samples; x += kernels::kBlock) {
      const std::size_t samples = std::min(kernels::kBlock, row_samples - x);
      Read(y, x, samples);
      kernels::MergeBlock({.frames = constants_,
                           .signals = signals_.data(),
                           .precisions = precisions_.data(),
                           .shares = shares_.empty() ? nullptr : shares_.data(),
                           .places = places_.empty() ? nullptr : places_.data(),
                           .count = samples,
                           .limit = &limits_[phase],
                           .clip = &clips_[phase],
                           .fixed_pattern2 = pattern * pattern,
                           .estimator = plan_.estimator},
                          {.value = out.value + x,
                           .variance = out.variance + x,
                           .used = used_.data(),
                           .chi2 = out.chi2 == nullptr ? nullptr : out.chi2 + x,
                           .degrees = out.degrees == nullptr ? nullptr : out.degrees + x});
      clipped += static_cast<std::size_t>(
          std::count(used_.begin(), used_.begin() + static_cast<std::ptrdiff_t>(samples), -1.0F));
    }
    return clipped;
  }

 private:
  void Read(int y, std::size_t x, std::size_t samples) {
    for (std::size_t k = 0; k < frames_.size(); ++k) {
      ReadSignals(frames_[k], y, x, std::span(signals_).subspan(k * kernels::kBlock, samples));
      if (frames_[k].shares == nullptr) continue;
      frames_[k].shares->Row(y, x, std::span(shares_).subspan(k * kernels::kBlock, samples));
    }
    if (places_.empty()) return;
    plan_.encoded->places.Row(y, x, frames_[0].channels, std::span(places_).first(samples));
  }

  std::span<const SignalFrame> frames_;
  const MergePlan& plan_;
  std::vector<kernels::FrameConstants> constants_;
  std::vector<kernels::Lanes> limits_, clips_;
  std::vector<float> signals_, precisions_, shares_, places_;
  std::array<float, kernels::kBlock> used_{};
};

}  // namespace

std::size_t BracketMerger::MergeRows(int first, int count, View2d<float> value,
                                     View2d<float> variance) const {
  RowMerger merger(frames_, plan_);
  std::size_t clipped = 0;
  for (int i = 0; i < count; ++i) {
    clipped += merger.Merge(
        first + i,
        {.value = value.row(i).data(), .variance = variance.row(i).data(), .used = nullptr});
  }
  return clipped;
}

void BracketMerger::ScatterOfRow(int y, std::span<float> chi2, std::span<float> degrees) const {
  std::vector<float> value(frames_[0].row_samples()), variance(value.size());
  RowMerger merger(frames_, plan_);
  static_cast<void>(merger.Merge(y, {.value = value.data(),
                                     .variance = variance.data(),
                                     .used = nullptr,
                                     .chi2 = chi2.data(),
                                     .degrees = degrees.data()}));
}

namespace {

// A tile of samples of one place of the pattern: its scatter beyond the variance, squared and
// relative, and how well that is known. Second differences leave out slopes.
struct TilePattern {
  double square = 0.0, sd = 0.0;
};

std::optional<TilePattern> TileOf(View2d<const float> value, View2d<const float> variance, int x0,
                                  int y0, int step_x, int step_y) {
  double scatter = 0.0, expected = 0.0, mean = 0.0, count = 0.0;
  for (int j = 0; j < kTile; ++j) {
    const auto row = value.row(y0 + j * step_y);
    const auto noise = variance.row(y0 + j * step_y);
    for (int i = 1; i + 1 < kTile; ++i) {
      const auto at = static_cast<std::size_t>(x0 + i * step_x);
      const auto step = static_cast<std::size_t>(step_x);
      const double second = double{row[at - step]} - 2.0 * row[at] + row[at + step];
      scatter += second * second / 6.0;
      expected += noise[at];
      mean += row[at];
      count += 1.0;
    }
  }
  mean /= count;
  if (!(mean > 0.0)) return std::nullopt;
  scatter /= count * mean * mean;
  expected /= count * mean * mean;
  if (!(expected < kWellExposed * kWellExposed)) return std::nullopt;
  return TilePattern{scatter - expected, kTileSpread * scatter};
}

}  // namespace

double EstimateFixedPattern(const BracketMerger& merger, const FrameDone& done_with) {
  MergePlan plan = merger.plan();
  plan.fixed_pattern = 0.0;
  const auto bare = BracketMerger::Make(merger.frames(), plan);
  const double usual = merger.plan().fixed_pattern;
  if (!bare) return usual;
  const SignalFrame& frame = merger.frames()[0];
  // Columns after which a sample of the same place comes again: 2 for Bayer, 3 for RGB.
  const int step_x =
      frame.channels == 1 && frame.row_period > 1 ? frame.row_period : frame.channels;
  const int step_y = frame.row_period;
  const int rows = kTile * step_y;
  const int samples = static_cast<int>(frame.row_samples());
  const int strips = std::min(kStrips, frame.height / rows);
  std::vector<float> value(frame.row_samples() * static_cast<std::size_t>(rows));
  std::vector<float> variance(value.size());
  const View2d<float> values(value.data(), samples, rows);
  const View2d<float> variances(variance.data(), samples, rows);
  std::vector<double> upper;
  for (int strip = 0; strip < strips; ++strip) {
    const int first = (frame.height / rows) * strip / strips * rows;
    static_cast<void>(bare->MergeRows(first, rows, values, variances));
    for (std::size_t k = 0; done_with && k < merger.frames().size(); ++k) done_with(k);
    for (int x = 0; x + kTile * step_x <= samples; x += kTile * step_x) {
      for (int place = 0; place < step_x * step_y; ++place) {
        const auto tile =
            TileOf(values, variances, x + place % step_x, place / step_x, step_x, step_y);
        if (tile) upper.push_back(tile->square + kNormalQuartile * tile->sd);
      }
    }
  }
  if (upper.size() < kLeastTiles) return usual;
  const std::size_t asked = frame.response != nullptr ? kTilesAskedOfCodes : kTilesAsked;
  const double square = AtRank(upper, upper.size() / asked);
  return std::min(kLargestFixedPattern * usual, std::sqrt(std::max(0.0, square)));
}

}  // namespace lightcal
