// SPDX-License-Identifier: Apache-2.0
// Inverse square, cosine law, Lambert, watts and lumens, angular tables.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "lightcal/photometry/angular_table.h"
#include "lightcal/photometry/cosine_law.h"
#include "lightcal/photometry/inverse_square.h"
#include "lightcal/photometry/lambert.h"
#include "lightcal/photometry/luminous_efficacy.h"
#include "lightcal/photometry/reference_values.h"
#include "quadrature.h"

namespace lightcal {
namespace {

using std::numbers::pi;

TEST(InverseSquare, IlluminanceQuartersWhenDistanceDoubles) {
  EXPECT_DOUBLE_EQ(LuxFromCandela(Candela(48.0), Metres(0.5)).value(), 192.0);
  EXPECT_DOUBLE_EQ(LuxFromCandela(Candela(48.0), Metres(1.0)).value(), 48.0);
}

TEST(InverseSquare, IntensityComesBackFromATiltedOffsetReading) {
  const ReceiverPose at{Metres(0.8), Metres(-0.03), 0.6};
  const Lux e = LuxFromCandela(Candela(120.0), at);
  EXPECT_NEAR(e.value(), 120.0 * 0.6 / (0.77 * 0.77), 1e-12);
  EXPECT_NEAR(CandelaFromLux(e, at).value(), 120.0, 1e-12);
}

TEST(InverseSquare, FluxThroughAPlaneBelowALampIsHalfOfItsFlux) {
  // E over an endless floor 2 m below an isotropic lamp: 2 pi I, half of 4 pi I.
  const double brute = test::Integrate(
      [](double angle) {  // floor radius = 2 tan(angle)
        const double radius = 2.0 * std::tan(angle);
        const double d = 2.0 / std::cos(angle);
        const ReceiverPose at{Metres(d), Metres(0.0), std::cos(angle)};
        const double ring = 2.0 * pi * radius * 2.0 / (std::cos(angle) * std::cos(angle));
        return LuxFromCandela(Candela(10.0), at).value() * ring;
      },
      0.0, pi / 2.0);
  EXPECT_NEAR(brute, 20.0 * pi, 1e-6);
}

TEST(CosineLaw, LightFromBehindAddsNothing) {
  EXPECT_DOUBLE_EQ(LuxOnTiltedPlane(Lux(100.0), 0.5).value(), 50.0);
  EXPECT_EQ(LuxOnTiltedPlane(Lux(100.0), -0.5).value(), 0.0);
  EXPECT_EQ(LuxOnTiltedPlane(Lux(100.0), 0.0).value(), 0.0);
}

TEST(Lambert, FluxOfAFlatSourceIsTheIntegralOfItsCosineLobe) {
  const Candela axial = AxialCandelaOfFlatSource(Nits(1500.0), SquareMetres(0.72));
  EXPECT_DOUBLE_EQ(axial.value(), 1080.0);
  const double brute = test::IntegrateOverSphere(
      [&](double theta) { return CandelaOfFlatSource(axial, std::cos(theta)).value(); });
  EXPECT_NEAR(FluxOfFlatSource(axial).value(), brute, 1e-4);
  EXPECT_NEAR(FluxOfFlatSource(axial).value(), ExitanceFromLuminance(Nits(1500.0)).value() * 0.72,
              1e-9);
  EXPECT_DOUBLE_EQ(AxialCandelaOfFlatSource(FluxOfFlatSource(axial)).value(), 1080.0);
}

TEST(Lambert, AUniformDomeGivesPiTimesItsLuminance) {
  const double brute = test::Integrate(
      [](double theta) { return 2.0 * pi * 100.0 * std::cos(theta) * std::sin(theta); }, 0.0,
      pi / 2.0);
  EXPECT_NEAR(LuxUnderUniformDome(Nits(100.0)).value(), brute, 1e-5);
}

TEST(Lambert, AWhiteSurfaceReturnsWhatFallsOnIt) {
  EXPECT_DOUBLE_EQ(ExitanceOfLitSurface(Lux(318.0), 1.0).value(), 318.0);
  EXPECT_NEAR(LuminanceOfLitSurface(Lux(pi), 1.0).value(), 1.0, 1e-15);
  EXPECT_NEAR(ExitanceFromLuminance(Nits(54.7)).value(), 54.7 * pi, 1e-13);
}

// V(lambda) by the fit of Wyman, Sloan & Shirley, JCGT 2(2) (2013), within about 1 %.
double FittedV(double nm) {
  const auto lobe = [nm](double height, double centre, double left, double right) {
    const double t = (nm - centre) * (nm < centre ? left : right);
    return height * std::exp(-0.5 * t * t);
  };
  return lobe(0.821, 568.8, 0.0213, 0.0247) + lobe(0.286, 530.9, 0.0613, 0.0322);
}

SpectralFlux BlackBody(double kelvin) {
  std::vector<double> nm;
  std::vector<double> watts;
  for (double at = 50.0; at <= 50000.0; at += at < 1000.0 ? 1.0 : 10.0) {
    const double metres = at * 1e-9;
    nm.push_back(at);
    watts.push_back(3.741771852e-16 / std::pow(metres, 5) /
                    std::expm1(1.438776877e-2 / (metres * kelvin)) * 1e-9);
  }
  return FluxFromSpectralPower(nm, watts, FittedV);
}

TEST(LuminousEfficacy, ABlackBodyRadiatesWhatStefanAndBoltzmannSay) {
  const SpectralFlux flux = BlackBody(2856.0);
  EXPECT_NEAR(flux.radiant.value() / (5.670374419e-8 * std::pow(2856.0, 4)), 1.0, 5e-4);
}

TEST(LuminousEfficacy, BlackBodiesAgreeWithTheReferenceTable) {
  int checked = 0;
  for (const ReferenceValue& row : ReferenceValues()) {
    for (const double kelvin : {2856.0, 3200.0, 5772.0}) {
      const std::string start = "black body " + std::to_string(static_cast<int>(kelvin)) + " K";
      if (!row.what.starts_with(start)) continue;
      ++checked;
      EXPECT_NEAR(EfficacyOfRadiation(BlackBody(kelvin)).value(), row.low, 0.015 * row.low)
          << start;
    }
  }
  EXPECT_EQ(checked, 3);
}

TEST(LuminousEfficacy, TheMaximumIsReachedByTheGreenestLightOnly) {
  EXPECT_DOUBLE_EQ(LumensFromRadiant(RadiantWatts(1.0), PhotopicWeight(1.0)).value(), 683.002);
  EXPECT_NEAR(kMaximumEfficacy.value() * kPhotopicWeightAt540THz.value(), 683.0, 1e-12);
}

TEST(AngularTable, AConstantTableGivesFourPiAtAnyStep) {
  for (const int steps : {1, 2, 7, 180, 3600}) {
    std::vector<Radians> angles;
    for (int i = 0; i <= steps; ++i) angles.emplace_back(pi * i / steps);
    const std::vector<Candela> intensities(angles.size(), Candela(100.0));
    EXPECT_NEAR(FluxOfAngularTable(angles, intensities)->value(), 400.0 * pi, 1e-10) << steps;
  }
}

TEST(AngularTable, ALinearRampAgreesWithItsClosedForm) {
  // int_0^pi theta sin(theta) dtheta = pi, so a ramp 0..180 cd over 0..pi gives 2 pi 180.
  const std::array<Radians, 2> angles = {Radians(0.0), Radians(pi)};
  const std::array<Candela, 2> ramp = {Candela(0.0), Candela(180.0)};
  EXPECT_NEAR(FluxOfAngularTable(angles, ramp)->value(), 360.0 * pi, 1e-10);
  // The series for small steps and the closed form for large ones meet.
  std::vector<Radians> fine;
  std::vector<Candela> same;
  for (int i = 0; i <= 100; ++i) {
    fine.emplace_back(pi * i / 100);
    same.emplace_back(1.8 * i);
  }
  EXPECT_NEAR(FluxOfAngularTable(fine, same)->value(), 360.0 * pi, 1e-9);
}

TEST(AngularTable, BadTablesAreRefused) {
  const auto refused = [](std::vector<Radians> angles, std::vector<Candela> intensities) {
    const auto flux = FluxOfAngularTable(angles, intensities);
    return !flux && flux.error().kind == ErrorKind::kRefused && flux.error().code == "bad_table";
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(refused({}, {}));
  EXPECT_TRUE(refused({Radians(0)}, {Candela(1)}));
  EXPECT_TRUE(refused({Radians(0), Radians(1)}, {Candela(1)}));
  EXPECT_TRUE(refused({Radians(1), Radians(1)}, {Candela(1), Candela(1)}));
  EXPECT_TRUE(refused({Radians(0), Radians(4)}, {Candela(1), Candela(1)}));
  EXPECT_TRUE(refused({Radians(0), Radians(nan)}, {Candela(1), Candela(1)}));
  EXPECT_TRUE(refused({Radians(0), Radians(1)}, {Candela(1), Candela(-1)}));
  EXPECT_TRUE(refused({Radians(0), Radians(1)}, {Candela(1), Candela(nan)}));
}

TEST(ReferenceValues, EveryRowHasASourceAndAnOrderedRange) {
  const auto rows = ReferenceValues();
  EXPECT_GE(rows.size(), 40U);
  int flagged = 0;
  for (const ReferenceValue& row : rows) {
    EXPECT_FALSE(row.source.empty()) << row.what;
    EXPECT_GT(row.low, 0.0) << row.what;
    EXPECT_LE(row.low, row.high) << row.what;
    EXPECT_EQ(row.basis == ReferenceBasis::kRuleOfThumb, row.source.starts_with("engineering rule"))
        << row.what;
    if (!row.seed_value) continue;
    ++flagged;
    EXPECT_TRUE(*row.seed_value < row.low || *row.seed_value > row.high) << row.what;
    EXPECT_FALSE(row.seed_note.empty()) << row.what;
  }
  EXPECT_GE(flagged, 4);
}

}  // namespace
}  // namespace lightcal
