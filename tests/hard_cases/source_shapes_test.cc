// SPDX-License-Identifier: Apache-2.0
// Rows G05 to G15: models of lamps with a size, touched, far away, cut by the horizon.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "hard_case.h"
#include "lightcal/light/models/source_model.h"

namespace lightcal::test::hard {
namespace {

using std::numbers::pi;
const std::vector<SourceModel> kSized = {SphereSource{0.5}, DiskSource{0.5}, RectSource{0.5, 0.3},
                                         TubeSource{0.8, 0.1}};

// Before a source at height d over its middle, turned by `tilt` toward x.
Receiver<double> Before(double d, double tilt = 0.0, double aside = 0.0) {
  return {{aside, 0.0, d}, {std::sin(tilt), 0.0, -std::cos(tilt)}};
}

// Lux of 1000 cd/m^2.
double Converted(const Words& lamp) {
  Words words = {"convert", "1000nits", "--kind"};
  words.insert(words.end(), lamp.begin(), lamp.end());
  const Answer answer = Ask(words);
  ExpectAnswered(answer);
  return answer.document.value("illuminance_lx", -1.0);
}

TEST(HardCaseG, G05InItsOwnPlaneAFlatSourceIsDark) {
  for (const SourceModel& source :
       {SourceModel(DiskSource{0.5}), SourceModel(RectSource{0.5, 0.3})}) {
    for (const double aside : {0.0, 0.4, 2.0, 100.0}) {
      const Receiver<double> at{{aside, 0.0, 0.0}, {-1.0, 0.0, 0.0}};
      EXPECT_EQ(LuxPerCandela(source, at), 0.0) << aside;
    }
  }
  // Beside a lamp that shines down, at its height.
  const Answer answer =
      KeySession("disk", "diameter_m = 1\nposition_m = [0, 0, 1]\naim = [0, 0, -1]")
          .Flat({0, 0, 0}, 100)
          .Flat({2, 0, 1}, 5)
          .Run();
  ExpectWarned(answer, "row_rejected");
}

TEST(HardCaseG, G06TheHorizonCutsWithoutAStep) {
  for (const SourceModel& source : kSized) {
    for (const double d : {0.7, 2.0, 30.0}) {
      const double whole = LuxPerCandela(source, Before(d));
      double before = whole;
      for (int i = 1; i <= 500; ++i) {
        const double e = LuxPerCandela(source, Before(d, pi * i / 500.0));
        ASSERT_GE(e, 0.0);
        ASSERT_LE(before - e, 2.0 * whole * pi / 500.0);
        before = e;
      }
      EXPECT_EQ(before, 0.0);
    }
  }
  // Across |cr| = sin sigma of a globe: sigma = asin(R/d).
  for (const double d : {0.6, 2.0, 30.0}) {
    const double whole = LuxPerCandela(SphereSource{0.5}, Before(d));
    for (const double touch : {std::acos(0.5 / d), pi - std::acos(0.5 / d)}) {
      const double step = LuxPerCandela(SphereSource{0.5}, Before(d, touch + 1e-14)) -
                          LuxPerCandela(SphereSource{0.5}, Before(d, touch - 1e-14));
      EXPECT_LE(std::abs(step), 1e-12 * whole) << d;
    }
  }
}

TEST(HardCaseG, G07InAndOnAGlobeItIsPiTimesItsLuminance) {
  const double area = pi * 0.25;
  for (const double d : {0.5, 0.3, 0.0}) {
    EXPECT_NEAR(LuxPerCandela(SphereSource{0.5}, Before(d, 0.4)) * area, pi, 1e-12) << d;
  }
  EXPECT_NEAR(Converted({"sphere", "--radius", "0.5m", "--distance", "0.5000000001m"}), 1000.0 * pi,
              1e-3);
  for (const char* distance : {"0.5m", "0.3m"}) {
    ExpectRefused(Ask({"convert", "1000nits", "--kind", "sphere", "--radius", "0.5m", "--distance",
                       distance}),
                  "inside_source");
  }
}

// Lux per candela of a line of light by its pieces: cos cos/r^2 over its length.
double LineByPieces(double length, const Receiver<double>& at) {
  constexpr int kPieces = 20000;
  double sum = 0.0;
  for (int i = 0; i < kPieces; ++i) {
    const double x = length * ((i + 0.5) / kPieces - 0.5);
    const Vec3 to = {x - at.position[0], -at.position[1], -at.position[2]};
    const double d2 = Dot(to, to);
    sum += std::max(0.0, Dot(to, at.normal)) * at.position[2] / (d2 * d2);
  }
  return sum / kPieces;
}

TEST(HardCaseG, G08ARectWithoutWidthIsALine) {
  for (const double d : {0.05, 0.4, 2.0, 300.0}) {
    for (const double tilt : {0.0, 0.3, 1.5}) {
      const Receiver<double> at = Before(d, tilt, 0.1);
      const double truth = LineByPieces(0.6, at);
      EXPECT_NEAR(LuxPerCandela(RectSource{0.3, 0.0}, at) / truth, 1.0, 1e-6) << d << " " << tilt;
      EXPECT_NEAR(LuxPerCandela(RectSource{0.3, 1e-7}, at) / truth, 1.0, 1e-6) << d << " " << tilt;
    }
    const Receiver<double> along_y{{0.0, 0.1, d}, {0.0, 0.0, -1.0}};
    EXPECT_NEAR(LuxPerCandela(RectSource{0.0, 0.3}, along_y) /
                    LineByPieces(0.6, {{0.1, 0.0, d}, {0.0, 0.0, -1.0}}),
                1.0, 1e-6);
  }
  const Receiver<double> at = Before(2.0, 0.3);
  EXPECT_DOUBLE_EQ(LuxPerCandela(RectSource{0.0, 0.0}, at), std::cos(0.3) / 4.0);
}

TEST(HardCaseG, G08ALineGivesLuxOfItsCandelaAndNothingOfALuminance) {
  for (const char* size : {"0x60cm", "60x0cm"}) {
    const Answer answer =
        Ask({"convert", "500cd", "--kind", "rect", "--size", size, "--distance", "40cm"});
    ExpectAnswered(answer);
    EXPECT_NEAR(answer.document.value("illuminance_lx", -1.0),
                500.0 * LineByPieces(0.6, Before(0.4)), 1e-3);
    EXPECT_FALSE(answer.document.contains("luminance_nits"));
    ExpectRefused(Ask({"convert", "1000nits", "--kind", "rect", "--size", size}), "not_positive");
  }
  ExpectRefused(Ask({"convert", "500cd", "--kind", "rect", "--size", "0x0m"}), "not_positive");
}

TEST(HardCaseG, G08ASessionMayHoldALine) {
  for (const char* size : {"[0, 0.6]", "[0.6, 0]"}) {
    KeySession session("rect", "size_m = " + std::string(size) + "\n" + kDark);
    for (const double d : {0.3, 0.6, 1.2}) session.At(d, 100.0 * LineByPieces(0.6, Before(d)));
    const Answer answer = session.Run();
    ExpectWarned(answer, "substituted");  // no engine has a lamp without area
    EXPECT_NEAR(Value(answer, "intensity_cd"), 100.0, 0.05);
    EXPECT_NEAR(Value(answer, "flux_lm"), 100.0 * pi, 0.16);
    EXPECT_FALSE(Lamp(answer).contains("luminance_nits"));
    const Answer lit = Ask({"simulate", session.path() + "/out/light.json", "--position",
                            "key=0,0,0", "--at", "0,0,-0.3", "--effects", "all"});
    ExpectAnswered(lit);
    EXPECT_NEAR(lit.document["points"][0]["illuminance_lx"]["value"].get<double>(),
                Value(answer, "intensity_cd") * LineByPieces(0.6, Before(0.3)), 0.5);
  }
  ExpectRefused(KeySession("rect", "size_m = [0, 0]").At(2, 400).Run(), "bad_session");
}

TEST(HardCaseG, G09TouchedEveryFlatSourceIsAWallOfLight) {
  EXPECT_NEAR(Converted({"rect", "--size", "1x1m", "--distance", "1e-6m"}), 1000.0 * pi, 2e-2);
  EXPECT_NEAR(Converted({"disk", "--radius", "0.5m", "--distance", "1e-6m"}), 1000.0 * pi, 1e-2);
  EXPECT_NEAR(LuxPerCandela(RectSource{0.5, 0.5}, Before(1e-6)), pi, 1e-5);
}

TEST(HardCaseG, G10FarAwayEverySourceIsAPoint) {
  for (const SourceModel& source : {SourceModel(DiskSource{0.5}), SourceModel(RectSource{0.5, 0.5}),
                                    SourceModel(SphereSource{0.5})}) {
    double last = 0.0;
    for (double d = 1.0; d < 2e6; d *= 1.5) {
      const double share = LuxPerCandela(source, Before(d)) * d * d;
      ASSERT_GE(share, last * (1.0 - 1e-13)) << d;  // grows towards 1
      last = share;
    }
    EXPECT_NEAR(last, 1.0, 1e-12);
  }
  EXPECT_NEAR(Converted({"rect", "--size", "1x1m", "--distance", "1e6m"}) * 1e9, 1.0, 1e-11);
}

TEST(HardCaseG, G11NoCrossedPolygonComesIn) {
  // Corners are two coordinates each, so none leaves the plane; a bow tie encloses nothing.
  const std::vector<std::array<double, 2>> bow = {{0, 0}, {1, 1}, {1, 0}, {0, 1}};
  EXPECT_EQ(PolygonLuxPerCandela<double>(bow, Before(1.0)), 0.0);
  EXPECT_EQ(PolygonLuxPerCandela<double>(std::span(bow).first(2), Before(1.0)), 0.0);
  // The one polygon a person can write is a rect, and its sides must be above 0.
  for (const char* size : {"size_m = [1, -1]", "size_m = [-1, 1]"}) {
    ExpectRefused(KeySession("rect", size).At(2, 400).Run(), "bad_session");
  }
}

TEST(HardCaseG, G12TheWindingDoesNotMatter) {
  const std::vector<std::array<double, 2>> one = {{0, 0}, {1, 0}, {1, 2}, {-1, 1}};
  const std::vector<std::array<double, 2>> other(one.rbegin(), one.rend());
  for (const double d : {0.01, 0.7, 50.0}) {
    const Receiver<double> at{{0.3, -0.2, d}, {0.6, 0.0, -0.8}};
    EXPECT_NEAR(PolygonLuxPerCandela<double>(one, at) / PolygonLuxPerCandela<double>(other, at),
                1.0, 1e-13);
  }
}

TEST(HardCaseG, G13ADiskOnItsAxisAndBesideItAgree) {
  for (const double d : {0.01, 0.5, 3.0}) {
    for (const double tilt : {0.0, 0.2, 1.4}) {
      const double on = LuxPerCandela(DiskSource{0.5}, Before(d, tilt));
      Receiver<double> beside = Before(d, tilt);
      beside.position[1] = 1e-12;  // square to the tilt, so that nothing else changes
      EXPECT_NEAR(LuxPerCandela(DiskSource{0.5}, beside) / on, 1.0, 1e-12) << d;
    }
  }
}

TEST(HardCaseG, G14ADiskIsSmoothWhereQIsZero) {
  // a^2 + h^2 = R^2: the closed form changes its shape there.
  for (const double angle : {0.1, 0.8, 1.5}) {
    const auto at = [&](double r) { return Before(r * std::sin(angle), 0.0, r * std::cos(angle)); };
    const double inside = LuxPerCandela(DiskSource{0.5}, at(0.5 * (1.0 - 1e-13)));
    const double on = LuxPerCandela(DiskSource{0.5}, at(0.5));
    const double outside = LuxPerCandela(DiskSource{0.5}, at(0.5 * (1.0 + 1e-13)));
    EXPECT_NEAR(inside / on, 1.0, 1e-11) << angle;
    EXPECT_NEAR(outside / on, 1.0, 1e-11) << angle;
  }
}

TEST(HardCaseG, G15ATubeSeenEndOnIsDark) {
  for (const double r : {0.0, 0.02}) {
    for (const double aside : {0.0, 0.5 * r}) {
      const Receiver<double> end_on{{3.0, aside, 0.0}, {-1.0, 0.0, 0.0}};
      EXPECT_EQ(LuxPerCandela(TubeSource{1.0, r}, end_on), 0.0);
    }
  }
  // Out of its end's shadow light comes, without a step from nothing to much.
  const Receiver<double> just_out{{3.0, 0.0201, 0.0}, {-1.0, 0.0, 0.0}};
  const double e = LuxPerCandela(TubeSource{1.0, 0.02}, just_out);
  EXPECT_GE(e, 0.0);
  EXPECT_LT(e, 1e-3);
}

}  // namespace
}  // namespace lightcal::test::hard
