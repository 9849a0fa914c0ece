// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/daylight.h"
#include "lightcal/colorimetry/illuminants.h"
#include "vector_file.h"

namespace lightcal {
namespace {

template <class Function>
Spectrum Sampled(const std::vector<double>& wavelengths_nm, Function value,
                 SpectralQuantity quantity = SpectralQuantity::kIrradiance) {
  Spectrum s{wavelengths_nm, {}, quantity};
  for (const double nm : wavelengths_nm) s.values.push_back(value(nm));
  return s;
}

std::vector<double> Steps(double first, double last, double step) {
  std::vector<double> all;
  for (int i = 0; first + i * step <= last + 1e-9; ++i) all.push_back(first + i * step);
  return all;
}

double Lamp(double nm) {  // smooth, in W m^-2 nm^-1
  return 1e-3 * (0.3 + std::exp(-std::pow((nm - 450) / 12, 2)) +
                 1.4 * std::exp(-std::pow((nm - 590) / 70, 2)));
}

TEST(XyzFromSpectrum, EqualEnergyIsTheSumOfTheTableTimes683) {
  const Xyz c = *XyzFromSpectrum(Sampled(Steps(360, 830, 1), [](double) { return 1.0; }));
  EXPECT_NEAR(c.Y, 683.002 * 106.8569171, 1e-4);
  EXPECT_NEAR(c.X / c.Y, 106.86546949 / 106.8569171, 1e-9);
  EXPECT_NEAR(c.Z / c.Y, 106.89225128 / 106.8569171, 1e-9);
}

TEST(XyzFromSpectrum, ARelativeSpectrumIsScaledToAHundred) {
  const auto relative = SpectralQuantity::kRelative;
  const Xyz a = *XyzFromSpectrum(Sampled(Steps(380, 780, 1), Lamp, relative));
  const Xyz b = *XyzFromSpectrum(
      Sampled(Steps(380, 780, 1), [](double nm) { return 77 * Lamp(nm); }, relative));
  EXPECT_DOUBLE_EQ(a.Y, 100.0);
  EXPECT_NEAR(a.X, b.X, 1e-10);
}

// D illuminants: exact CCT, Duv and efficacy of independently computed sums.
TEST(XyzFromSpectrum, DaylightIlluminantsHaveTheirReferenceColours) {
  int compared = 0;
  for (const auto& row : test::ReadVectors("illuminants.csv")) {
    const std::string& name = row.Text("name");
    if (name != "D50" && name != "D55" && name != "D65" && name != "D75") continue;
    SCOPED_TRACE(name);
    const Kelvin nominal = DaylightTemperatureOfName(Kelvin(100.0 * std::stod(name.substr(1))));
    Spectrum s = *DaylightSpectrum(nominal);
    const Xy xy = XyFromXyz(*XyzFromSpectrum(s));
    EXPECT_NEAR(xy.x, row.Number("x_1nm"), 1e-7);
    EXPECT_NEAR(xy.y, row.Number("y_1nm"), 1e-7);
    const CctResult cct = CctFromXy(xy);
    EXPECT_NEAR(cct.temperature.value(), row.Number("cct_exact_1nm"), 1e-3);
    EXPECT_NEAR(cct.duv, row.Number("duv_exact_1nm"), 1e-7);
    s.wavelengths_nm.erase(s.wavelengths_nm.begin(), s.wavelengths_nm.begin() + 60);  // from 360
    s.values.erase(s.values.begin(), s.values.begin() + 60);
    EXPECT_NEAR(EfficacyOfRadiation(s)->value(), row.Number("LER_lm_per_W"), 0.05);
    ++compared;
  }
  EXPECT_EQ(compared, 4);
}

TEST(XyzFromSpectrum, EveryGridOfASmoothLampGivesTheSameIlluminance) {
  const double truth = XyzFromSpectrum(Sampled(Steps(360, 830, 1), Lamp))->Y;
  for (const double step : {0.25, 0.5, 2.0, 2.5, 5.0}) {
    const Xyz c = *XyzFromSpectrum(Sampled(Steps(360, 830, step), Lamp));
    EXPECT_NEAR(c.Y / truth, 1.0, 2e-4) << step;
  }
}

TEST(XyzFromSpectrum, UnequalStepsGiveTheSameColour) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> step(0.3, 2.5);
  std::vector<double> wavelengths;
  for (double nm = 360.0; nm < 830.0; nm += step(random)) wavelengths.push_back(nm);
  const Xyz truth = *XyzFromSpectrum(Sampled(Steps(360, 830, 1), Lamp));
  const Xyz c = *XyzFromSpectrum(Sampled(wavelengths, Lamp));
  EXPECT_NEAR(c.X / truth.X, 1.0, 5e-4);
  EXPECT_NEAR(c.Y / truth.Y, 1.0, 5e-4);
  EXPECT_NEAR(c.Z / truth.Z, 1.0, 2e-3);
}

// A straight ramp given by three unequal samples is the same ramp at 1 nm: a wide gap meets every
// row of the table.
TEST(XyzFromSpectrum, AWideGapIsIntegratedThroughTheTable) {
  const auto ramp = [](double nm) { return (nm - 300.0) / 500.0; };
  const Xyz truth = *XyzFromSpectrum(Sampled(Steps(360, 830, 1), ramp));
  const Xyz c = *XyzFromSpectrum(Sampled({300.0, 437.3, 900.0}, ramp));
  EXPECT_NEAR(c.X / truth.X, 1.0, 1e-5);
  EXPECT_NEAR(c.Y / truth.Y, 1.0, 1e-5);
  EXPECT_NEAR(c.Z / truth.Z, 1.0, 1e-5);
}

TEST(XyzFromSpectrum, WavelengthsRoundedToAThousandthStillCountAsEqualSteps) {
  std::vector<double> exact, rounded;
  for (int i = 0; i <= 120; ++i) {
    exact.push_back(380.0 + i * 10.0 / 3.0);
    rounded.push_back(std::round(exact.back() * 1000.0) / 1000.0);
  }
  const Xyz a = *XyzFromSpectrum(Sampled(exact, Lamp));
  const Xyz b = *XyzFromSpectrum(Sampled(rounded, Lamp));
  EXPECT_NEAR(a.Y / b.Y, 1.0, 1e-5);
  EXPECT_NEAR(a.Z / b.Z, 1.0, 1e-4);
}

TEST(XyzFromSpectrum, WhatCannotBeIntegratedIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<Spectrum> bad = {
      {},
      {{500}, {1}, {}},
      {{500, 501}, {1}, {}},
      {{500, 500, 501}, {1, 1, 1}, {}},
      {{501, 500}, {1, 1}, {}},
      {{-400, 500, 600}, {1, 1, 1}, {}},
      {{0, 500}, {1, 1}, {}},
      {{500, 501}, {1, nan}, {}},
      {{500, inf}, {1, 1}, {}},
      {{500, 501}, {0, 0}, {}},
      {{500, 501}, {-1, -1}, {}},
      {{900, 901}, {1, 1}, {}},
      {{550, 551}, {1e308, 1e308}, SpectralQuantity::kIrradiance},
  };
  for (std::size_t i = 0; i < bad.size(); ++i) {
    const auto r = XyzFromSpectrum(bad[i]);
    ASSERT_FALSE(r.has_value()) << i;
    EXPECT_EQ(r.error().kind, ErrorKind::kRefused);
    EXPECT_EQ(r.error().code, "bad_spectrum");
    EXPECT_FALSE(EfficacyOfRadiation(bad[i]).has_value());
  }
}

TEST(Spectrum, VisibleRangeIsCoveredFrom380To780) {
  const auto covers = [](double first, double last, double step) {
    return CoversVisibleRange(Sampled(Steps(first, last, step), Lamp));
  };
  EXPECT_TRUE(covers(380, 780, 1));
  EXPECT_TRUE(covers(380, 780, 5));
  EXPECT_FALSE(covers(400, 780, 5));
  EXPECT_FALSE(covers(380, 730, 5));
  EXPECT_FALSE(CoversVisibleRange({}));
}

TEST(ColorMatching, IsLinearBetweenRowsAndZeroOutside) {
  EXPECT_DOUBLE_EQ(ColorMatchingAt(Nanometres(555)).Y, 1.0);
  const double half = ColorMatchingAt(Nanometres(450.5)).Z;
  EXPECT_DOUBLE_EQ(half,
                   (ColorMatchingAt(Nanometres(450)).Z + ColorMatchingAt(Nanometres(451)).Z) / 2);
  EXPECT_EQ(ColorMatchingAt(Nanometres(359.9)).X, 0.0);
  EXPECT_GT(ColorMatchingAt(Nanometres(830)).X, 0.0);
  EXPECT_EQ(ColorMatchingAt(Nanometres(830.1)).X, 0.0);
}

// Monochromatic light at the peak of V: 683 lm/W, the definition of the candela.
TEST(EfficacyOfRadiation, IsGreatestAt555Nanometres) {
  const Spectrum line{{554.9, 555.0, 555.1}, {0, 1, 0}, SpectralQuantity::kRelative};
  EXPECT_NEAR(EfficacyOfRadiation(line)->value(), 683.0, 0.01);
}

// D65 over 380-780 nm; equal energy and A as CIE S 026's tables have them.
TEST(Melanopic, DaylightIsItsOwnMeasure) {
  const auto der = [](const char* name) {
    return MelanopicDaylightEfficacyRatio(IlluminantSpectrum(name).value()).value();
  };
  EXPECT_NEAR(der("D65"), 1.0, 5e-4);
  EXPECT_NEAR(der("E"), 0.906, 5e-4);
  EXPECT_NEAR(der("A"), 0.496, 5e-4);
}

// luxpy takes a spline through the 5 nm table and cuts it at zero, which adds light beside the
// lines of four warm lamps; their own 1 nm tables are the judge below.
TEST(Melanopic, RatioOfCieIlluminantsIsThatOfLuxpy) {
  for (const test::VectorRow& row : test::ReadVectors("illuminants.csv")) {
    const std::string& name = row.Text("name");
    const bool cut = name == "FL3.1" || name == "FL4" || name == "FL12" || name == "HP1";
    const auto der = MelanopicDaylightEfficacyRatio(IlluminantSpectrum(name).value());
    ASSERT_TRUE(der);
    EXPECT_NEAR(*der, row.Number("melanopic_DER_luxpy"), cut ? 0.004 : 3e-4) << name;
  }
}

TEST(Melanopic, RatioOfCieLampsIsThatOfTheirOneNanometreTables) {
  const auto rows = test::ReadSampleTable("cie_lamps/cie_lamps_1nm.csv");
  for (const auto& [name, ignored] : rows.front().cells()) {
    if (name == "wavelength_nm") continue;
    Spectrum fine;
    for (const test::VectorRow& row : rows) {
      fine.wavelengths_nm.push_back(row.Number("wavelength_nm"));
      fine.values.push_back(row.Number(name));
    }
    EXPECT_NEAR(MelanopicDaylightEfficacyRatio(IlluminantSpectrum(name).value()).value(),
                MelanopicDaylightEfficacyRatio(fine).value(), 1.5e-3)
        << name;
  }
}

// One wavelength: s_mel = 1 at 490 nm, V = 0.208020.
TEST(Melanopic, RatioOfOneWavelengthIsThatOfTheTables) {
  const Spectrum line{{489.9, 490.0, 490.1}, {0, 1, 0}, SpectralQuantity::kRelative};
  EXPECT_NEAR(*MelanopicDaylightEfficacyRatio(line), 1.0 / (683.002 * 0.20802 * 1.3262e-3), 1e-4);
  Spectrum noise{{450.0, 500.0, 550.0}, {-1.0, -1.0, 20.0}, SpectralQuantity::kRelative};
  EXPECT_EQ(MelanopicDaylightEfficacyRatio(noise).has_value(), true);
  noise.values[0] = -9.0;
  EXPECT_EQ(MelanopicDaylightEfficacyRatio(noise).error().code, "bad_spectrum");
}

}  // namespace
}  // namespace lightcal
