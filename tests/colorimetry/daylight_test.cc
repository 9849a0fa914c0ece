// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/daylight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lightcal/colorimetry/cct.h"

namespace lightcal {
namespace {

// CIE 15:2018, chromaticities of the D illuminants. They are those of the published spectra, whose
// weights M1 and M2 are rounded to three decimals: up to 1.04e-4 beside the formula.
TEST(Daylight, NamedIlluminantsLieOnTheLocus) {
  const struct {
    double name_K, x, y;
  } published[] = {{5000, 0.34567, 0.35851},
                   {5500, 0.33243, 0.34744},
                   {6500, 0.31272, 0.32903},
                   {7500, 0.29903, 0.31488}};
  for (const auto& p : published) {
    const Xy xy = *DaylightXy(DaylightTemperatureOfName(Kelvin(p.name_K)));
    EXPECT_NEAR(xy.x, p.x, 1.1e-4) << p.name_K;
    EXPECT_NEAR(xy.y, p.y, 1.1e-4) << p.name_K;
  }
}

TEST(Daylight, TheTwoBranchesMeetWithinFiveTenMillionths) {
  const double below = DaylightXy(Kelvin(7000))->x;
  const double above = DaylightXy(Kelvin(std::nextafter(7000.0, 8000.0)))->x;
  EXPECT_NEAR(below, 0.30535743, 5e-9);
  EXPECT_NEAR(above, 0.30535697, 5e-9);
}

TEST(Daylight, NominalTemperatureIsNotTheExactOne) {
  const auto shift = [](double t) {
    return CctFromXy(*DaylightXy(Kelvin(t))).temperature.value() - t;
  };
  EXPECT_NEAR(shift(5000), -0.2, 0.05);
  EXPECT_NEAR(shift(6504), -1.3, 0.05);
  EXPECT_NEAR(shift(10000), -7.2, 0.1);
  EXPECT_NEAR(shift(20000), -46, 1);
}

TEST(Daylight, LiesThreeThousandthsAboveThePlanckianLocus) {
  for (double t = 4000; t <= 25000; t += 500) {
    const double duv = CctFromXy(*DaylightXy(Kelvin(t))).duv;
    EXPECT_GT(duv, 0.0026) << t;
    EXPECT_LT(duv, 0.0034) << t;
  }
}

TEST(Daylight, OutsideItsRangeIsRefused) {
  for (const double t : {3999.0, 25001.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                         std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(DaylightXy(Kelvin(t)).error().code, "out_of_range");
    EXPECT_FALSE(DaylightSpectrum(Kelvin(t)).has_value());
  }
}

// CIE's published D65 table at 1 nm (DOI 10.25039/CIE.DS.hjfjmt59).
TEST(Daylight, SpectrumOfD65IsCies) {
  const Spectrum d65 = *DaylightSpectrum(DaylightTemperatureOfName(Kelvin(6500)));
  const auto at = [&d65](int nm) { return d65.values[static_cast<std::size_t>(nm - 300)]; };
  EXPECT_EQ(d65.values.size(), 531u);
  EXPECT_DOUBLE_EQ(at(560), 100.0);
  EXPECT_NEAR(at(300), 0.0341, 5e-5);
  EXPECT_NEAR(at(400), 82.7549, 5e-4);
  EXPECT_NEAR(at(450), 117.008, 5e-3);
  EXPECT_NEAR(at(700), 71.6091, 5e-3);
  EXPECT_NEAR(at(830), 60.3125, 5e-3);
}

}  // namespace
}  // namespace lightcal
