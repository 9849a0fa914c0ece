// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/planckian.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/spectrum.h"
#include "vector_file.h"

namespace lightcal {
namespace {

// Planck's law with any c2, on the wavelengths of the CIE table.
Spectrum BlackBody(double temperature_K, double c2_mK, double first_nm = 360, double last_nm = 830,
                   double step_nm = 1) {
  Spectrum s;
  for (double nm = first_nm; nm <= last_nm + 1e-9; nm += step_nm) {
    const double l = nm * 1e-9;
    s.wavelengths_nm.push_back(nm);
    s.values.push_back(std::pow(nm / 560.0, -5) / std::expm1(c2_mK / (l * temperature_K)));
  }
  return s;
}

CctResult CctOf(const Spectrum& s) { return CctFromXy(XyFromXyz(*XyzFromSpectrum(s))); }

TEST(Planckian, ReferenceColoursAreMetToTheirLastDigit) {
  for (const auto& row : test::ReadVectors("blackbody_rgb.csv")) {
    SCOPED_TRACE(row.Text("cct_K"));
    const Xyz c = PlanckianXyz(Kelvin(row.Number("cct_K")));
    EXPECT_NEAR(c.X, row.Number("X"), 1e-11 * std::max(1.0, c.X));
    EXPECT_NEAR(c.Z, row.Number("Z"), 1e-11 * std::max(1.0, c.Z));
    const Uv1960 uv = UvFromCct(Kelvin(row.Number("cct_K")));
    EXPECT_NEAR(uv.u, row.Number("u"), 1e-12);
    EXPECT_NEAR(uv.v, row.Number("v"), 1e-12);
  }
}

TEST(Planckian, LocusAgreesWithTheSumOfPlancksLaw) {
  for (const double t : {800.0, 2856.0, 6504.0, 40000.0}) {
    const Xy sum = XyFromXyz(*XyzFromSpectrum(BlackBody(t, kC2MetreKelvin)));
    const Xy locus = XyFromCct(Kelvin(t));
    EXPECT_NEAR(sum.x, locus.x, 1e-13);
    EXPECT_NEAR(sum.y, locus.y, 1e-13);
  }
}

TEST(Planckian, AnotherC2IsAPureRescaleOfTemperature) {
  for (const double t : {2000.0, 2848.0, 6500.0}) {
    EXPECT_NEAR(CctOf(BlackBody(t, kC2OfIlluminantAMetreKelvin)).temperature.value(),
                t * kC2MetreKelvin / kC2OfIlluminantAMetreKelvin, 1e-6 * t * 1e-2);
  }
}

TEST(Planckian, DerivativesEqualCentralDifferences) {
  for (const double m : {0.2, 5.0, 153.8, 350.0, 1000.0, 2400.0}) {
    const double h = 1e-2;
    const LocusPoint a = PlanckianLocusAt(Mireds(m - h)), b = PlanckianLocusAt(Mireds(m)),
                     c = PlanckianLocusAt(Mireds(m + h));
    EXPECT_NEAR(b.du, (c.uv.u - a.uv.u) / (2 * h), 1e-11) << m;
    EXPECT_NEAR(b.dv, (c.uv.v - a.uv.v) / (2 * h), 1e-11) << m;
    EXPECT_NEAR(b.d2u, (c.du - a.du) / (2 * h), 1e-11) << m;
    EXPECT_NEAR(b.d2v, (c.dv - a.dv) / (2 * h), 1e-11) << m;
    EXPECT_GT(std::hypot(b.du, b.dv), 1e-6);
  }
}

// The least radius of curvature of the locus: 0.1001 at 5192 K, with its centre below the locus.
TEST(Planckian, TheSharpestBendIsAt5192Kelvin) {
  double least = 1.0, at_K = 0.0;
  for (double t = 3000; t < 9000; t += 4) {
    const LocusPoint p = PlanckianLocusAt(MiredsFromKelvin(Kelvin(t)));
    const double turn = p.du * p.d2v - p.dv * p.d2u;
    EXPECT_LT(turn, 0.0);
    const double radius = std::pow(std::hypot(p.du, p.dv), 3) / -turn;
    if (radius < least) least = radius, at_K = t;
  }
  EXPECT_NEAR(least, 0.1001, 5e-5);
  EXPECT_NEAR(at_K, 5192.0, 10.0);
}

TEST(Planckian, ColdBodiesStayFiniteDownToOneKelvin) {
  for (const double t : {1.0, 10.0, 56.0, 300.0}) {
    const Xyz c = PlanckianXyz(Kelvin(t));
    EXPECT_TRUE(std::isfinite(c.X) && std::isfinite(c.Z)) << t;
    EXPECT_GT(c.X / (c.X + c.Y + c.Z), 0.7) << t;  // the red end of the spectrum
  }
}

TEST(Planckian, RatioJoinsItsSeriesWithoutAStep) {
  EXPECT_DOUBLE_EQ(PlanckRatio(0.0), 1.0);
  EXPECT_NEAR(PlanckRatio(1e-5 * (1 - 1e-12)), PlanckRatio(1e-5), 1e-15);
  EXPECT_DOUBLE_EQ(PlanckRatio(1.0), 1.0 / (std::exp(1.0) - 1.0));
}

// colorimetry.md 4: what a spectrometer's range does to a black body read on the exact locus.
TEST(Planckian, ATruncatedSpectrumReadsAShiftedTemperature) {
  EXPECT_NEAR(CctOf(BlackBody(2856, kC2MetreKelvin, 400, 700)).temperature.value() - 2856, 9.2,
              0.1);
  const CctResult narrow = CctOf(BlackBody(6504, kC2MetreKelvin, 400, 700));
  EXPECT_NEAR(narrow.temperature.value() - 6504, -10.6, 0.1);
  EXPECT_NEAR(narrow.duv, 3e-4, 5e-5);
  EXPECT_NEAR(CctOf(BlackBody(6504, kC2MetreKelvin, 380, 780)).temperature.value() - 6504, -1.8,
              0.1);
}

// The same section: 5 nm costs +0.045 K at 6504 K, 10 nm -4.1 K.
TEST(Planckian, ACoarseStepReadsAShiftedTemperature) {
  EXPECT_NEAR(CctOf(BlackBody(6504, kC2MetreKelvin, 360, 830, 5)).temperature.value() - 6504, 0.045,
              0.005);
  EXPECT_NEAR(CctOf(BlackBody(6504, kC2MetreKelvin, 360, 830, 10)).temperature.value() - 6504, -4.1,
              0.1);
}

}  // namespace
}  // namespace lightcal
