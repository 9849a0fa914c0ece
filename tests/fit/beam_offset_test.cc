// SPDX-License-Identifier: Apache-2.0
// What a beam's readings tell of where its light starts: distances do, the beam's shape does not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "lightcal/fit/fit_light.h"
#include "lightcal/light/fixture.h"

namespace lightcal {
namespace {

constexpr double kIntensity = 5000.0;

// A soft beam over spill, which no closed form here has: exp(-(gamma / 20 deg)^2) and .006.
double SpillBeamCandela(double gamma_rad) {
  const double x = gamma_rad * 180.0 / std::numbers::pi / 20.0;
  return kIntensity * (std::exp(-x * x) + 0.006) / 1.006;
}

// A place beside the axis, seen from the lamp's: x across, z along.
struct Place {
  double x = 0.0, z = 2.0;
};

// 1 % a reading, none of it taken, the meter facing the lamp's place; its fixture is not stated.
Session BeamSession(double offset_m, const std::vector<Place>& places) {
  Session session;
  session.name = "beam";
  session.surroundings = Surroundings::kDark;
  LightDescription light;
  light.name = "lamp";
  light.kind = LightKind::kSpot;
  light.position_m = Vec3{0.0, 0.0, 0.0};
  light.aim = Vec3{0.0, 0.0, 1.0};
  session.lights = {light};
  for (const Place& at : places) {
    const double z = at.z + offset_m;
    const double r = std::hypot(at.x, z);
    const double to_place = std::hypot(at.x, at.z);
    Reading reading;
    reading.light = "lamp";
    reading.position_m = Vec3{at.x, 0.0, at.z};
    reading.normal = Vec3{-at.x / to_place, 0.0, -at.z / to_place};
    const double facing = (at.x * at.x + z * at.z) / (r * to_place);
    reading.illuminance = Lux(SpillBeamCandela(std::atan2(std::abs(at.x), z)) * facing / (r * r));
    reading.sigma_relative = 0.01;
    session.readings.push_back({reading, "reading"});
  }
  return session;
}

constexpr double kOffsets[] = {-0.3, -0.2, -0.05, 0.0, 0.1};

// They hold the truth, and know of d0 what its prior knew.
void HoldsAtEveryOffset(const std::vector<Place>& places) {
  const double prior_sd = MatchedOffset(OffsetParts({})).sd_m;
  for (const double offset : kOffsets) {
    SCOPED_TRACE(offset);
    const auto fitted = FitSession(BeamSession(offset, places), {});
    ASSERT_TRUE(fitted.has_value()) << fitted.error().message;
    const FittedLight& light = fitted->lights.lights.front();
    ASSERT_TRUE(light.beam && light.beam->axial);
    EXPECT_LE(*light.beam->axial->low, kIntensity);
    EXPECT_GE(*light.beam->axial->high, kIntensity);
    EXPECT_GE(light.distance_offset_m->u95, 0.85 * kZ95 * prior_sd);
    EXPECT_EQ(light.budget.front().name, "distance_offset");
    EXPECT_GT(light.budget.front().share, 0.9);
  }
}

TEST(BeamOffset, IsNotToldByTheShapeOnAPlane) {
  HoldsAtEveryOffset({{0.0}, {0.2}, {0.4}, {0.6}, {0.8}, {1.0}, {1.3}, {1.6}});
}

TEST(BeamOffset, IsNotToldByTheShapeAllAround) {
  std::vector<Place> places;
  for (const double deg : {0.0, 6.0, -12.0, 17.0, -22.0, 27.0, -33.0, 40.0}) {
    const double a = deg * std::numbers::pi / 180.0;
    places.push_back({2.0 * std::sin(a), 2.0 * std::cos(a)});
  }
  HoldsAtEveryOffset(places);
}

TEST(StatedCone, ThatTheReadingsAreNotOnIsRefusedWithWhatTheyShow) {
  const std::vector<Place> places = {{0.0}, {0.2}, {0.4}, {0.6}, {0.8}, {1.0}, {1.3}, {1.6}};
  for (const Surroundings around : {Surroundings::kDark, Surroundings::kIndoors}) {
    for (const bool inner_too : {true, false}) {
      Session session = BeamSession(0.0, places);
      session.surroundings = around;
      session.lights.front().outer = RadiansFromDegrees(inner_too ? 35.0 : 40.0);
      if (inner_too) session.lights.front().inner = RadiansFromDegrees(8.0);
      const auto fitted = FitSession(session, {});
      ASSERT_FALSE(fitted.has_value());
      EXPECT_EQ(fitted.error().code, "cone_unlike");
      EXPECT_NE(fitted.error().message.find("beam_deg"), std::string::npos);
    }
  }
}

// 33 degrees are read; the offset could take up 60 as well, and with it 38 % of the intensity.
TEST(PrintedAngle, ThatTheReadingsContradictIsLeftOutByName) {
  const std::vector<Place> places = {{0.0}, {0.2}, {0.4}, {0.6}, {0.8}, {1.0}, {1.3}, {1.6}};
  Session session = BeamSession(0.0, places);
  const auto alone = FitSession(session, {});
  ASSERT_TRUE(alone.has_value()) << alone.error().message;
  const auto told = [](const FittedSession& fitted) {
    return std::ranges::any_of(fitted.warnings, [](const Warning& warning) {
      return warning.code == "data_sheet_disagrees" &&
             warning.message.find("_deg is") != std::string::npos;
    });
  };
  session.lights.front().beam = RadiansFromDegrees(60.0);
  const auto contradicted = FitSession(session, {});
  ASSERT_TRUE(contradicted.has_value()) << contradicted.error().message;
  EXPECT_TRUE(told(*contradicted));
  EXPECT_EQ(contradicted->lights.lights.front().intensity_cd->value,
            alone->lights.lights.front().intensity_cd->value);
  session.lights.front().beam = RadiansFromDegrees(33.5);
  const auto agrees = FitSession(session, {});
  ASSERT_TRUE(agrees.has_value()) << agrees.error().message;
  EXPECT_FALSE(told(*agrees));
  const auto width = [](const FittedSession& fitted) {
    const Uncertain& found = *fitted.lights.lights.front().intensity_cd;
    return *found.high / *found.low;
  };
  EXPECT_LT(width(*agrees), width(*alone));
}

TEST(BeamOffset, IsToldByDistances) {
  for (const double offset : kOffsets) {
    SCOPED_TRACE(offset);
    const auto fitted = FitSession(
        BeamSession(offset,
                    {{0.0, 0.8}, {0.0, 4.0}, {0.0}, {0.3}, {-0.5}, {0.7}, {-0.9}, {1.2}, {-1.6}}),
        {});
    ASSERT_TRUE(fitted.has_value()) << fitted.error().message;
    const FittedLight& light = fitted->lights.lights.front();
    EXPECT_NEAR(light.distance_offset_m->value, offset, light.distance_offset_m->u95);
    EXPECT_LT(light.distance_offset_m->u95, 0.03);
    for (const BudgetPart& part : light.budget) {
      if (part.name == "distance_offset") EXPECT_LT(part.share, 0.6);
    }
    ASSERT_TRUE(light.beam && light.beam->axial);
    EXPECT_LE(*light.beam->axial->low, kIntensity);
    EXPECT_GE(*light.beam->axial->high, kIntensity);
    EXPECT_LT(*light.beam->axial->high / *light.beam->axial->low, 1.2);
  }
}

}  // namespace
}  // namespace lightcal
