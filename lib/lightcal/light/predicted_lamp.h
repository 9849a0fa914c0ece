// SPDX-License-Identifier: Apache-2.0
// One lamp ready to be asked: settled, with the walls that it lights. Used by illuminance_map.cc
// and tile_work.cc alone.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "lightcal/core/uncertain.h"
#include "lightcal/light/illuminance_map.h"
#include "lightcal/light/room_exchange.h"
#include "lightcal/light/wall_light.h"

namespace lightcal {

// Where the lamp lights a wall most, and how wide that spot is: there the walls' light bends.
struct HotSpot {
  Vec3 position_m{};
  double size_m = 0.0;
};

// One for all lamps of a room, found when first asked for.
class SharedExchange {
 public:
  [[nodiscard]] const RoomExchange& Of(const RoomBox& room) {
    std::call_once(once_, [&] { exchange_.emplace(room); });
    return *exchange_;
  }

 private:
  std::once_flag once_;
  std::optional<RoomExchange> exchange_;
};

class PredictedLamp {
 public:
  // `shared`: of the settings' room.
  PredictedLamp(const PlacedLamp& lamp, const MapSettings& settings,
                std::shared_ptr<SharedExchange> shared);

  [[nodiscard]] const PlacedLamp& lamp() const { return lamp_; }
  // Whether more than its strength and offset is unsure: u95/E then is no smooth field.
  [[nodiscard]] bool shape_unsure() const { return shape_unsure_; }
  // Whether a room is known that could throw its light back.
  [[nodiscard]] bool has_walls() const { return coarse_.has_value(); }

  // The lamp's foot on each wall, and where its beam hits one. Empty without walls.
  [[nodiscard]] std::span<const HotSpot> hot_spots() const { return hot_spots_; }

  // The fine walls, built when first asked for.
  [[nodiscard]] const WallLight& Walls() const;
  // 95 % interval of their light, relative: theirs and the lamp's own.
  [[nodiscard]] double WallsU95Relative() const;
  // Largest bound of the walls' light over direct light at the points, relative.
  [[nodiscard]] double BounceOverDirect(std::span<const SurfacePoint> points) const;
  // Its two parts: the largest bound at the points [lx], and what `lux` is at most of direct light.
  [[nodiscard]] double BounceBound(std::span<const SurfacePoint> points) const;
  [[nodiscard]] double OverDirect(double lux, std::span<const SurfacePoint> points) const;
  // 95 % half width of direct light, `left_off` a relative bound of what was left off.     [lx]
  [[nodiscard]] double DirectU95(const SurfacePoint& at, double direct_lx,
                                 const SourceDetail& detail, double left_off) const;

 private:
  [[nodiscard]] double Unmodelled(const SurfacePoint& at) const;
  void FindHotSpots();

  PlacedLamp lamp_;
  double haze_per_m_;
  bool shape_unsure_ = false;
  std::optional<RoomBox> room_;
  std::optional<WallLight> coarse_;
  std::vector<HotSpot> hot_spots_;
  struct Fine {
    std::once_flag once;
    std::optional<WallLight> walls;
  };
  std::shared_ptr<SharedExchange> shared_;
  std::unique_ptr<Fine> fine_ = std::make_unique<Fine>();
};

// Gate constants, shared by points and maps.
inline constexpr double kOffShare = 0.5;       // of the tolerance, for what is left off
inline constexpr double kBetweenShare = 0.25;  // for interpolating the walls' light

[[nodiscard]] SourceDetail DetailOf(EffectChoice finite_source, double tolerance);

}  // namespace lightcal
