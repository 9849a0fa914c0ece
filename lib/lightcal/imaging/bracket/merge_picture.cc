// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/merge_picture.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "lightcal/core/parallel.h"
#include "lightcal/imaging/bracket/encoded_errors.h"
#include "lightcal/imaging/bracket/signal_kernels.h"

namespace lightcal {
namespace {

constexpr int kStripRows = 32;
constexpr std::size_t kPad = kLanes;     // samples before and after a row of the strip
constexpr float kBoundFrom = 0.5F;       // of the clip, after flat field and dark frame
constexpr float kBoundVariance = 0.98F;  // over the value's square (merge_bracket.h: 1)

// One coefficient a lane for a sample dx to the right and dy below.
struct Tap {
  int dx = 0, dy = 0;
  kernels::Lanes value{};
  kernels::Lanes square{};
};
// [row phase] -> the taps that matter there
using Kernel = std::vector<std::vector<Tap>>;

bool IsMosaic(const SignalFrame& frame) {
  if (frame.channels != 1) return false;
  return std::any_of(frame.channel.begin(), frame.channel.end(), [](const auto& lanes) {
    return std::any_of(lanes.begin(), lanes.end(), [](int c) { return c != 0; });
  });
}

// Samples after which the colours of every row repeat.
std::size_t ColumnPeriod(const SignalFrame& frame) {
  for (std::size_t period = 1; period < kLanes; ++period) {
    const bool repeats =
        kLanes % period == 0 &&
        std::all_of(frame.channel.begin(), frame.channel.end(), [period](const auto& lanes) {
          return std::equal(lanes.begin() + static_cast<std::ptrdiff_t>(period), lanes.end(),
                            lanes.begin());
        });
    if (repeats) return period;
  }
  return kLanes;
}

int ChannelAt(const SignalFrame& frame, int phase, int lane, int dx, int dy) {
  const int row = (phase + dy + frame.row_period) % frame.row_period;
  const int column = (lane + dx + kLanes) % kLanes;
  return frame.channel[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
}

// How much the sample at (dx, dy) counts for its colour at the place (phase, lane): a pixel's own
// colour is its own sample, others are the bilinear mean of their nearest.
double ShareOf(const SignalFrame& frame, int phase, int lane, int dx, int dy) {
  const int channel = ChannelAt(frame, phase, lane, dx, dy);
  if (channel == ChannelAt(frame, phase, lane, 0, 0)) return dx == 0 && dy == 0 ? 1.0 : 0.0;
  double sum = 0.0;
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      if (ChannelAt(frame, phase, lane, i, j) != channel) continue;
      sum += (2 - std::abs(i)) * (2 - std::abs(j));
    }
  }
  return (2 - std::abs(dx)) * (2 - std::abs(dy)) / sum;
}

bool SeesAllColours(const SignalFrame& frame, int phase, int lane) {
  std::array<bool, 3> seen{};
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      seen[static_cast<std::size_t>(ChannelAt(frame, phase, lane, i, j))] = true;
    }
  }
  return seen[0] && seen[1] && seen[2];
}

Kernel KernelOf(const SignalFrame& frame, const std::array<double, 3>& row) {
  Kernel kernel(static_cast<std::size_t>(frame.row_period));
  for (int phase = 0; phase < frame.row_period; ++phase) {
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
        Tap tap{.dx = i, .dy = j};
        bool matters = false;
        for (int lane = 0; lane < kLanes; ++lane) {
          const int channel = ChannelAt(frame, phase, lane, i, j);
          const double coefficient =
              row[static_cast<std::size_t>(channel)] * ShareOf(frame, phase, lane, i, j);
          const auto at = static_cast<std::size_t>(lane);
          tap.value[at] = static_cast<float>(coefficient);
          tap.square[at] = static_cast<float>(coefficient * coefficient);
          matters = matters || coefficient != 0.0;
        }
        if (matters) kernel[static_cast<std::size_t>(phase)].push_back(tap);
      }
    }
  }
  return kernel;
}

// Rows [first - 1, first + count + 1) of the merged picture with a pixel around them: what lies
// outside is taken from one period further inside, where the same colours are.
class Strip {
 public:
  Strip(const BracketMerger& merger, const SampleCorrections& corrections, int most_rows)
      : merger_(merger),
        corrections_(corrections),
        samples_(merger.frames()[0].row_samples()),
        stride_(samples_ + 2 * kPad),
        column_period_(ColumnPeriod(merger.frames()[0])),
        value_(stride_ * static_cast<std::size_t>(most_rows + 2)),
        variance_(value_.size()),
        bound_(value_.size(), 0) {}

  std::size_t Fill(int first, int count) {
    const SignalFrame& frame = merger_.frames()[0];
    const int top = std::max(0, first - 1);
    const int end = std::min(frame.height, first + count + 1);
    has_bounds_ = false;
    if (top < first) static_cast<void>(MergeInto(top, top, 1, first));
    const std::size_t clipped = MergeInto(first, first, count, first);
    if (end > first + count) static_cast<void>(MergeInto(end - 1, end - 1, 1, first));
    if (first == 0) static_cast<void>(MergeInto(-1, frame.row_period - 1, 1, first));
    if (first + count == frame.height) {
      static_cast<void>(MergeInto(frame.height, frame.height - frame.row_period, 1, first));
    }
    return clipped;
  }
  [[nodiscard]] const float* value(int y, int first) const { return value_.data() + At(y, first); }
  [[nodiscard]] const float* variance(int y, int first) const {
    return variance_.data() + At(y, first);
  }
  // 1 where a sample is clipped in every frame.
  [[nodiscard]] const std::uint8_t* bound(int y, int first) const {
    return bound_.data() + At(y, first);
  }
  [[nodiscard]] bool has_bounds() const { return has_bounds_; }

 private:
  [[nodiscard]] std::size_t At(int y, int first) const {
    return static_cast<std::size_t>(y - first + 1) * stride_ + kPad;
  }
  // Merges rows from `source` on to where the rows from `y` on belong.
  std::size_t MergeInto(int y, int source, int count, int first) {
    const auto width = static_cast<int>(samples_);
    const auto stride = static_cast<std::ptrdiff_t>(stride_);
    const std::size_t clipped = merger_.MergeRows(
        source, count, View2d<float>(value_.data() + At(y, first), width, count, 1, stride),
        View2d<float>(variance_.data() + At(y, first), width, count, 1, stride));
    for (int i = 0; i < count; ++i) {
      const std::size_t at = At(y + i, first);
      float *const value = &value_[at], *const variance = &variance_[at];
      if (!corrections_.empty()) {
        corrections_.Apply(merger_.frames()[0], source + i, value, variance);
      }
      std::fill_n(&bound_[at], samples_, std::uint8_t{0});
      if (clipped > 0) MarkBounds(source + i, value, variance, &bound_[at]);
      PadRow(value);
      PadRow(variance);
      PadRow(&bound_[at]);
    }
    has_bounds_ = has_bounds_ || clipped > 0;
    return clipped;
  }
  void MarkBounds(int source, const float* value, const float* variance,
                  std::uint8_t* bound) const {
    const SignalFrame& frame = merger_.frames()[0];
    const auto& channels = frame.channel[static_cast<std::size_t>(source % frame.row_period)];
    const float share = kBoundFrom / static_cast<float>(merger_.plan().exposure[0]);
    for (std::size_t i = 0; i < samples_; ++i) {
      const float bright = share * frame.clip[static_cast<std::size_t>(channels[i % kLanes])];
      bound[i] = value[i] > bright && variance[i] > kBoundVariance * value[i] * value[i] ? 1 : 0;
    }
  }
  template <class Sample>
  void PadRow(Sample* row) const {
    row[-1] = row[column_period_ - 1];
    row[samples_] = row[samples_ - column_period_];
  }

  const BracketMerger& merger_;
  const SampleCorrections& corrections_;
  std::size_t samples_, stride_, column_period_;
  std::vector<float> value_, variance_;
  std::vector<std::uint8_t> bound_;
  bool has_bounds_ = false;
};

// Sum of the taps over a row; squares of the coefficients for variances.
void ApplyKernel(const std::vector<Tap>& taps, const Strip& strip, int y, int first, bool variances,
                 std::span<float> out) {
  std::fill(out.begin(), out.end(), 0.0F);
  for (std::size_t x = 0; x < out.size(); x += kernels::kBlock) {
    const std::size_t count = std::min(kernels::kBlock, out.size() - x);
    for (const Tap& tap : taps) {
      const float* in =
          variances ? strip.variance(y + tap.dy, first) : strip.value(y + tap.dy, first);
      kernels::AddProducts(in + static_cast<std::ptrdiff_t>(x) + tap.dx,
                           variances ? tap.square : tap.value, count, out.data() + x);
    }
  }
}

// Row of a picture whose pixels hold all their channels.
void ApplyRow(const float* samples, int channels, const std::array<double, 3>& row, bool squares,
              std::span<float> out) {
  std::array<float, 3> k{};
  for (std::size_t c = 0; c < 3; ++c) k[c] = static_cast<float>(squares ? row[c] * row[c] : row[c]);
  for (std::size_t x = 0; x < out.size(); ++x) {
    const float* pixel = samples + x * static_cast<std::size_t>(channels);
    out[x] = k[0] * pixel[0];
    if (channels == 3) out[x] += k[1] * pixel[1] + k[2] * pixel[2];
  }
}

// Variances of the luminance of a row of codes (encoded_errors.h). `luminance`: of the row above,
// the row and the row below.
void EncodedVariances(const float* variances, int channels, const std::array<double, 3>& row,
                      const EncodedErrors& errors,
                      const std::array<std::vector<float>, 3>& luminance,
                      std::span<const std::uint8_t> bounds, std::span<float> out) {
  const auto shared = static_cast<float>(errors.shared);
  const auto misfit2 = static_cast<float>(errors.misfit * errors.misfit);
  constexpr auto kHidden2 = static_cast<float>(kHiddenDetail * kHiddenDetail);
  const auto toe_sd = static_cast<float>(errors.toe.slope_sd);
  float toe = 0.0F;
  for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
    toe += static_cast<float>(std::abs(row[c]) * errors.toe.below[c]);
  }
  for (std::size_t x = 0; x < out.size(); ++x) {
    const float* pixel = variances + x * static_cast<std::size_t>(channels);
    float squares = 0.0F, sum = 0.0F;
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
      const auto k = static_cast<float>(std::abs(row[c]));
      squares += k * k * pixel[c];
      sum += k * std::sqrt(pixel[c]);
    }
    const float y = luminance[1][x];
    // Around its own value: numbers far from their spread lose it otherwise.
    float mean = 0.0F, square = 0.0F;
    for (const std::vector<float>& line : luminance) {
      for (const std::size_t at : {x == 0 ? x : x - 1, x, std::min(x + 1, out.size() - 1)}) {
        const float d = line[at] - y;
        mean += d / 9.0F;
        square += d * d / 9.0F;
      }
    }
    const float detail = std::max(0.0F, square - mean * mean);
    const float in_toe = y > 0.0F && y < toe ? toe_sd * std::log(toe / y) : 0.0F;
    const float own =
        (1.0F - shared) * squares + shared * sum * sum + (misfit2 + in_toe * in_toe) * y * y;
    out[x] = (bounds.empty() || bounds[x] == 0 ? own : std::max(own, y * y)) + kHidden2 * detail;
  }
}

// How rows of merged samples become rows of the picture.
class Mapper {
 public:
  Mapper(const BracketMerger& merger, const PictureRows& rows)
      : frame_(merger.frames()[0]), plan_(merger.plan()), rows_(rows), mosaic_(IsMosaic(frame_)) {
    if (!mosaic_) return;
    for (const auto& row : rows.picture) picture_.push_back(KernelOf(frame_, row));
    luminance_ = KernelOf(frame_, rows.luminance);
  }
  void Picture(const Strip& strip, int y, int first, std::size_t channel,
               std::span<float> out) const {
    if (mosaic_) return ApplyKernel(picture_[channel][Phase(y)], strip, y, first, false, out);
    ApplyRow(strip.value(y, first), frame_.channels, rows_.picture[channel], false, out);
  }
  void Sigma(const Strip& strip, int y, int first, std::span<float> out) const {
    const std::vector<std::uint8_t> bounds = BoundsOf(strip, y, first, out.size());
    if (plan_.encoded == nullptr || mosaic_) {
      Luminance(strip, y, first, true, out);
      if (!bounds.empty() || plan_.part_sd > 0.0) Widen(bounds, strip, y, first, out);
    } else {
      std::array<std::vector<float>, 3> luminance;
      for (int i = 0; i < 3; ++i) {
        auto& line = luminance[static_cast<std::size_t>(i)];
        line.resize(out.size());
        Luminance(strip, y + i - 1, first, false, line);
      }
      EncodedVariances(strip.variance(y, first), frame_.channels, rows_.luminance, *plan_.encoded,
                       luminance, bounds, out);
    }
    kernels::SquareRoots(out.data(), out.size(), out.data());
  }

 private:
  void Luminance(const Strip& strip, int y, int first, bool variances, std::span<float> out) const {
    if (mosaic_) return ApplyKernel(luminance_[Phase(y)], strip, y, first, variances, out);
    ApplyRow(variances ? strip.variance(y, first) : strip.value(y, first), frame_.channels,
             rows_.luminance, variances, out);
  }
  // 1 where any sample that a pixel's luminance is made of is a lower bound; empty where none is.
  [[nodiscard]] std::vector<std::uint8_t> BoundsOf(const Strip& strip, int y, int first,
                                                   std::size_t width) const {
    std::vector<std::uint8_t> bounds;
    if (!strip.has_bounds()) return bounds;
    bounds.resize(width);
    if (mosaic_) {
      for (const Tap& tap : luminance_[Phase(y)]) {
        const std::uint8_t* const marks = strip.bound(y + tap.dy, first) + tap.dx;
        for (std::size_t x = 0; x < width; ++x) {
          if (tap.value[x % kLanes] != 0.0F) bounds[x] |= marks[x];
        }
      }
      return bounds;
    }
    const auto channels = static_cast<std::size_t>(frame_.channels);
    const std::uint8_t* const marks = strip.bound(y, first);
    for (std::size_t i = 0; i < width * channels; ++i) {
      if (rows_.luminance[i % channels] != 0.0) bounds[i / channels] |= marks[i];
    }
    return bounds;
  }
  // What the channels of a clipped pixel lack, or a wrong exposure adds, is alike in all of them.
  void Widen(std::span<const std::uint8_t> bounds, const Strip& strip, int y, int first,
             std::span<float> variance) const {
    const auto part2 = static_cast<float>(plan_.part_sd * plan_.part_sd);
    std::vector<float> luminance(variance.size());
    Luminance(strip, y, first, false, luminance);
    for (std::size_t x = 0; x < variance.size(); ++x) {
      const float square = luminance[x] * luminance[x];
      const float least = bounds.empty() || bounds[x] == 0 ? 0.0F : square;
      variance[x] = std::max(variance[x], least) + part2 * square;
    }
  }
  [[nodiscard]] std::size_t Phase(int y) const {
    return static_cast<std::size_t>(y % frame_.row_period);
  }
  const SignalFrame& frame_;
  const MergePlan& plan_;
  const PictureRows& rows_;
  bool mosaic_;
  std::vector<Kernel> picture_;
  Kernel luminance_;
};

void WriteStrip(const Mapper& mapper, const Strip& strip, int y0, int count, int first,
                View2d<float> picture, View2d<float> sigma) {
  std::vector<float> channel(static_cast<std::size_t>(picture.width()));
  for (int y = y0; y < y0 + count; ++y) {
    const auto out = picture.row(y - first);
    const auto channels = static_cast<std::size_t>(picture.channels());
    for (std::size_t c = 0; c < channels; ++c) {
      if (channels == 1) {
        mapper.Picture(strip, y, y0, c, out);
        continue;
      }
      mapper.Picture(strip, y, y0, c, channel);
      for (std::size_t x = 0; x < channel.size(); ++x) out[x * channels + c] = channel[x];
    }
    if (!sigma.empty()) mapper.Sigma(strip, y, y0, sigma.row(y - first));
  }
}

}  // namespace

Result<std::size_t> MergePicture(const BracketMerger& merger, const PictureRows& rows, int first,
                                 int count, View2d<float> picture, View2d<float> sigma,
                                 const Progress& progress) {
  const SignalFrame& frame = merger.frames()[0];
  bool understood = frame.row_samples() >= ColumnPeriod(frame) && frame.height >= frame.row_period;
  if (IsMosaic(frame)) {
    for (int phase = 0; phase < frame.row_period; ++phase) {
      for (int lane = 0; lane < kLanes; ++lane) {
        understood = understood && SeesAllColours(frame, phase, lane);
      }
    }
  }
  if (!understood) {
    return Refused("pattern_unknown", frame.name,
                   "its colour filter pattern is not one lightcal can interpolate, or the picture "
                   "is smaller than the pattern");
  }
  // Strips start on whole periods, so that a row of the picture has one place in them.
  const int strip_rows = kStripRows / frame.row_period * frame.row_period + frame.row_period;
  const int strips = (count + strip_rows - 1) / strip_rows;
  const Mapper mapper(merger, rows);
  std::atomic<std::size_t> clipped{0};
  CountedProgress counted(progress, strips);
  ParallelFor(strips, [&](int i) {
    const int y0 = first + i * strip_rows;
    const int n = std::min(strip_rows, first + count - y0);
    Strip strip(merger, rows.corrections, std::max(n, frame.row_period));
    clipped += strip.Fill(y0, n);
    WriteStrip(mapper, strip, y0, n, first, picture, sigma);
    counted.Done();
  });
  return clipped.load();
}

}  // namespace lightcal
