// SPDX-License-Identifier: Apache-2.0
// The seed's errors about quantities and their values (its chapter 4, 5.1 and 5.2); rows.txt lists
// them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>
#include <type_traits>
#include <vector>

#include "lightcal/photometry/angular_table.h"
#include "lightcal/photometry/inverse_square.h"
#include "lightcal/photometry/lambert.h"
#include "lightcal/photometry/luminous_efficacy.h"
#include "lightcal/photometry/reference_values.h"
#include "lightcal/photometry/source_photometry.h"
#include "quadrature.h"

namespace lightcal {
namespace {

using std::numbers::pi;

// The one reference value whose description starts with these words.
const ReferenceValue& Reference(ReferenceQuantity quantity, std::string_view what) {
  const ReferenceValue* found = nullptr;
  for (const ReferenceValue& row : ReferenceValues()) {
    if (row.quantity == quantity && row.what.starts_with(what)) {
      EXPECT_EQ(found, nullptr) << what;
      found = &row;
    }
  }
  EXPECT_NE(found, nullptr) << what;
  static constexpr ReferenceValue kMissing{};
  return found == nullptr ? kMissing : *found;
}

TEST(SeedErrors, APhotometricFileHoldsIntensityByAngle) {
  // I(theta) = 100 cos(theta) below 90 degrees, every 5 degrees as a file would list it.
  std::vector<Radians> angles;
  std::vector<Candela> intensities;
  for (int degrees = 0; degrees <= 180; degrees += 5) {
    angles.push_back(RadiansFromDegrees(degrees));
    intensities.push_back(CandelaOfFlatSource(Candela(100.0), std::cos(angles.back().value())));
  }
  const auto interpolated = [&](double theta) {
    const auto i = static_cast<std::size_t>(theta / angles[1].value());
    const double part = theta / angles[1].value() - static_cast<double>(i);
    return (1.0 - part) * intensities[i].value() + part * intensities[i + 1].value();
  };
  const double ours = FluxOfAngularTable(angles, intensities)->value();
  EXPECT_NEAR(ours, test::IntegrateOverSphere(interpolated, 360000), 1e-6);
  EXPECT_NEAR(ours, 100.0 * pi, 0.3);
  // Read as a spectral distribution the same rows would be a plain sum over the abscissa.
  const double seed = test::Integrate(interpolated, 0.0, pi);
  EXPECT_GT(ours / seed, 3.0);
  static_assert(!std::is_constructible_v<Radians, Nanometres>);
}

TEST(SeedErrors, LampEfficacyMultipliesElectricalPower) {
  static_assert(
      std::is_invocable_v<decltype(LumensFromElectrical), ElectricalWatts, LumensPerWatt>);
  static_assert(!std::is_invocable_v<decltype(LumensFromElectrical), RadiantWatts, LumensPerWatt>);
  // A 9 W lamp of 100 lm/W that radiates 3 W: 900 lm, not 300.
  const double seed = 100.0 * 3.0;
  const double ours = LumensFromElectrical(ElectricalWatts(9.0), LumensPerWatt(100.0)).value();
  EXPECT_DOUBLE_EQ(ours, 900.0);
  EXPECT_NE(ours, seed);
  EXPECT_DOUBLE_EQ(ElectricalFromLumens(Lumens(900.0), LumensPerWatt(100.0)).value(), 9.0);
}

TEST(SeedErrors, PhotopicWeightAndLampEfficiencyAreTwoThings) {
  static_assert(!std::is_invocable_v<decltype(LumensFromRadiant), RadiantWatts, OverallEfficiency>);
  static_assert(!std::is_constructible_v<PhotopicWeight, OverallEfficiency>);
  constexpr double kV600 = 0.631;  // CIE 018:2019
  const double ours = LumensFromRadiant(RadiantWatts(1.0), PhotopicWeight(kV600)).value();
  EXPECT_NEAR(ours, 430.97, 0.01);
  const double seed = 683.0 * 1.0 * (100.0 * kV600);  // V in percent
  EXPECT_NEAR(seed / ours, 100.0, 0.01);
  const OverallEfficiency bulb = EfficiencyFromEfficacy(LumensPerWatt(10.0));
  EXPECT_NEAR(bulb.value(), 0.01464, 1e-5);
  EXPECT_DOUBLE_EQ(EfficacyFromEfficiency(bulb).value(), 10.0);
}

TEST(SeedErrors, AWattIs683LumensAt540TerahertzOnly) {
  EXPECT_DOUBLE_EQ(LumensFromRadiant(RadiantWatts(1.0), kPhotopicWeightAt540THz).value(), 683.0);
  constexpr double kV650 = 0.107;  // CIE 018:2019
  EXPECT_NEAR(LumensFromRadiant(RadiantWatts(1.0), PhotopicWeight(kV650)).value(), 73.1, 0.05);
  // A band as wide as the visible, of equal power per nanometre, under a bell-shaped V.
  const std::array<double, 3> nm = {455.0, 555.0, 655.0};
  const std::array<double, 3> watts_per_nm = {0.005, 0.005, 0.005};
  const auto tent = [](double at) { return 1.0 - std::abs(at - 555.0) / 100.0; };
  const SpectralFlux flux = FluxFromSpectralPower(nm, watts_per_nm, tent);
  EXPECT_DOUBLE_EQ(flux.radiant.value(), 1.0);
  EXPECT_NEAR(flux.luminous.value(), 683.002 / 2.0, 1e-9);
  EXPECT_LT(EfficacyOfRadiation(flux), kEfficacyAt540THz);
}

TEST(SeedErrors, ACandelaIsAWattPer683PerSteradian) {
  const WattsPerSteradian intensity = RadiantFromCandela(Candela(1.0), kPhotopicWeightAt540THz);
  EXPECT_NEAR(intensity.value(), 1.0 / 683.0, 1e-18);
  EXPECT_DOUBLE_EQ(CandelaFromRadiant(intensity, kPhotopicWeightAt540THz).value(), 1.0);
  static_assert(!std::is_constructible_v<RadiantWatts, WattsPerSteradian>);
  // In all directions that is 4 pi times the seed's 1/683 W.
  const double seed = 1.0 / 683.0;
  const double ours = test::IntegrateOverSphere([&](double) { return intensity.value(); });
  EXPECT_NEAR(ours / seed, 4.0 * pi, 1e-6);
}

TEST(SeedErrors, ASixtyWattBulbHasOneEfficacyThatItsFluxConfirms) {
  const ReferenceValue& flux = Reference(ReferenceQuantity::kFlux, "incandescent bulb 60 W");
  const ReferenceValue& efficacy =
      Reference(ReferenceQuantity::kEfficacy, "incandescent bulb 60 W");
  EXPECT_NEAR(efficacy.low * 60.0, flux.low, 0.02 * flux.low);
  EXPECT_NEAR(efficacy.high * 60.0, flux.high, 0.02 * flux.high);
  EXPECT_GT(efficacy.low, 10.0);   // the seed's chapter 4
  EXPECT_LT(efficacy.high, 35.0);  // the seed's table in 5.1.5
  EXPECT_EQ(efficacy.seed_value, 10.0);
  EXPECT_FALSE(efficacy.seed_note.empty());
}

TEST(SeedErrors, LuminanceIsASecondDerivativeOfFlux) {
  // Flux of a matt patch of 500 nits through a small cone at 60 degrees, from E = I/d^2 cos.
  const auto flux = [](double area, double omega) {
    return Lumens(500.0 * area * std::cos(pi / 3.0) * omega);
  };
  const auto luminance = [](Lumens phi, double area, double omega) {
    return LuminanceFromFluxElement(phi, SquareMetres(area), std::cos(pi / 3.0), Steradians(omega))
        .value();
  };
  for (const double shrink : {1.0, 0.5, 1e-3}) {
    const double area = 1e-4 * shrink;
    const double omega = 1e-3 * shrink;
    EXPECT_NEAR(luminance(flux(area, omega), area, omega), 500.0, 1e-9);
  }
  // First order, as printed: the patch's whole flux pi L dA over the cone does not settle.
  const Lumens whole = FluxOfFlatSource(AxialCandelaOfFlatSource(Nits(500.0), SquareMetres(1e-4)));
  EXPECT_GT(luminance(whole, 1e-4, 1e-3), 1e6);
  EXPECT_NEAR(luminance(whole, 1e-4, 1e-4) / luminance(whole, 1e-4, 1e-3), 10.0, 1e-9);
}

TEST(SeedErrors, AFullMoonStaysBelowAThirdOfALux) {
  const ReferenceValue& moon = Reference(ReferenceQuantity::kIlluminance, "full moon");
  EXPECT_NEAR(moon.low, 0.05, 1e-12);
  EXPECT_LE(moon.high, 0.32);
  EXPECT_EQ(moon.seed_value, 0.5);
  EXPECT_GT(*moon.seed_value, moon.high);
  EXPECT_FALSE(moon.seed_note.empty());
}

TEST(SeedErrors, SunAndMoonAreGivenAsIlluminanceNotFlux) {
  SourceGeometry sun;
  sun.kind = LightKind::kDirectional;
  const auto as_flux = ConvertSource(sun, SourceQuantity::kFlux, 1e5);
  ASSERT_FALSE(as_flux.has_value());
  EXPECT_NE(as_flux.error().message.find("illuminance"), std::string::npos);
  for (const double distance : {1.0, 1e6}) {
    sun.distance = Metres(distance);
    const auto all = ConvertSource(sun, SourceQuantity::kIlluminance, 1e5);
    ASSERT_TRUE(all.has_value());
    EXPECT_DOUBLE_EQ(all->illuminance->value(), 1e5);
    EXPECT_FALSE(all->flux.has_value());
  }
  for (const std::string_view what : {"sun outside", "full moon"}) {
    EXPECT_EQ(ReferenceUnit(Reference(ReferenceQuantity::kIlluminance, what).quantity), "lx");
  }
}

// A rounding slip of the seed, so outside of the set; the exact figures all the same.
TEST(SeedExample, SixtyWattsAtHalfAMetreKeepsItsDigits) {
  const Lumens flux = LumensFromElectrical(ElectricalWatts(60.0), LumensPerWatt(10.0));
  SourceGeometry bulb;
  bulb.distance = Metres(0.5);
  const auto all = ConvertSource(bulb, SourceQuantity::kFlux, flux.value());
  ASSERT_TRUE(all.has_value());
  const Lux e = *all->illuminance;
  EXPECT_NEAR(all->intensity->value(), 47.746, 5e-4);
  EXPECT_NEAR(e.value(), 190.986, 5e-4);
  EXPECT_NEAR(ExitanceOfLitSurface(e, 0.9).value(), 171.887, 5e-4);
  EXPECT_NEAR(LuminanceOfLitSurface(e, 0.9).value(), 54.713, 5e-4);
  EXPECT_GT(192.0 - e.value(), 1.0);  // the seed, rounded on the way
}

}  // namespace
}  // namespace lightcal
