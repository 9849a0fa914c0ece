// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/sampled.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lightcal/core/statistics.h"

namespace lightcal {
namespace {

constexpr double kGateSigmas = 4.0;
constexpr double kOrdinary = 0.999;  // of the samples, where no clip is known
constexpr float kAboveOrdinary = 1.5F;

// The level bin of two samples of one place; absent near the clip.
std::optional<std::size_t> BinOf(double ya, double yb, double clip, const PairSetting& setting) {
  if (ya > kClippedFrom * clip || yb > kClippedFrom * clip) return std::nullopt;
  const double r = setting.ratio;
  // In units of a: x from both, first as if the noise were all shot noise.
  const double rough = std::max(0.0, (ya + yb) / (1.0 + r));
  const double variance_a = setting.noise.scale * rough + setting.noise.offset;
  const double variance_b = setting.noise.scale * rough * r + setting.noise.offset;
  const double total = variance_b + r * r * variance_a;
  const double x = total > 0.0 ? (ya * variance_b + yb * r * variance_a) / total : rough;
  const double level = x * std::max(r, 1.0) / clip;
  if (!(level < 1.0)) return std::nullopt;
  return level <= 0.0 ? 0 : static_cast<std::size_t>(kLevelBins * std::sqrt(level));
}

}  // namespace

SampledSignals SampleRows(std::span<const SignalFrame> frames, std::size_t samples,
                          const FrameDone& done) {
  SampledSignals sampled;
  if (frames.empty()) return sampled;
  const std::vector<int> rows = SpreadRows(frames[0], samples);
  const std::size_t row_samples = frames[0].row_samples();
  for (std::size_t k = 0; k < frames.size(); ++k) {
    auto& signals = sampled.frames.emplace_back(rows.size() * row_samples);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      ReadSignals(frames[k], rows[i], 0, std::span(signals).subspan(i * row_samples, row_samples));
    }
    if (done) done(k);
  }
  sampled.clip.reserve(rows.size() * row_samples);
  for (const int y : rows) {
    const auto& channels = frames[0].channel[static_cast<std::size_t>(y % frames[0].row_period)];
    for (std::size_t i = 0; i < row_samples; ++i) {
      sampled.clip.push_back(frames[0].clip[static_cast<std::size_t>(channels[i % kLanes])]);
    }
  }
  return sampled;
}

PairClips ClipsOfPair(const SampledSignals& signals, std::size_t a, std::size_t b) {
  PairClips pair{signals.clip, true};
  const auto unknown = [](float clip) { return clip > kClipUnknownFrom; };
  pair.known = std::none_of(pair.clip.begin(), pair.clip.end(), unknown);
  if (pair.known) return pair;
  float level = 0.0F;
  for (const std::size_t frame : {a, b}) {
    std::vector<float> values = signals.frames[frame];
    const auto rank = static_cast<std::size_t>(kOrdinary * static_cast<double>(values.size() - 1));
    level = std::max(level, kAboveOrdinary * AtRank(values, rank));
  }
  for (float& clip : pair.clip) {
    if (unknown(clip)) clip = level;
  }
  return pair;
}

PairSums ComparePair(std::span<const float> a, std::span<const float> b,
                     std::span<const float> clip, const PairSetting& setting) {
  PairSums sums;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto bin = BinOf(a[i], b[i], clip[i], setting);
    if (!bin) continue;
    const double d = b[i] - setting.ratio * a[i];
    const double gate = setting.gate[*bin];
    if (gate > 0.0 && std::abs(d) > gate) continue;
    LevelSums& sum = sums[*bin];
    sum.count += 1.0;
    sum.a += a[i];
    sum.b += b[i];
    sum.d += d;
    sum.d2 += d * d;
  }
  return sums;
}

std::array<double, kLevelBins> GatesOf(const PairSums& sums) {
  std::array<double, kLevelBins> gates{};
  for (std::size_t bin = 0; bin < gates.size(); ++bin) {
    if (sums[bin].count < 2.0) continue;
    gates[bin] = kGateSigmas * std::sqrt(sums[bin].d2 / sums[bin].count);
  }
  return gates;
}

std::array<double, kLevelBins> FirstGates(std::span<const float> a, std::span<const float> b,
                                          std::span<const float> clip, const PairSetting& setting) {
  // |d| counted in quarter octaves from 2^-24 up.
  constexpr int kSizes = 128;
  constexpr double kSmallest = -24.0;
  std::vector<std::array<std::size_t, kSizes>> sizes(kLevelBins);
  std::array<std::size_t, kLevelBins> counts{};
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto bin = BinOf(a[i], b[i], clip[i], setting);
    if (!bin) continue;
    const double d = std::abs(b[i] - setting.ratio * a[i]);
    const double octaves = d > 0.0 ? std::log2(d) - kSmallest : 0.0;
    ++sizes[*bin][static_cast<std::size_t>(std::clamp(4.0 * octaves, 0.0, kSizes - 1.0))];
    ++counts[*bin];
  }
  std::array<double, kLevelBins> gates{};
  for (std::size_t bin = 0; bin < gates.size(); ++bin) {
    std::size_t seen = 0;
    for (int size = 0; size < kSizes && 2 * seen < counts[bin]; ++size) {
      seen += sizes[bin][static_cast<std::size_t>(size)];
      // Standard deviation of a normal variable = 1.4826 medians of its magnitude.
      if (2 * seen >= counts[bin] && size > 0) {
        gates[bin] = kGateSigmas * 1.4826 * std::exp2(kSmallest + (size + 1) / 4.0);
      }
    }
  }
  return gates;
}

}  // namespace lightcal
