// SPDX-License-Identifier: Apache-2.0
// The gate of maps against all effects, over random lamps in random rooms. That all effects are
// right is told by tests/app/simulate_test.cc, whose sums share nothing with the light room.
#include "lightcal/light/illuminance_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "lightcal/light/wall_light.h"

namespace lightcal {
namespace {

struct Stage {
  PlacedLamp lamp;
  RoomBox room;
  PlaneGrid grid;
};

class Stages {
 public:
  Stage Next(int kind) {
    Stage s;
    s.room.size_m = {Between(3.0, 12.0), Between(3.0, 10.0), Between(2.4, 5.0)};
    s.room.reflectance = Between(0.02, 0.8);
    const Vec3& size = s.room.size_m;
    s.lamp.strength = Between(50.0, 5000.0);
    s.lamp.pose.position_m = {size[0] * Between(-0.45, 0.45), size[1] * Between(-0.45, 0.45),
                              size[2] * Between(0.3, 0.95)};
    const Vec3 aim = {Between(-0.8, 0.8), Between(-0.8, 0.8), -1.0};
    s.lamp.pose.frame = SourceFrame::Facing(aim * (1.0 / Length(aim)), {1.0, 0.3, 0.0});
    s.lamp.pose.offset_m = Between(-0.05, 0.1);
    s.lamp.doubt.variance_ln = 4e-4;
    s.lamp.source = SourceOf(kind);
    s.grid.width = 48;
    s.grid.height = 40;
    const bool wall = Between(0.0, 1.0) < 0.3;
    const int up = wall ? 2 : 1;
    const double high = wall ? size[2] : size[1];
    s.grid.across_m[0] = size[0] / s.grid.width;
    s.grid.down_m[up] = -high / s.grid.height;
    s.grid.first_m[0] = -0.5 * size[0] + 0.5 * s.grid.across_m[0];
    s.grid.first_m[up] = (wall ? size[2] : 0.5 * size[1]) + 0.5 * s.grid.down_m[up];
    if (wall) {
      s.grid.first_m[1] = -0.5 * size[1];
      s.grid.normal = {0.0, 1.0, 0.0};
    }
    return s;
  }

 private:
  double Between(double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<double>()(random_);
  }
  LampSource SourceOf(int kind) {
    switch (kind) {
      case 0:
        return PointSource{};
      case 1:
        return SphereSource{Between(0.02, 0.1)};
      case 2:
        return DiskSource{Between(0.02, 0.5)};
      case 3:
        return RectSource{Between(0.02, 0.8), Between(0.02, 0.5)};
      case 4:
        return TubeSource{Between(0.1, 0.8), Between(0.002, 0.03)};
      default: {
        const double outer = Between(8.0, 70.0);
        return SpotSource{
            {RadiansFromDegrees(outer * Between(0.0, 1.0)), RadiansFromDegrees(outer)}};
      }
    }
  }
  std::mt19937_64 random_{78};
};

double Worst(const IlluminanceMap& map, const IlluminanceMap& truth) {
  double worst = 0.0;
  for (std::size_t i = 0; i < map.lux.size(); ++i) {
    if (!(truth.lux[i] > 0.0F)) continue;
    worst = std::max(worst, std::abs(double{map.lux[i]} / double{truth.lux[i]} - 1.0));
  }
  return worst;
}

TEST(IlluminanceMap, TheGateIsWithinItsToleranceOfAllEffectsInRandomRooms) {
  Stages stages;
  double asked = 0.0;
  int scenes = 0;
  for (int round = 0; round < 7; ++round) {
    for (int kind = 0; kind < 6; ++kind) {
      const Stage s = stages.Next(kind);
      const std::vector<PlacedLamp> lamps = {s.lamp};
      MapSettings settings;
      settings.room = s.room;
      settings.finite_source = settings.room_bounce = EffectChoice::kAlways;
      const IlluminanceMap truth = IlluminancePredictor(lamps, settings).Over(s.grid);
      settings.finite_source = settings.room_bounce = EffectChoice::kGate;
      for (const double tolerance : {0.1, 0.03, 0.01, 0.003}) {
        settings.tolerance = tolerance;
        const IlluminanceMap map = IlluminancePredictor(lamps, settings).Over(s.grid);
        EXPECT_LE(Worst(map, truth), tolerance)
            << "kind " << kind << ", round " << round << ", tolerance " << tolerance;
        const LampAccount& account = map.accounts[0];
        if (tolerance < 0.01) continue;
        asked += static_cast<double>(account.bounce_evaluated) / (s.grid.width * s.grid.height);
        ++scenes;
      }
    }
  }
  // Even on so coarse a grid the walls are not asked at each of its points (0.63): further bounces
  // have their place, and bend near edges.
  EXPECT_LT(asked / scenes, 0.65);
  RecordProperty("walls_asked_share", std::to_string(asked / scenes));
}

TEST(IlluminanceMap, ThreadsDoNotChangeAByte) {
  Stages stages;
  const std::vector<PlacedLamp> lamps = {stages.Next(5).lamp, stages.Next(3).lamp};
  Stage s = stages.Next(0);
  s.grid.width = 150;
  s.grid.height = 131;
  MapSettings settings;
  settings.room = s.room;
  settings.threads = 1;
  const IlluminanceMap one = IlluminancePredictor(lamps, settings).Over(s.grid);
  settings.threads = 5;
  const IlluminanceMap five = IlluminancePredictor(lamps, settings).Over(s.grid);
  EXPECT_EQ(one.lux, five.lux);
  EXPECT_EQ(one.u95, five.u95);
}

TEST(IlluminanceMap, EveryPointIsCountedOnceAmongTheFormsOfDirectLight) {
  Stages stages;
  for (int kind = 0; kind < 6; ++kind) {
    Stage s = stages.Next(kind);
    s.grid.width = 77;
    const std::vector<PlacedLamp> lamps = {s.lamp};
    const IlluminanceMap map = IlluminancePredictor(lamps, MapSettings{}).Over(s.grid);
    std::int64_t points = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(MapForm::kBounce); ++k) {
      points += map.accounts[0].points[k];
    }
    EXPECT_EQ(points, 77 * s.grid.height);
  }
}

// Corridors and halls, lamps beside walls, meters anywhere and every way round.
TEST(WallLight, ItsBoundHoldsWhatTheWallsGive) {
  constexpr int kRooms = 60, kPoints = 40;
  // Light of further bounces gathers at a corridor's lamp: .7 % of these points, by up to 11 %.
  constexpr double kBeyond = 1.15, kShareBeyond = 0.02;
  std::mt19937_64 random(7);
  const auto between = [&](double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<double>()(random);
  };
  const auto direction = [&] {
    const Vec3 v{between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)};
    return v * (1.0 / Length(v));
  };
  int beyond = 0;
  for (int i = 0; i < kRooms; ++i) {
    RoomBox room;
    const double width = between(2.0, 5.0);
    const double length = width * (i % 2 == 1 ? between(1.0, 6.0) : between(1.0, 1.6));
    room.size_m = {length, width, between(2.2, i % 3 == 0 ? 8.0 : 3.0)};
    room.reflectance = between(0.2, 0.85);
    PlacedLamp lamp;
    lamp.source = i % 4 < 2 ? LampSource(PointSource{}) : LampSource(RectSource{0.1, 0.1});
    lamp.strength = 100.0;
    lamp.pose.frame = SourceFrame::Facing(direction());
    lamp.pose.position_m = {length * between(-0.45, 0.45), width * between(-0.45, 0.45),
                            room.size_m[2] * between(0.1, 0.98)};
    const WallLight fine = WallLight::Fine(room, lamp, RoomExchange(room));
    const WallLight coarse = WallLight::Coarse(room, lamp);
    for (int k = 0; k < kPoints; ++k) {
      SurfacePoint at;
      at.position_m = {length * between(-0.5, 0.5), width * between(-0.5, 0.5),
                       k % 2 == 1 ? 0.0 : room.size_m[2] * between(0.0, 1.0)};
      if (k % 2 == 0) at.normal = direction();
      const double part = fine.At(at) / coarse.BoundAt(at);
      EXPECT_LT(part, kBeyond) << i << ", " << k;
      beyond += part > 1.0 ? 1 : 0;
    }
  }
  EXPECT_LT(beyond, kShareBeyond * kRooms * kPoints);
}

}  // namespace
}  // namespace lightcal
