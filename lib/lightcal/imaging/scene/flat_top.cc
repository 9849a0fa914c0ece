// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/scene/flat_top.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "lightcal/photometry/half_range.h"

namespace lightcal {

namespace {

FlatTop TopWithin(std::span<const float> samples, float share) {
  FlatTop top;
  if (samples.empty()) return top;
  top.value = *std::ranges::max_element(samples);
  for (const float value : samples) {
    if (value == top.value) {
      ++top.at;
    } else if (value > share * top.value) {
      ++top.below;
    }
  }
  return top;
}

}  // namespace

FlatTop TopOf(std::span<const float> samples) {
  constexpr float kJustBelow = 0.99F;  // a step of RGBE (eight bits of mantissa: 1/128) or more
  return TopWithin(samples, kJustBelow);
}

bool IsCutOff(const FlatTop& top, int least) {
  constexpr int kMoreThanBelow = 4;
  return top.at >= least && top.at > kMoreThanBelow * top.below;
}

bool IsFormatsEnd(float sample) {
  constexpr std::array kEnds = {1.0F, 255.0F, 4095.0F, 16383.0F, float{kLargestHalf}, 65535.0F};
  return std::ranges::find(kEnds, sample) != kEnds.end();
}

std::vector<std::uint8_t> PixelsFrom(View2d<const float> samples, double level) {
  std::vector<std::uint8_t> from;
  from.reserve(static_cast<std::size_t>(samples.width()) * samples.height());
  for (int y = 0; y < samples.height(); ++y) {
    for (int x = 0; x < samples.width(); ++x) {
      bool any = false;
      for (int c = 0; c < samples.channels(); ++c) any |= double{samples(x, y, c)} >= level;
      from.push_back(any ? 1 : 0);
    }
  }
  return from;
}

namespace {

// Whether a few pixels at the top are no smooth peak's. Of a peak cut off at a share f of its
// height ln(1/f) / ln(1/g) times as many lie at the top as in the ring from there down to g of it:
// more than the ring has means that a tenth and more was cut off. In so few pixels a tie is one of
// the file's steps as well, of which RGBE has but eight bits.
bool IsAboveItsRing(std::span<const float> nits) {
  constexpr float kRing = 0.9F;
  const FlatTop top = TopWithin(nits, kRing);
  return top.at > top.below;
}

// Radiance's pixels share an exponent: the largest of each has eight bits.
bool HasEightBits(std::span<const float> samples) {
  for (std::size_t i = 0; i + 2 < samples.size(); i += 3) {
    const float most = std::max({samples[i], samples[i + 1], samples[i + 2]});
    int exponent = 0;
    const float halves = std::ldexp(std::frexp(most, &exponent), 9);
    if (halves != std::floor(halves)) return false;
  }
  return true;
}

// Whether the one pixel that is brightest ends where a format does, or is as bright as any in two
// channels alike (of RGBE, whose steps tie two in every fifty, in all three), which no light is by
// chance in a picture with colour.
bool IsCutOffPixel(std::span<const float> samples, int channels, std::size_t at, float nits) {
  if (IsFormatsEnd(nits)) return true;
  if (channels != 3) return false;
  std::array<float, 3> most{};
  bool colour = false;
  for (std::size_t i = 0; i + 2 < samples.size(); i += 3) {
    for (std::size_t c = 0; c < 3; ++c) most[c] = std::max(most[c], samples[i + c]);
    colour = colour || samples[i] != samples[i + 1];
  }
  int alike = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t next = (c + 1) % 3;
    if (samples[3 * at + c] == most[c] && most[c] == most[next]) ++alike;
  }
  return colour && alike >= (HasEightBits(samples) ? 3 : 1);
}

// A channel's largest value, where it is cut off there: what is smooth, noisy or of eight bits of
// mantissa has neighbours within 2 %.
std::optional<float> ChannelEnd(std::span<const float> samples, std::size_t channel) {
  constexpr int kLeast = 4, kMoreThanNear = 4;
  constexpr float kNear = 0.98F;
  float most = 0.0F;
  for (std::size_t i = channel; i < samples.size(); i += 3) most = std::max(most, samples[i]);
  int at = 0, near = 0;
  for (std::size_t i = channel; i < samples.size(); i += 3) {
    if (samples[i] > kNear * most) ++(samples[i] == most ? at : near);
  }
  return at >= kLeast && at > kMoreThanNear * near ? std::optional(most) : std::nullopt;
}

}  // namespace

std::vector<std::uint8_t> CutOffPixels(std::span<const float> samples, int channels,
                                       std::span<const float> nits) {
  constexpr int kPlateau = 2;  // so many pixels that share the picture's largest value
  constexpr int kFew = 8;      // of which a smooth peak's may be as many
  const FlatTop top = TopOf(nits);
  const auto at = static_cast<std::size_t>(std::ranges::find(nits, top.value) - nits.begin());
  const bool cut_off = top.at == 1
                           ? IsCutOffPixel(samples, channels, at, top.value)
                           : IsCutOff(top, kPlateau) &&
                                 (top.at > kFew || IsFormatsEnd(top.value) || IsAboveItsRing(nits));
  std::vector<std::uint8_t> pixels;
  const auto mark = [&](std::size_t i, bool ends) {
    pixels.resize(nits.size(), 0);
    if (ends) pixels[i] = 1;
  };
  for (std::size_t i = 0; cut_off && i < nits.size(); ++i) mark(i, nits[i] >= top.value);
  for (std::size_t c = 0; c < 3 && channels == 3; ++c) {
    const std::optional<float> end = ChannelEnd(samples, c);
    for (std::size_t i = 0; end && i < nits.size(); ++i) mark(i, samples[3 * i + c] >= *end);
  }
  return pixels;
}

}  // namespace lightcal
