// SPDX-License-Identifier: Apache-2.0
// What moved, told from what a recovered curve leaves of a still scene.
#include "lightcal/imaging/bracket/moved_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>

namespace lightcal {
namespace {

constexpr int kAcross = 90, kDown = 60, kPatch = 7;  // a patch of 7 x 7 blocks is .9 % of them

struct Seen {
  Blocks blocks;
  Differences differences;
};

// Two frames of a still scene: levels over four decades, a curve that is wrong by up to 3 % along
// them, edges (every tenth column) off by 8 % up and down, 1 % of noise. `gain`: of the patch.
Seen Scene(unsigned seed, double gain) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Seen seen;
  seen.blocks.width = kAcross;
  seen.blocks.height = kDown;
  const double phase = normal(random), slope = normal(random);
  const int px = 5 + static_cast<int>(random() % (kAcross - 20));
  const int py = 5 + static_cast<int>(random() % (kDown - 20));
  for (int y = 0; y < kDown; ++y) {
    for (int x = 0; x < kAcross; ++x) {
      const double ln = 2.0 * std::sin(0.05 * x + phase) + slope * std::cos(0.07 * y);
      double difference = 0.03 * std::sin(1.5 * ln) + 0.01 * normal(random);
      if (x % 10 == 0) difference += 0.08 * normal(random);
      if (x >= px && x < px + kPatch && y >= py && y < py + kPatch) difference += gain;
      seen.blocks.mean.push_back(static_cast<float>(std::exp(ln)));
      seen.blocks.variance.push_back(1e-12F);
      seen.differences.relative.emplace_back(static_cast<float>(difference));
      seen.differences.disagrees.push_back(std::abs(difference) > 0.02);
      seen.differences.disagreeing += std::abs(difference) > 0.02 ? 1 : 0;
      ++seen.differences.comparable;
    }
  }
  return seen;
}

TEST(MovedShape, OfAStillSceneIsNoneThoughBlocksDisagreeEverywhere) {
  int accused = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Seen seen = Scene(seed, 0.0);
    EXPECT_GT(seen.differences.share(), 0.2);
    if (WithShape(seen.differences, seen.blocks).disagreeing > 0) ++accused;
  }
  EXPECT_LE(accused, 2);
}

TEST(MovedShape, OfAPatchTenPercentBrighterIsThatPatch) {
  int found = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Seen seen = Scene(seed, 0.1);
    const int blocks = WithShape(seen.differences, seen.blocks).disagreeing;
    if (blocks > 0) ++found;
    EXPECT_LE(blocks, (kPatch + 4) * (kPatch + 4));
  }
  EXPECT_GE(found, 190);
}

}  // namespace
}  // namespace lightcal
