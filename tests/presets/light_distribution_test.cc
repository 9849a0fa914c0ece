// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/light_distribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lightcal/presets/exporters.h"
#include "lightcal/records/photometric_codec.h"
#include "quadrature.h"
#include "sample_lights.h"

namespace lightcal::test {
namespace {

constexpr double kPi = std::numbers::pi;

double Rad(double degrees) { return degrees * kPi / 180.0; }

IntensityTable TableOf(const FittedLight& lamp) {
  auto table = DistributionOf(lamp);
  EXPECT_TRUE(table && *table);
  return **std::move(table);
}

FittedLight SpotOf(double inner, double outer) {
  FittedLight spot = SimpleLight("spot", LightKind::kSpot, 1000.0);
  spot.inner_deg = inner;
  spot.outer_deg = outer;
  return spot;
}

TEST(LightDistribution, FluxOfEachKindIsItsClosedForm) {
  const auto flux = [](LightKind kind) {
    return TableOf(SimpleLight("x", kind, 1000.0)).Flux().value() / 1000.0;
  };
  EXPECT_NEAR(flux(LightKind::kPoint), 4.0 * kPi, 1e-9);
  EXPECT_NEAR(flux(LightKind::kSphere), 4.0 * kPi, 1e-9);
  EXPECT_NEAR(flux(LightKind::kDisk) / kPi, 1.0, 2e-4);
  EXPECT_NEAR(flux(LightKind::kRect) / kPi, 1.0, 2e-4);
  EXPECT_NEAR(flux(LightKind::kTube) / (kPi * kPi), 1.0, 2e-3);
}

TEST(LightDistribution, SpotFollowsTheSquaredLinearProfile) {
  for (const auto& [inner, outer] : {std::pair{15.0, 25.0}, {0.0, 40.0}, {20.0, 90.0}}) {
    const IntensityTable table = TableOf(SpotOf(inner, outer));
    const double ci = std::cos(Rad(inner));
    const double co = std::cos(Rad(outer));
    const auto law = [&](double theta) {
      const double t = std::clamp((std::cos(theta) - co) / (ci - co), 0.0, 1.0);
      return 1000.0 * t * t;
    };
    for (double deg = 0.0; deg <= 180.0; deg += 0.37) {
      EXPECT_NEAR(table.At(Radians(0), Radians(Rad(deg))).value(), law(Rad(deg)), 2.0) << deg;
    }
    EXPECT_NEAR(table.Flux().value() / IntegrateOverSphere(law), 1.0, 1e-3);
  }
}

// A Lambertian mantle of length l far away: the sum of cos over the elements that face a direction.
TEST(LightDistribution, TubesAreDarkTowardsTheirEndsWhereTheFitHasThem) {
  FittedLight tube = SimpleLight("tube", LightKind::kTube, 100.0);
  tube.aim = Vec3{0.0, 0.6, -0.8};
  const auto preset = ExportIes(FileOf({tube}), "set", {});
  ASSERT_TRUE(preset);
  const auto read = IesFromText(preset->files.at(0).contents, "x");
  ASSERT_TRUE(read);
  // Seen from behind along its aim C0 is to the right, C90 as high up as may be; the fit's tubes
  // lie along the right.
  const Vec3 length = {1.0, 0.0, 0.0}, high = {0.0, 0.8, 0.6};
  const auto mantle = [&](const Vec3& towards) {
    constexpr int kElements = 720;
    double sum = 0.0;
    for (int i = 0; i < kElements; ++i) {
      const double turn = 2.0 * kPi * (i + 0.5) / kElements;
      const Vec3 normal = high * std::sin(turn) + *tube.aim * std::cos(turn);
      sum += std::max(0.0, Dot(normal, towards)) / kElements;
    }
    return sum * kPi;  // 1 broadside
  };
  for (double gamma = 7.0; gamma < 180.0; gamma += 24.0) {
    for (double c = 3.0; c < 360.0; c += 31.0) {
      const Vec3 towards = length * (std::sin(Rad(gamma)) * std::cos(Rad(c))) +
                           high * (std::sin(Rad(gamma)) * std::sin(Rad(c))) +
                           *tube.aim * std::cos(Rad(gamma));
      EXPECT_NEAR(read->file.table.At(Radians(Rad(c)), Radians(Rad(gamma))).value(),
                  100.0 * mantle(towards), 0.7)
          << "C" << c << " gamma " << gamma;
    }
  }
}

TEST(LightDistribution, HardSpotsKeepTheirFlux) {
  const IntensityTable table = TableOf(SpotOf(30.0, 30.0));
  EXPECT_NEAR(table.Flux().value(), 2000.0 * kPi * (1.0 - std::cos(Rad(30.0))), 0.6);
  EXPECT_DOUBLE_EQ(table.At(Radians(0), Radians(Rad(29.99))).value(), 1000.0);
  EXPECT_DOUBLE_EQ(table.At(Radians(0), Radians(Rad(31))).value(), 0.0);
}

TEST(PhotometricExport, NamesFilesAfterLightsAndReadersFindTheLampInThem) {
  FittedLight spot = SpotOf(15.0, 25.0);
  spot.name = "key light/1";
  const LightFile lights = FileOf({spot, SimpleLight("fill", LightKind::kPoint, 50.0)});
  for (const bool ldt : {false, true}) {
    const auto preset = (ldt ? &ExportLdt : &ExportIes)(lights, "set", {});
    ASSERT_TRUE(preset);
    ASSERT_EQ(preset->files.size(), 2U);
    EXPECT_EQ(preset->files[0].name, std::string("set-key_light_1.") + (ldt ? "ldt" : "ies"));
    const auto read = PhotometricFromText(preset->files[0].contents, "x");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_TRUE(read->warnings.empty());
    EXPECT_NEAR(read->file.table.peak().intensity.value(), 1000.0, 1e-4);
    EXPECT_NEAR(read->file.header.lamp_flux->value() / read->file.table.Flux().value(), 1.0, 1e-6);
    EXPECT_EQ(read->file.table.grid().vertical_deg.front(), 0.0);
    EXPECT_EQ(read->file.table.grid().vertical_deg.back(), 180.0);
    EXPECT_EQ(read->file.header.luminaire, "key light/1");
  }
}

// To Windows and macOS "set-Key.ies" and "set-key.ies" are one file.
TEST(PhotometricExport, NamesThatDifferByCaseAloneAreTwoFilesEverywhere) {
  const LightFile lights = FileOf(
      {SimpleLight("Key", LightKind::kPoint, 100.0), SimpleLight("key", LightKind::kPoint, 50.0)});
  const auto preset = ExportIes(lights, "set", {});
  ASSERT_TRUE(preset);
  EXPECT_EQ(preset->files[0].name, "set-Key.ies");
  EXPECT_EQ(preset->files[1].name, "set-key_.ies");
}

TEST(PhotometricExport, LightsAtInfinityAreNamedAndLeftOut) {
  const auto preset = ExportIes(FileOf({Sun()}), "set", {});
  ASSERT_TRUE(preset);
  EXPECT_TRUE(preset->files.empty());
  ASSERT_EQ(preset->warnings.size(), 1U);
  EXPECT_EQ(preset->warnings[0].code, "no_distribution");
}

TEST(PhotometricExport, SameLightsSameBytes) {
  const LightFile lights = FileOf({SpotOf(10.0, 20.0)});
  EXPECT_EQ(ExportIes(lights, "s", {})->files[0].contents,
            ExportIes(lights, "s", {})->files[0].contents);
}

}  // namespace
}  // namespace lightcal::test
