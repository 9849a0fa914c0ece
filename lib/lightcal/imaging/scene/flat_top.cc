// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/scene/flat_top.h"

#include <algorithm>
#include <array>

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
  constexpr std::array kEnds = {1.0F, 255.0F, 4095.0F, 16383.0F, 65504.0F, 65535.0F};
  return std::ranges::find(kEnds, sample) != kEnds.end();
}

}  // namespace lightcal
