// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/scene/flat_top.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "lightcal/photometry/half_range.h"

namespace lightcal {

FlatTop TopOf(std::span<const float> samples) {
  constexpr float kJustBelow = 1.0F - 0x1p-9F;  // two steps of 16 bit floats or more
  FlatTop top;
  if (samples.empty()) return top;
  top.value = *std::ranges::max_element(samples);
  for (const float value : samples) {
    if (value == top.value) {
      ++top.at;
    } else if (value > kJustBelow * top.value) {
      ++top.below;
    }
  }
  return top;
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

}  // namespace lightcal
