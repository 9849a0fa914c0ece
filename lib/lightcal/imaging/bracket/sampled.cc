// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/sampled.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "lightcal/core/every_processor.h"
#include "lightcal/core/statistics.h"

namespace lightcal {
namespace {

constexpr double kGateSigmas = 4.0;
constexpr double kOrdinary = 0.999;  // of the samples, where no clip is known
constexpr float kAboveOrdinary = 1.5F;

constexpr std::size_t kAtOnce = 512;
constexpr std::int32_t kNoBin = -1;
constexpr double kQuarterOctaves[] = {1.189207115002721, 1.4142135623730951, 1.681792830507429};
using Bins = std::array<std::int32_t, kAtOnce>;

// The level bin of two samples of one place; kNoBin near the clip. At most kAtOnce of them, without
// a branch, so that several are worked out side by side.
LIGHTCAL_EVERY_CPU
void FindBins(std::span<const float> a, std::span<const float> b, std::span<const float> clip,
              const PairSetting& setting, Bins& bins) {
  const double r = setting.ratio;
  const double scale = setting.noise.scale;
  const double offset = setting.noise.offset;
  const double larger = std::max(r, 1.0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double ya = a[i];
    const double yb = b[i];
    const double full = clip[i];
    // In units of a: x from both, first as if the noise were all shot noise.
    const double rough = std::max(0.0, (ya + yb) / (1.0 + r));
    const double variance_a = scale * rough + offset;
    const double variance_b = scale * rough * r + offset;
    const double total = variance_b + r * r * variance_a;
    const bool noisy = total > 0.0;
    const double weighted = (ya * variance_b + yb * r * variance_a) / (noisy ? total : 1.0);
    const double x = noisy ? weighted : rough;
    const double level = x * larger / full;
    const double ceiling = kClippedFrom * full;
    const double above = std::max(ya, yb) - ceiling;
    const double seen = level < 1.0 && !(above > 0.0) ? std::max(level, 0.0) : -1.0;
    const double bin = kLevelBins * std::sqrt(std::max(seen, 0.0));
    bins[i] = static_cast<std::int32_t>(seen < 0.0 ? -1.0 : bin);
  }
}

// Sizes counted in quarter octaves from 2^-24 up.
constexpr int kSizes = 128;
constexpr int kSmallestOctave = -24;

// floor(4 log2(size)) - 4 kSmallestOctave, kept within what is counted, from the number's own
// exponent: a logarithm of each sample took a third of what comparing two frames does.
std::size_t SizeOf(double size) {
  constexpr int kMantissaBits = 52, kBias = 1023;
  constexpr std::uint64_t kMantissa = (std::uint64_t{1} << kMantissaBits) - 1;
  constexpr std::uint64_t kOne = std::uint64_t{kBias} << kMantissaBits;
  const auto bits = std::bit_cast<std::uint64_t>(size);
  const double part = std::bit_cast<double>((bits & kMantissa) | kOne);  // from 1 to 2
  const int quarters = (part >= kQuarterOctaves[0] ? 1 : 0) + (part >= kQuarterOctaves[1] ? 1 : 0) +
                       (part >= kQuarterOctaves[2] ? 1 : 0);
  const int octave = static_cast<int>(bits >> kMantissaBits) - kBias - kSmallestOctave;
  return static_cast<std::size_t>(std::clamp(4 * octave + quarters, 0, kSizes - 1));
}

// Calls add(i, bin) for every sample that has one, in their order.
template <class Add>
void ForEachBinned(std::span<const float> a, std::span<const float> b, std::span<const float> clip,
                   const PairSetting& setting, const Add& add) {
  Bins bins;
  for (std::size_t from = 0; from < a.size(); from += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, a.size() - from);
    FindBins(a.subspan(from, count), b.subspan(from, count), clip.subspan(from, count), setting,
             bins);
    for (std::size_t i = 0; i < count; ++i) {
      if (bins[i] != kNoBin) add(from + i, static_cast<std::size_t>(bins[i]));
    }
  }
}

}  // namespace

SampledSignals SampleRows(std::span<const SignalFrame> frames, std::size_t samples,
                          const FrameDone& done) {
  SampledSignals sampled;
  if (frames.empty()) return sampled;
  const std::vector<int> rows = SpreadRows(frames[0], samples);
  const std::size_t row_samples = frames[0].row_samples();
  sampled.row_samples = row_samples;
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
  ForEachBinned(a, b, clip, setting, [&](std::size_t i, std::size_t bin) {
    const double d = b[i] - setting.ratio * a[i];
    const double gate = setting.gate[bin];
    if (gate > 0.0 && std::abs(d) > gate) return;
    LevelSums& sum = sums[bin];
    sum.count += 1.0;
    sum.a += a[i];
    sum.b += b[i];
    sum.d += d;
    sum.d2 += d * d;
  });
  return sums;
}

std::array<double, kLevelBins> GatesOf(const PairSums& sums, double least) {
  std::array<double, kLevelBins> gates{};
  for (std::size_t bin = 0; bin < gates.size(); ++bin) {
    if (sums[bin].count < least) continue;
    gates[bin] = kGateSigmas * std::sqrt(sums[bin].d2 / sums[bin].count);
  }
  return gates;
}

std::array<double, kLevelBins> FirstGates(std::span<const float> a, std::span<const float> b,
                                          std::span<const float> clip, const PairSetting& setting,
                                          double least) {
  std::vector<std::array<std::size_t, kSizes>> sizes(kLevelBins);
  std::array<std::size_t, kLevelBins> counts{};
  ForEachBinned(a, b, clip, setting, [&](std::size_t i, std::size_t bin) {
    ++sizes[bin][SizeOf(std::abs(b[i] - setting.ratio * a[i]))];
    ++counts[bin];
  });
  std::array<double, kLevelBins> gates{};
  for (std::size_t bin = 0; bin < gates.size(); ++bin) {
    if (static_cast<double>(counts[bin]) < least) continue;
    std::size_t seen = 0;
    for (int size = 0; size < kSizes && 2 * seen < counts[bin]; ++size) {
      seen += sizes[bin][static_cast<std::size_t>(size)];
      if (2 * seen >= counts[bin] && size > 0) {
        gates[bin] = kGateSigmas * kSdPerMad * std::exp2(kSmallestOctave + (size + 1) / 4.0);
      }
    }
  }
  return gates;
}

}  // namespace lightcal
