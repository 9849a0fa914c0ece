// SPDX-License-Identifier: Apache-2.0
// Rows G01 to G04 and G16 to G22: places that tell nothing, cones and ranges at their ends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <vector>

#include "hard_case.h"
#include "lightcal/photometry/falloff_windows.h"
#include "lightcal/photometry/solid_angle.h"
#include "lightcal/photometry/spot_cone.h"

namespace lightcal::test::hard {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

using std::numbers::pi;
using Place = std::array<double, 3>;
const std::vector<Place> kSquare = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};

// What 100 cd at `lamp` give a meter that lies flat.
double FlatLux(const Place& lamp, const Place& meter) {
  const double x = lamp[0] - meter[0], y = lamp[1] - meter[1], z = lamp[2] - meter[2];
  const double r = std::hypot(x, y, z);
  return 100.0 * z / (r * r * r);
}

Answer Locate(const Place& lamp, const std::vector<Place>& meters) {
  KeySession session("point", kDark);
  for (const Place& meter : meters) {
    session.Flat(meter, FlatLux(lamp, meter), "sigma_relative = 0.01");
  }
  return session.Run();
}

TEST(HardCaseG, G01ASquaresCornersAreRefusedAndTheCentreNamed) {
  const Answer answer = Locate({0.2, 0.1, 1.5}, kSquare);
  ExpectRefused(answer, "cocircular");
  EXPECT_THAT(answer.document["error"]["message"].get<std::string>(),
              HasSubstr("position_m = [0, 0, 0]"));
  std::vector<Place> with_centre = kSquare;
  with_centre.push_back({0, 0, 0});
  const Answer found = Locate({0.2, 0.1, 1.5}, with_centre);
  ExpectAnswered(found);
  EXPECT_NEAR(Lamp(found)["position_m"][2].get<double>(), 1.5, 1e-3);
}

TEST(HardCaseG, G02MetersOnALineAreRefused) {
  ExpectRefused(Locate({0.2, 0.1, 1.5}, {{-2, 0, 0}, {-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}}),
                "cocircular");
}

TEST(HardCaseG, G03ReadingsThatNoHeightExplainsAreRefused) {
  // Two corners a hundred times brighter than the others: h^2 of the closed form is negative.
  const std::vector<double> lux = {1, 400, 3, 500, 2};
  std::vector<Place> meters = kSquare;
  meters.push_back({0, 0, 0});
  KeySession session;
  for (std::size_t i = 0; i < meters.size(); ++i) {
    session.Flat(meters[i], lux[i], "sigma_relative = 0.01");
  }
  ExpectRefused(session.Run(), "model_misfit");
}

TEST(HardCaseG, G04AMeterAtTheLampsOwnPlaceIsRejected) {
  const Answer answer = KeySession("point", "position_m = [0, 0, 1]\n" + std::string(kDarkBulb))
                            .Flat({0, 0, 1}, 1e5)
                            .Flat({0, 0, 0}, 100)
                            .Run();
  ExpectWarned(answer, "row_rejected");
  EXPECT_THAT(Rejected(answer), ElementsAre(0));
  EXPECT_NEAR(Value(answer, "intensity_cd"), 100.0, 1e-9);
}

TEST(HardCaseG, G16SolidAnglesHoldFromNothingToTheSphere) {
  for (const double t : {0.0, 1e-8, 0.5 * pi, pi}) {
    const double s = std::sin(0.5 * t);
    EXPECT_NEAR(SolidAngleOfCone(Radians(t)).value(), 4.0 * pi * s * s, 1e-15 * (4.0 * pi * s * s))
        << t;
  }
  EXPECT_NEAR(SolidAngleOfCone(Radians(1e-8)).value() / 3.14159265e-16, 1.0, 1e-8);
  const auto flux = [](const char* outer) {
    return Ask({"convert", "100cd", "--kind", "spot", "--spot-falloff", "hard", "--outer", outer});
  };
  EXPECT_NEAR(flux("180").document["flux_lm"].get<double>(), 400.0 * pi, 1e-9);
  EXPECT_NEAR(flux("90").document["flux_lm"].get<double>(), 200.0 * pi, 1e-9);
  const double narrow = 1e-8 * pi / 180.0;
  EXPECT_NEAR(flux("1e-8").document["flux_lm"].get<double>() / (100.0 * pi * narrow * narrow), 1.0,
              1e-9);
  ExpectRefused(flux("0"), "bad_cone");
  ExpectRefused(flux("181"), "bad_cone");
}

TEST(HardCaseG, G17AnInnerAngleBeyondTheOuterBecomesIt) {
  const Answer answer = KeySession("spot", "inner_deg = 40\nouter_deg = 35").At(2, 400).Run();
  ExpectWarned(answer, "cone_order");
  EXPECT_EQ(Lamp(answer)["cone"]["inner_deg"], Lamp(answer)["cone"]["outer_deg"]);
  ExpectWarned(Ask({"convert", "100cd", "--kind", "spot", "--inner", "40", "--outer", "35"}),
               "inner_beyond_outer");
}

TEST(HardCaseG, G18EqualAnglesAreAHardCone) {
  const Answer answer =
      KeySession("spot", "inner_deg = 35\nouter_deg = 35\n" + std::string(kDarkBulb))
          .At(2, 400)
          .Run();
  ExpectAnswered(answer);
  EXPECT_NEAR(Value(answer, "flux_lm"), 1600.0 * SolidAngleOfCone(RadiansFromDegrees(35.0)).value(),
              1e-6);
  const SpotCone cone{RadiansFromDegrees(35.0), RadiansFromDegrees(35.0)};
  for (const SpotFalloff falloff : {SpotFalloff::kHard, SpotFalloff::kLinear,
                                    SpotFalloff::kSquaredLinear, SpotFalloff::kSmoothstep}) {
    EXPECT_EQ(SpotAttenuation(RadiansFromDegrees(34.9), cone, falloff), 1.0);
    EXPECT_EQ(SpotAttenuation(RadiansFromDegrees(35.1), cone, falloff), 0.0);
    const double rim = SpotAttenuation(RadiansFromDegrees(35.0), cone, falloff);
    EXPECT_TRUE(rim >= 0.0 && rim <= 1.0);
  }
}

TEST(HardCaseG, G19FullAnglesAreHalvedOnceAndExactly) {
  const Answer full =
      KeySession("spot", "inner_deg = 40\nouter_deg = 71.3").At(2, 400).Run({"--full-angles"});
  const Answer half = KeySession("spot", "inner_deg = 20\nouter_deg = 35.65").At(2, 400).Run();
  EXPECT_EQ(Lamp(full), Lamp(half));
  for (const double degrees : {0.0, 1e-9, 35.65, 180.0}) {
    const Radians angle = RadiansFromDegrees(degrees);
    EXPECT_EQ(HalfAngleFromFull(FullAngleFromHalf(angle)).value(), angle.value());
  }
}

using Falloff = double (*)(Metres, Metres);
const std::vector<Falloff> kFalloffs = {[](Metres d, Metres r) { return FilamentFalloff(d, r); },
                                        [](Metres d, Metres r) { return UnityHdrpFalloff(d, r); },
                                        [](Metres d, Metres r) { return ThreeJsFalloff(d, r); },
                                        [](Metres d, Metres r) { return GodotFalloff(d, r); },
                                        [](Metres d, Metres r) { return UnrealFalloff(d, r); },
                                        [](Metres d, Metres r) { return GltfFalloff(d, r); }};

TEST(HardCaseG, G20AtTheEndOfItsRangeALightIsDarkAndSmooth) {
  for (const Falloff& falloff : kFalloffs) {
    EXPECT_EQ(falloff(Metres(7.0), Metres(7.0)), 0.0);
    EXPECT_EQ(falloff(Metres(7.0 + 1e-9), Metres(7.0)), 0.0);
    double before = falloff(Metres(6.0), Metres(7.0));
    for (int i = 1; i <= 1000; ++i) {
      const double e = falloff(Metres(6.0 + 1e-3 * i), Metres(7.0));
      ASSERT_GE(e, 0.0);
      ASSERT_LE(e, before);
      before = e;
    }
  }
  // Squared windows end with derivative 0; glTF's plain one does not, by its specification.
  for (std::size_t i = 0; i + 1 < kFalloffs.size(); ++i) {
    EXPECT_NEAR(kFalloffs[i](Metres(7.0 - 1e-6), Metres(7.0)) / 1e-6, 0.0, 1e-6);
  }
}

TEST(HardCaseG, G21OneRoundingBeforeTheEndItIsStillFinite) {
  const Metres r(7.0);
  for (const double d : {7.0 * (1.0 - 1e-16), std::nextafter(7.0, 0.0), std::nextafter(7.0, 8.0)}) {
    for (const Falloff& falloff : kFalloffs) {
      const double e = falloff(Metres(d), r);
      EXPECT_GE(e, 0.0);
      EXPECT_LT(e, 1e-15);
    }
  }
}

TEST(HardCaseG, G22ARangeOfNothingOrInfinityMeansNone) {
  for (const double r : {0.0, -3.0, HUGE_VAL}) {
    for (const Falloff& falloff : kFalloffs) {
      EXPECT_NEAR(falloff(Metres(2.0), Metres(r)), 0.25, 1e-5) << r;
      EXPECT_TRUE(std::isfinite(falloff(Metres(0.0), Metres(r))));
    }
  }
  KeySession session;
  ExpectAnswered(session.At(0.5, 400).At(1, 100).Run());
  for (const char* range : {"--range=0m", "--range=-3m", "--range=inf", "--range=nan"}) {
    const TempDir presets;
    const Answer answer =
        Ask({"export", session.path() + "/out/light.json", range, "-o", presets.path()});
    EXPECT_NE(answer.exit_code, 0) << range;
    EXPECT_TRUE(std::filesystem::is_empty(presets.path())) << range;
  }
}

}  // namespace
}  // namespace lightcal::test::hard
