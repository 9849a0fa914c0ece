// SPDX-License-Identifier: Apache-2.0
// The errors of the seed document about colour (its sections 6.1 to 6.5); rows.txt lists them.
#include <gtest/gtest.h>

#include <cmath>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/daylight.h"
#include "lightcal/colorimetry/planckian.h"
#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/colorimetry/spectrum.h"

namespace lightcal {
namespace {

// The seed's daylight polynomial above 7000 K, as printed.
double SeedHotDaylightX(double t) {
  return ((-2.0064e9 / t + 1.9081e6) / t + 0.24748e3) / t + 0.237040;
}

TEST(SeedErrors, BlueColumnOfSrgbEndsIn0950532) {
  const double seed = 0.0950536;
  Matrix3 matrix = XyzFromRgbMatrix(RgbSpace::kSrgb);
  EXPECT_NEAR(matrix[2][2], 0.950532, 5e-6);
  EXPECT_GT(std::abs(matrix[2][2] - seed), 0.85);
  // Exact: white (1,1,1) has the chromaticity of D65. With the seed's entry it would be .435 .458.
  const auto white = [&matrix] {
    const auto sum = [](const auto& row) { return row[0] + row[1] + row[2]; };
    return XyFromXyz({sum(matrix[0]), sum(matrix[1]), sum(matrix[2])});
  };
  EXPECT_NEAR(white().x, 0.3127, 1e-14);
  EXPECT_NEAR(white().y, 0.3290, 1e-14);
  matrix[2][2] = seed;
  EXPECT_NEAR(white().x, 0.435, 1e-3);
  EXPECT_NEAR(white().y, 0.458, 1e-3);
}

TEST(SeedErrors, HotDaylightTakes19018ThousandOverTSquared) {
  const double ours = DaylightXy(Kelvin(10000))->x;
  EXPECT_NEAR(ours, ((-2.0064e9 / 1e4 + 1.9018e6) / 1e4 + 0.24748e3) / 1e4 + 0.237040, 1e-15);
  EXPECT_NEAR(SeedHotDaylightX(10000) - ours, 6.3e-5, 1e-7);
  // Independent: with the right constant the two branches meet at 7000 K; the seed's leap 1.3e-4.
  const double below = DaylightXy(Kelvin(7000))->x;
  const double above = DaylightXy(Kelvin(7000.0001))->x;
  EXPECT_NEAR(above, below, 5e-7);
  EXPECT_GT(std::abs(SeedHotDaylightX(7000.0001) - below), 1.2e-4);
}

// "Colour temperature to RGB" in the seed is daylight only: nothing for a lamp.
TEST(SeedErrors, LampsBelow4000KelvinHaveAColour) {
  EXPECT_FALSE(DaylightXy(Kelvin(2856)).has_value());
  const Xy lamp = XyFromCct(Kelvin(2848.0 * kC2MetreKelvin / kC2OfIlluminantAMetreKelvin));
  EXPECT_NEAR(lamp.x, 0.4475735, 1e-7);  // illuminant A, by its own formula
  EXPECT_NEAR(lamp.y, 0.4074394, 1e-7);
  const Rgb rgb = LinearSrgbFromXyz(XyzFromXyAtUnitY(lamp));
  EXPECT_GT(rgb.r, 1.5);
  EXPECT_LT(rgb.b, 0.3);
}

TEST(SeedErrors, SevenThousandKelvinBelongsToTheFirstBranch) {
  const double first = ((-4.6070e9 / 7e3 + 2.9678e6) / 7e3 + 0.09911e3) / 7e3 + 0.244063;
  const double second = ((-2.0064e9 / 7e3 + 1.9018e6) / 7e3 + 0.24748e3) / 7e3 + 0.237040;
  EXPECT_GT(std::abs(first - second), 4e-7);  // so it matters which is meant
  EXPECT_DOUBLE_EQ(DaylightXy(Kelvin(7000))->x, first);
  EXPECT_NEAR(DaylightXy(Kelvin(std::nextafter(7000.0, 7001.0)))->x, second, 1e-12);
}

// Nearest means nearest in CIE 1960 uv: in xy another temperature would be "nearest".
TEST(SeedErrors, NearestIsMeantInUvAndOnlyNearTheLocus) {
  const Xy greenish = XyFromCct(Kelvin(4000), 0.02);
  EXPECT_NEAR(CctFromXy(greenish).temperature.value(), 4000.0, 1e-5);
  double best_K = 0.0, best = 1.0;
  for (double t = 2500; t < 7000; t += 1) {
    const Xy on = XyFromCct(Kelvin(t));
    const double distance = std::hypot(on.x - greenish.x, on.y - greenish.y);
    if (distance < best) best = distance, best_K = t;
  }
  EXPECT_GT(std::abs(best_K - 4000.0), 100.0);
  EXPECT_FALSE(CctFromXy(XyFromCct(Kelvin(4000), 0.06)).valid());
  EXPECT_FALSE(CctFromXy({0.15, 0.06}).valid());
}

TEST(SeedErrors, NamesOfDaylightIlluminantsAreNotTheirTemperatures) {
  const struct {
    double name_K, nominal_K;
  } rows[] = {{5000, 5003}, {5500, 5503}, {6500, 6504}, {7500, 7504}};
  for (const auto& row : rows) {
    const double nominal = DaylightTemperatureOfName(Kelvin(row.name_K)).value();
    EXPECT_NEAR(nominal, row.nominal_K, 0.5);
    EXPECT_GT(nominal - row.name_K, 2.5);
  }
  // Nor is the nominal value the CCT of the illuminant itself: D65 is 6502.71 K.
  const Spectrum d65 = *DaylightSpectrum(DaylightTemperatureOfName(Kelvin(6500)));
  const double exact = CctFromXy(XyFromXyz(*XyzFromSpectrum(d65))).temperature.value();
  EXPECT_NEAR(exact, 6502.71, 0.02);
}

}  // namespace
}  // namespace lightcal
