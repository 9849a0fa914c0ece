// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/illuminants.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/planckian.h"
#include "vector_file.h"

namespace lightcal {
namespace {

using test::ReadVectors;
using test::VectorRow;

Spectrum Light(const std::string& name) {
  auto spectrum = IlluminantSpectrum(name);
  EXPECT_TRUE(spectrum.has_value()) << name;
  return std::move(spectrum).value();
}

// Every fifth nanometre of 380-780 nm, as the CIE 15 tables are summed.
Spectrum EveryFiveNanometres(const Spectrum& s) {
  Spectrum coarse;
  for (std::size_t i = 0; i < s.values.size(); ++i) {
    const double nm = s.wavelengths_nm[i];
    if (nm < 380 || nm > 780 || std::fmod(nm, 5.0) != 0.0) continue;
    coarse.wavelengths_nm.push_back(nm);
    coarse.values.push_back(s.values[i]);
  }
  return coarse;
}

Xy XyOf(const Spectrum& s) { return XyFromXyz(XyzFromSpectrum(s).value()); }

class Illuminant : public testing::TestWithParam<VectorRow> {};

TEST_P(Illuminant, HasThePublishedChromaticityInTheFiveNanometreSum) {
  const VectorRow& row = GetParam();
  const Xy xy = XyOf(EveryFiveNanometres(Light(row.Text("name"))));
  EXPECT_NEAR(xy.x, row.Number("x_5nm_380_780"), 5e-6);
  EXPECT_NEAR(xy.y, row.Number("y_5nm_380_780"), 5e-6);
  if (row.Text("x_published").empty()) return;
  EXPECT_NEAR(xy.x, row.Number("x_published"), 5e-5);
  EXPECT_NEAR(xy.y, row.Number("y_published"), 5e-5);
}

TEST_P(Illuminant, HasTheCorrelatedTemperatureOfTheExactSolver) {
  const VectorRow& row = GetParam();
  const CctResult found = CctFromXy(XyOf(EveryFiveNanometres(Light(row.Text("name")))));
  EXPECT_NEAR(found.temperature.value(), row.Number("cct_exact_5nm"), 0.5);
  EXPECT_NEAR(found.duv, row.Number("duv_exact_5nm"), 5e-6);
}

INSTANTIATE_TEST_SUITE_P(Cie, Illuminant, testing::ValuesIn(ReadVectors("illuminants.csv")),
                         [](const auto& each) {
                           std::string name = each.param.Text("name");
                           for (char& c : name) c = std::isalnum(c) ? c : '_';
                           return name;
                         });

TEST(Illuminants, IlluminantAIsABlackBodyOfItsRescaledTemperature) {
  const double t = 2848.0 * kC2MetreKelvin / kC2OfIlluminantAMetreKelvin;
  const CctResult found = CctFromXy(XyOf(Light("A")));
  EXPECT_NEAR(found.temperature.value(), t, 1e-6);
  EXPECT_NEAR(found.duv, 0.0, 1e-12);
}

// CIE's own 1 nm table, DOI 10.25039/CIE.DS.8jsxjrsn: six digits.
TEST(Illuminants, IlluminantAHasTheTabulatedPower) {
  const Spectrum a = Light("A");
  const auto at = [&](int nm) { return a.values[static_cast<std::size_t>(nm - 360)]; };
  EXPECT_NEAR(at(380), 9.79510, 5e-6);
  EXPECT_NEAR(at(560), 100.0, 1e-12);
  EXPECT_NEAR(at(780), 241.675, 5e-4);
}

TEST(Illuminants, ABlackBodyByNameIsOnTheLocus) {
  const CctResult found = CctFromXy(XyOf(Light("P3200")));
  EXPECT_NEAR(found.temperature.value(), 3200.0, 1e-6);
  EXPECT_NEAR(found.duv, 0.0, 1e-12);
}

TEST(Illuminants, NamesAreReadInAnyCaseAndTheOldNameOfALampIsKnown) {
  EXPECT_EQ(Light("fl11").values, Light("FL11").values);
  EXPECT_EQ(Light("F11").values, Light("FL11").values);
  EXPECT_EQ(Light(" led-b3 ").values, Light("LED-B3").values);
}

TEST(Illuminants, EveryNameListedIsALight) {
  const auto names = IlluminantNames();
  EXPECT_EQ(names.size(), 50u);
  for (const std::string& name : names) {
    EXPECT_TRUE(XyzFromSpectrum(Light(name)).has_value()) << name;
  }
}

TEST(Illuminants, WhatIsNoIlluminantIsRefusedWithTheList) {
  for (const char* name : {"", "FL13", "FL3.16", "LED-B6", "D", "D6504x", "P", "f", "sun"}) {
    const auto light = IlluminantSpectrum(name);
    ASSERT_FALSE(light.has_value()) << name;
    EXPECT_EQ(light.error().code, "unknown_illuminant") << name;
  }
  EXPECT_NE(IlluminantSpectrum("sun").error().message.find("LED-RGB1"), std::string::npos);
  EXPECT_EQ(IlluminantSpectrum("D30").error().code, "out_of_range");
  EXPECT_EQ(IlluminantSpectrum("P100").error().code, "out_of_range");
}

}  // namespace
}  // namespace lightcal
