// SPDX-License-Identifier: Apache-2.0
// Illuminance predicted at points and over planes, each region by the cheapest form whose bounds
// keep it within a tolerance: the effect gate, where the scene is a map.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lightcal/light/placed_lamp.h"
#include "lightcal/light/scene.h"

namespace lightcal {

enum class EffectChoice : std::uint8_t { kGate, kAlways, kNever };

struct MapSettings {
  double tolerance = 0.01;  // relative to each lamp's own light
  EffectChoice finite_source = EffectChoice::kGate;
  EffectChoice room_bounce = EffectChoice::kGate;
  std::optional<RoomBox> room;  // none: what walls throw back is left out
  double haze_per_m = 2e-4;     // clear air's extinction: widens u95
  int threads = 0;              // 0 = one a processor
};

// How many points each form carried, and what was evaluated for it.
enum class MapForm : std::uint8_t {
  kDark,    // outside a spot's cone, behind a flat lamp: nothing to do
  kPoint,   // inverse square and cosine
  kCone,    // a spot's profile
  kGauss2,  // 2 x 2 points of a flat source
  kGauss3,
  kGauss4,
  kExact,          // closed form, contour, table
  kEven,           // sun and sky
  kBounce,         // with the walls' light, evaluated at points
  kBounceBetween,  // with the walls' light, interpolated
};
inline constexpr std::size_t kMapForms = 10;
using FormCounts = std::array<std::int64_t, kMapForms>;

// What the gate did for one lamp.
struct LampAccount {
  FormCounts points{};                // a point counts once among the forms of direct light
  std::int64_t bounce_evaluated = 0;  // of WallLight
  double bounce_left_off = 0.0;       // largest bound of the walls' light where it was left off

  LampAccount& operator+=(const LampAccount& other);
};

// A lamp's part at one point.
struct LampLux {
  double direct_lx = 0.0, bounce_lx = 0.0;
  double u95_lx = 0.0;
};

// Pixel (i, j) stands at first + across i + down j.
struct PlaneGrid {
  Vec3 first_m{};
  Vec3 across_m{}, down_m{};  // steps, square to each other
  Vec3 normal{0.0, 0.0, 1.0};
  int width = 1, height = 1;
};

struct IlluminanceMap {
  int width = 0, height = 0;
  std::vector<float> lux, u95;        // rows from the top
  std::vector<LampAccount> accounts;  // one a lamp
};

class PredictedLamp;

// Lamps ready to be asked.
//
// Gate, by region and lamp, of the bounds relative to that lamp's own direct light there: the
// walls' light is off while its bound stays within half the tolerance; where it is on, its
// interpolation may err by a quarter. A flat source takes the ladder's first level (light/models)
// whose bound at the region's nearest point fits into what is left. So the sum of what is left off
// stays within the tolerance. A region that lies across a cone's edge, or whose near and far ends
// call for different forms, is cut in four, down to 8 x 8 points.
//
// u95: of the lamp (DoubtOfLux), 10 % of the bounce (1 sigma), what is left off and clear air as
// rectangular distributions. Lamps are added up linearly, because one meter's gain is common to all
// lamps it read.
class IlluminancePredictor {
 public:
  IlluminancePredictor(std::span<const PlacedLamp> lamps, const MapSettings& settings);
  ~IlluminancePredictor();
  IlluminancePredictor(IlluminancePredictor&&) noexcept;
  IlluminancePredictor(const IlluminancePredictor&) = delete;
  IlluminancePredictor& operator=(const IlluminancePredictor&) = delete;
  IlluminancePredictor& operator=(IlluminancePredictor&&) = delete;

  // Each lamp's part at one point, in their order.
  [[nodiscard]] std::vector<LampLux> At(const SurfacePoint& at,
                                        std::vector<LampAccount>* accounts = nullptr) const;
  [[nodiscard]] IlluminanceMap Over(const PlaneGrid& grid) const;
  // The same into a map of the same size, whose memory is used again.
  void Over(const PlaneGrid& grid, IlluminanceMap& map) const;

 private:
  std::vector<PredictedLamp> lamps_;
  MapSettings settings_;
};

}  // namespace lightcal
