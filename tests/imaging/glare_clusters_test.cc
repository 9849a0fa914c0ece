// SPDX-License-Identifier: Apache-2.0
// Groups of pixels against every pair looked at.
#include "lightcal/imaging/scene/glare_clusters.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

namespace lightcal {
namespace {

// Every pair of pixels within reach is joined, by passes until nothing changes.
std::vector<int> ByEveryPair(const std::vector<char>& picked, const PixelSolidAngles& angles,
                             double reach) {
  const int width = angles.view().width;
  std::vector<std::size_t> pixels;
  std::vector<Vec3> directions;
  for (std::size_t i = 0; i < picked.size(); ++i) {
    if (picked[i] == 0) continue;
    pixels.push_back(i);
    directions.push_back(*angles.Direction(static_cast<double>(i % width) + 0.5,
                                           static_cast<double>(i / width) + 0.5));
  }
  std::vector<int> group(picked.size(), 0);
  int next = 0;
  for (std::size_t seed = 0; seed < pixels.size(); ++seed) {
    if (group[pixels[seed]] != 0) continue;
    group[pixels[seed]] = ++next;
    std::vector<std::size_t> open = {seed};
    while (!open.empty()) {
      const std::size_t p = open.back();
      open.pop_back();
      for (std::size_t q = 0; q < pixels.size(); ++q) {
        if (group[pixels[q]] != 0) continue;
        if (2.0 * std::asin(Length(directions[p] - directions[q]) / 2.0) > reach) continue;
        group[pixels[q]] = next;
        open.push_back(q);
      }
    }
  }
  return group;
}

class Groups : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Reaches, Groups, testing::Values(0.02, 0.05, 0.1, 0.4),
                         [](const auto& parameter) {
                           return "milliradians" +
                                  std::to_string(static_cast<int>(1000 * parameter.param));
                         });

TEST_P(Groups, AreThoseThatEveryPairOfPixelsMakes) {
  constexpr int kSize = 90;
  std::mt19937 random(7);
  for (const Projection projection : {Projection::kEquidistant, Projection::kEquisolid}) {
    const auto angles =
        PixelSolidAngles::Create({projection, kSize, kSize, Radians(std::numbers::pi)});
    ASSERT_TRUE(angles);
    for (int trial = 0; trial < 4; ++trial) {
      std::vector<char> picked(std::size_t{kSize} * kSize, 0);
      for (int blob = 0; blob < 14 + 20 * trial; ++blob) {
        const int x = static_cast<int>(random() % kSize), y = static_cast<int>(random() % kSize);
        const int r = static_cast<int>(random() % 4);
        for (int dy = -r; dy <= r; ++dy) {
          for (int dx = -r; dx <= r; ++dx) {
            const int px = x + dx, py = y + dy;
            const bool inside = px >= 0 && px < kSize && py >= 0 && py < kSize;
            if (!inside || !angles->Direction(px + 0.5, py + 0.5)) continue;
            picked[static_cast<std::size_t>(py) * kSize + px] = 1;
          }
        }
      }
      EXPECT_EQ(GroupPixels(picked, *angles, Radians(GetParam())),
                ByEveryPair(picked, *angles, GetParam()));
    }
  }
}

}  // namespace
}  // namespace lightcal
