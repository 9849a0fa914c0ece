// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/contours.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightcal::report {
namespace {

std::vector<float> Field(int width, int height, double (*f)(double, double)) {
  std::vector<float> out;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) out.push_back(static_cast<float>(f(x, y)));
  }
  return out;
}

TEST(Contours, ARoundHillHasOneClosedCircle) {
  const auto field =
      Field(101, 81, [](double x, double y) { return 100.0 - std::hypot(x - 50.0, y - 40.0); });
  const auto lines = ContoursOf({field.data(), 101, 81}, 100.0 - 30.3);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].front(), lines[0].back());
  for (const auto& [x, y] : lines[0]) EXPECT_NEAR(std::hypot(x - 50.0, y - 40.0), 30.3, 0.02);
}

TEST(Contours, ASlopeHasOneLineFromEdgeToEdge) {
  const auto field = Field(40, 30, [](double x, double y) { return x + 0.5 * y; });
  const auto lines = ContoursOf({field.data(), 40, 30}, 20.25);
  ASSERT_EQ(lines.size(), 1U);
  for (const auto& [x, y] : lines[0]) EXPECT_NEAR(x + 0.5 * y, 20.25, 1e-6);
  EXPECT_NEAR(std::abs(lines[0].front().second - lines[0].back().second), 29.0, 1e-9);
}

TEST(Contours, SaddlesKeepEveryLineWhole) {
  const auto field = Field(
      41, 41, [](double x, double y) { return std::sin(0.5 * x + 0.1) * std::sin(0.5 * y + 0.1); });
  std::size_t points = 0;
  for (const Contour& line : ContoursOf({field.data(), 41, 41}, 0.001)) {
    points += line.size();
    const bool closed = line.front() == line.back();
    const auto at_edge = [](const PagePoint& p) {
      return p.first == 0.0 || p.second == 0.0 || p.first == 40.0 || p.second == 40.0;
    };
    EXPECT_TRUE(closed || (at_edge(line.front()) && at_edge(line.back())));
  }
  EXPECT_GT(points, 300U);
  const auto flat = Field(5, 5, [](double, double) { return 1.0; });
  EXPECT_TRUE(ContoursOf({flat.data(), 5, 5}, 2.0).empty());
}

TEST(Contours, BlocksAreMeans) {
  const auto field = Field(10, 4, [](double x, double) { return x; });
  const ReducedField small = Reduce({field.data(), 10, 4}, 5);
  EXPECT_EQ(small.block, 2);
  EXPECT_EQ(small.width, 5);
  EXPECT_FLOAT_EQ(small.view()(1, 1), 2.5F);
}

}  // namespace
}  // namespace lightcal::report
