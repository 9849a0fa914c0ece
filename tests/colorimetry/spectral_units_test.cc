// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/spectral_units.h"

#include <gtest/gtest.h>

#include "lightcal/colorimetry/daylight.h"

namespace lightcal {
namespace {

TEST(SpectralUnit, OneMicromoleOfPhotonsAt555NanometresCarries0Point2155Watts) {
  // E = h c / l = 3.5792e-19 J a photon, times 6.02214e17.
  EXPECT_NEAR(WattsOfUnit(SpectralUnit::kQuanta, Nanometres(555.0)), 0.21554, 1e-5);
  EXPECT_NEAR(WattsOfUnit(SpectralUnit::kQuanta, Nanometres(400.0)) /
                  WattsOfUnit(SpectralUnit::kQuanta, Nanometres(800.0)),
              2.0, 1e-12);
}

TEST(SpectralUnit, TheSameLightInAnyUnitGivesTheSameIlluminance) {
  Spectrum watts = *DaylightSpectrum(Kelvin(5500));
  watts.quantity = SpectralQuantity::kIrradiance;
  const double lux = XyzFromSpectrum(watts)->Y;
  for (const SpectralUnit unit :
       {SpectralUnit::kMilliwatts, SpectralUnit::kMicrowatts, SpectralUnit::kQuanta}) {
    Spectrum other = watts;
    other.quantity = SpectralQuantity::kRelative;
    for (std::size_t i = 0; i < other.values.size(); ++i) {
      other.values[i] /= WattsOfUnit(unit, Nanometres(other.wavelengths_nm[i]));
    }
    EXPECT_NEAR(XyzFromSpectrum(IrradianceFrom(other, unit))->Y / lux, 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace lightcal
