// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/camera/dark_frame.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/statistics.h"

namespace lightcal {
namespace {

constexpr double kWithin = 5.0, kHot = 10.0;  // standard deviations
constexpr double kMostBlack = 0.02;
constexpr double kMostHot = 0.01;
constexpr double kPictureFrom = 0.002;  // of full scale between blocks
constexpr int kBlocks = 8;              // a side
constexpr double kSameIso = 0.02;

// Mean of the frames, sample by sample.
std::vector<float> MeanFrame(std::span<const SignalFrame> frames) {
  const SignalFrame& one = frames[0];
  std::vector<float> mean(one.row_samples() * static_cast<std::size_t>(one.height));
  std::vector<float> row(one.row_samples());
  for (const SignalFrame& frame : frames) {
    for (int y = 0; y < one.height; ++y) {
      ReadSignals(frame, y, 0, row);
      float* out = mean.data() + static_cast<std::size_t>(y) * row.size();
      for (std::size_t i = 0; i < row.size(); ++i) out[i] += row[i];
    }
  }
  for (float& value : mean) value /= static_cast<float>(frames.size());
  return mean;
}

std::size_t ChannelOf(const SignalFrame& frame, int y, std::size_t i) {
  const auto& lanes = frame.channel[static_cast<std::size_t>(y % frame.row_period)];
  return static_cast<std::size_t>(lanes[i % kLanes]);
}

// Calls visit(channel, x sample, y, value) for every sample.
template <class Visit>
void ForEach(const SignalFrame& frame, const std::vector<float>& plane, const Visit& visit) {
  const std::size_t width = frame.row_samples();
  for (int y = 0; y < frame.height; ++y) {
    for (std::size_t i = 0; i < width; ++i) {
      visit(ChannelOf(frame, y, i), i, y, plane[static_cast<std::size_t>(y) * width + i]);
    }
  }
}

struct Level {
  double median = 0.0, sd = 0.0;
};

std::array<Level, 3> LevelsOf(const SignalFrame& frame, const std::vector<float>& plane) {
  std::array<std::vector<float>, 3> values;
  ForEach(frame, plane, [&](std::size_t c, std::size_t, int, float v) { values[c].push_back(v); });
  std::array<Level, 3> levels;
  for (std::size_t c = 0; c < 3; ++c) {
    if (values[c].empty()) continue;
    levels[c].median = UpperMedian(values[c]);
    for (float& v : values[c]) v = static_cast<float>(std::abs(v - levels[c].median));
    // Codes of a quiet sensor may all be one value: then rounding is the spread.
    levels[c].sd =
        std::max(kSdPerMad * double{UpperMedian(values[c])}, 0.3 * double{frame.scale[0][0]});
  }
  return levels;
}

struct Sums {
  double sum = 0.0, count = 0.0;
  [[nodiscard]] double Mean() const { return count > 0.0 ? sum / count : 0.0; }
};

double ScatterOfMean(const std::vector<double>& means) {
  if (means.size() < 2) return 0.0;
  double sum = 0.0, squares = 0.0;
  for (const double m : means) sum += m;
  const double mean = sum / static_cast<double>(means.size());
  for (const double m : means) squares += (m - mean) * (m - mean);
  const auto n = static_cast<double>(means.size());
  return std::sqrt(squares / (n - 1.0) / n);
}

double MeanOfFrame(const SignalFrame& frame, const std::array<Level, 3>& levels) {
  Sums sums;
  std::vector<float> row(frame.row_samples());
  for (int y = 0; y < frame.height; ++y) {
    ReadSignals(frame, y, 0, row);
    for (std::size_t i = 0; i < row.size(); ++i) {
      const Level& level = levels[ChannelOf(frame, y, i)];
      if (std::abs(row[i] - level.median) > kHot * level.sd) continue;
      sums.sum += row[i] - level.median;
      sums.count += 1.0;
    }
  }
  return sums.Mean();
}

tl::unexpected<Error> WithLight(const std::string& file, const std::string& what) {
  return Refused("dark_with_light", file,
                 what + ": light came in; put the cap on, cover the finder, and take it again");
}

}  // namespace

Result<CameraDark> MeasureDark(std::span<const SignalFrame> frames, double iso, Seconds exposure) {
  if (frames.empty()) return Refused("no_frames", "dark", "no frame was given");
  const SignalFrame& frame = frames[0];
  const std::vector<float> plane = MeanFrame(frames);
  const std::array<Level, 3> levels = LevelsOf(frame, plane);
  CameraDark dark{.iso = iso, .exposure = exposure};
  std::array<Sums, 3> channels;
  std::array<Sums, kBlocks * kBlocks> blocks;
  const auto width = static_cast<int>(frame.row_samples());
  ForEach(frame, plane, [&](std::size_t c, std::size_t i, int y, float value) {
    const double off = value - levels[c].median;
    if (off > kHot * levels[c].sd) {
      dark.hot_pixels.push_back(static_cast<int>(i) / frame.channels);
      dark.hot_pixels.push_back(y);
    }
    if (std::abs(off) > kWithin * levels[c].sd) return;
    channels[c].sum += value;
    channels[c].count += 1.0;
    const int block = y * kBlocks / frame.height * kBlocks + static_cast<int>(i) * kBlocks / width;
    auto& sums = blocks[static_cast<std::size_t>(block)];
    sums.sum += off;
    sums.count += 1.0;
  });
  for (std::size_t c = 0; c < 3; ++c) {
    dark.black[c] = channels[c].Mean();
    if (dark.black[c] > kMostBlack) {
      return WithLight(frame.name, "it shows " + PercentText(dark.black[c]) + " of full scale");
    }
  }
  const double pixels = static_cast<double>(frame.width) * frame.height;
  if (static_cast<double>(dark.hot_pixels.size()) / 2.0 > kMostHot * pixels) {
    return WithLight(frame.name, "more than 1 % of its pixels are bright");
  }
  std::vector<double> means, frame_means;
  for (const Sums& block : blocks) means.push_back(block.Mean());
  const auto [low, high] = std::ranges::minmax_element(means);
  if (*high - *low > kPictureFrom) return WithLight(frame.name, "it shows a picture");
  for (const SignalFrame& one : frames) frame_means.push_back(MeanOfFrame(one, levels));
  dark.sigma = std::hypot(ScatterOfMean(means), ScatterOfMean(frame_means));
  return dark;
}

std::optional<BlackAt> BlackFor(std::span<const CameraDark> darks, double iso, Seconds exposure) {
  const CameraDark *below = nullptr, *above = nullptr;
  for (const CameraDark& dark : darks) {
    if (std::abs(std::log(dark.iso / iso)) > kSameIso) continue;
    if (dark.exposure <= exposure && (below == nullptr || dark.exposure > below->exposure)) {
      below = &dark;
    }
    if (dark.exposure >= exposure && (above == nullptr || dark.exposure < above->exposure)) {
      above = &dark;
    }
  }
  if (below == nullptr && above == nullptr) return std::nullopt;
  BlackAt at;
  if (below == nullptr || above == nullptr) {
    const CameraDark& dark = below != nullptr ? *below : *above;
    at.black = dark.black;
    const double near = std::min(dark.exposure / exposure, exposure / dark.exposure);
    const double most = std::abs(
        *std::ranges::max_element(dark.black, {}, [](double black) { return std::abs(black); }));
    at.sigma = std::hypot(dark.sigma, 0.5 * most * (1.0 - near));
    return at;
  }
  const double span = above->exposure.value() - below->exposure.value();
  const double share = span > 0.0 ? (exposure.value() - below->exposure.value()) / span : 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    at.black[c] = below->black[c] + share * (above->black[c] - below->black[c]);
  }
  at.sigma = std::max(below->sigma, above->sigma);
  return at;
}

}  // namespace lightcal
