// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/light_models.h"

#include <gtest/gtest.h>

#include "lightcal/colorimetry/cct.h"

namespace lightcal {
namespace {

TEST(GaussianSpectrum, IsHalfAsHighHalfAWidthFromItsPeak) {
  const auto s = GaussianSpectrum(Nanometres(530.0), Nanometres(30.0));
  ASSERT_TRUE(s);
  EXPECT_DOUBLE_EQ(s->values[530 - 360], 100.0);
  EXPECT_NEAR(s->values[515 - 360], 50.0, 1e-9);
  EXPECT_NEAR(s->values[545 - 360], 50.0, 1e-9);
  EXPECT_EQ(GaussianSpectrum(Nanometres(300.0), Nanometres(30.0)).error().code, "out_of_range");
  EXPECT_EQ(GaussianSpectrum(Nanometres(530.0), Nanometres(0.0)).error().code, "out_of_range");
}

TEST(PhosphorLed, HasTheTemperatureItWasAskedFor) {
  struct Lamp {
    double kelvin, phosphor_nm;
  };
  for (const Lamp lamp : {Lamp{2700.0, 605.0}, Lamp{4000.0, 580.0}, Lamp{6500.0, 570.0}}) {
    const auto led = PhosphorLedSpectrum(Kelvin(lamp.kelvin), Nanometres(lamp.phosphor_nm));
    ASSERT_TRUE(led) << lamp.kelvin;
    const CctResult cct = CctFromXy(XyFromXyz(*XyzFromSpectrum(*led)));
    EXPECT_NEAR(cct.temperature.value(), lamp.kelvin, 1e-3);
    EXPECT_TRUE(cct.valid());
  }
}

TEST(PhosphorLed, WithoutSuchAMixtureIsRefused) {
  EXPECT_EQ(PhosphorLedSpectrum(Kelvin(1200)).error().code, "out_of_range");
  EXPECT_EQ(PhosphorLedSpectrum(Kelvin(4000), Nanometres(200.0)).error().code, "out_of_range");
}

}  // namespace
}  // namespace lightcal
