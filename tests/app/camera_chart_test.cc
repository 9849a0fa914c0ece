// SPDX-License-Identifier: Apache-2.0
// The common chart of 6 x 4 patches, found in the picture without a word about its corners.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "camera_fixture.h"

namespace lightcal::test {
namespace {

using nlohmann::json;

struct Lab {
  double l, a, b;
};
// Averages of the chart's patches in D50, as its maker publishes them for charts since November
// 2014 (rounded). Row by row.
constexpr std::array<Lab, 24> kPatches = {
    {{37.5, 14.4, 14.9},  {64.7, 19.3, 17.5},   {49.3, -3.8, -22.5}, {43.5, -12.7, 22.7},
     {54.9, 9.6, -24.8},  {70.5, -32.3, -0.4},  {62.7, 35.8, 56.5},  {39.4, 10.8, -45.2},
     {50.6, 48.6, 16.7},  {30.1, 22.5, -20.9},  {71.8, -24.1, 58.2}, {71.5, 18.2, 67.4},
     {28.4, 15.4, -49.8}, {54.4, -39.7, 32.3},  {42.4, 51.1, 28.6},  {81.8, 2.7, 80.4},
     {50.6, 51.3, -14.1}, {49.6, -29.7, -28.3}, {95.2, -1.0, 2.9},   {81.3, -0.6, 0.4},
     {66.9, -0.8, -0.1},  {50.8, -0.1, 0.1},    {35.6, -0.5, -0.5},  {20.6, 0.1, -0.5}}};

// Under a D50 lamp that makes white 500 cd/m2.
SyntheticXyz XyzOfPatch(const Lab& lab) {
  const auto inverse = [](double f) {
    return f > 6.0 / 29.0 ? f * f * f : 108.0 / 841.0 * (f - 4.0 / 29.0);
  };
  const double fy = (lab.l + 16.0) / 116.0;
  return {500.0 * 0.96422 * inverse(fy + lab.a / 500.0), 500.0 * inverse(fy),
          500.0 * 0.82521 * inverse(fy - lab.b / 200.0)};
}

class CameraChart : public CameraFolder {
 protected:
  CameraChart() {
    camera_.width = 480;
    camera_.height = 340;
  }
  // The chart, 16.75 x 11.25 units, in the middle of a grey wall, turned by `degrees`.
  SyntheticScene Wall(double degrees) const {
    const double c = std::cos(degrees * std::numbers::pi / 180.0);
    const double s = std::sin(degrees * std::numbers::pi / 180.0);
    const double cx = 0.5 * camera_.width, cy = 0.5 * camera_.height;
    return [=](int x, int y) {
      constexpr double kPixelsPerUnit = 20.0;
      const double right = x + 0.5 - cx, down = y + 0.5 - cy;
      const double u = (c * right + s * down) / kPixelsPerUnit + 16.75 / 2.0;
      const double v = (-s * right + c * down) / kPixelsPerUnit + 11.25 / 2.0;
      if (u < 0.0 || v < 0.0 || u >= 16.75 || v >= 11.25) return XyzOfPatch({70.0, 0.0, 0.0});
      const double in_u = std::fmod(u, 2.75), in_v = std::fmod(v, 2.75);
      const bool frame = in_u < 0.25 || in_v < 0.25;
      if (frame) return XyzOfPatch({15.0, 0.0, 0.0});
      const auto place =
          static_cast<std::size_t>(u / 2.75) + 6 * static_cast<std::size_t>(v / 2.75);
      return XyzOfPatch(kPatches[place]);
    };
  }
  static std::string ChartFile() {
    std::string file = "name,column,row,L,a,b\n";
    for (std::size_t i = 0; i < kPatches.size(); ++i) {
      file += "p" + std::to_string(i) + "," + std::to_string(i % 6 + 1) + "," +
              std::to_string(i / 6 + 1) + "," + std::to_string(kPatches[i].l) + "," +
              std::to_string(kPatches[i].a) + "," + std::to_string(kPatches[i].b) + "\n";
    }
    return file;
  }
};

TEST_F(CameraChart, IsFoundWhicheverWayRoundItHangs) {
  folder_.Write("chart.csv", ChartFile());
  for (const double degrees : {3.0, 184.0}) {
    Shoot("chart", Steady(3, 8.0, 4, 1.0 / 256), Wall(degrees));
    const json profile = Profile(Frames("chart", "chart_*.dng", "chart = \"chart.csv\"\n"));
    EXPECT_EQ(profile["color"]["source"], "chart") << profile.dump();
    EXPECT_LT(double(profile["color"]["delta_e_mean"]), 1.0) << degrees;
  }
}

TEST_F(CameraChart, IsAskedForWhereNoneIs) {
  folder_.Write("chart.csv", ChartFile());
  Shoot("chart", Steady(3, 8.0, 4, 1.0 / 256), [](int, int) { return XyzOf(300.0); });
  ExpectRefused(Frames("chart", "chart_*.dng", "chart = \"chart.csv\"\n"), "chart_not_found");
}

}  // namespace
}  // namespace lightcal::test
