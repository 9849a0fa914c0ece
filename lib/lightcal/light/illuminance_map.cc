// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/illuminance_map.h"

#include <algorithm>

#include "lightcal/core/parallel.h"
#include "lightcal/light/lamp_over_plane.h"
#include "lightcal/light/predicted_lamp.h"
#include "lightcal/light/tile_work.h"

namespace lightcal {
namespace {

// Whether a whole plane may leave the walls' light off: asked first, because one answer for all
// tiles costs what one tile's does.
BounceChoice ChoiceOver(const PredictedLamp& lamp, const Plane& plane, const PlaneGrid& grid,
                        const MapSettings& settings) {
  if (!lamp.has_walls()) return {};
  if (settings.room_bounce != EffectChoice::kGate) return {settings.room_bounce, 0.0, 0.0};
  const std::vector<SurfacePoint> all = BoundPoints(lamp, plane, {0, 0, grid.width, grid.height});
  const double bound = kFieldMargin * lamp.BounceOverDirect(all);
  if (bound <= kOffShare * settings.tolerance) return {EffectChoice::kNever, bound, 0.0};
  return {EffectChoice::kGate, 0.0, lamp.BounceBound(all)};
}

void Clear(const PixelTile& tile, IlluminanceMap& map) {
  for (int j = tile.top; j < tile.bottom; ++j) {
    const std::ptrdiff_t row = std::ptrdiff_t{j} * map.width + tile.left;
    std::fill_n(map.lux.begin() + row, tile.width(), 0.0F);
    std::fill_n(map.u95.begin() + row, tile.width(), 0.0F);
  }
}

}  // namespace

LampAccount& LampAccount::operator+=(const LampAccount& other) {
  for (std::size_t k = 0; k < kMapForms; ++k) points[k] += other.points[k];
  bounce_evaluated += other.bounce_evaluated;
  bounce_left_off = std::max(bounce_left_off, other.bounce_left_off);
  return *this;
}

IlluminancePredictor::IlluminancePredictor(std::span<const PlacedLamp> lamps,
                                           const MapSettings& settings)
    : settings_(settings) {
  const auto shared = std::make_shared<SharedExchange>();
  for (const PlacedLamp& lamp : lamps) lamps_.emplace_back(lamp, settings_, shared);
}
IlluminancePredictor::~IlluminancePredictor() = default;
IlluminancePredictor::IlluminancePredictor(IlluminancePredictor&&) noexcept = default;

std::vector<LampLux> IlluminancePredictor::At(const SurfacePoint& at,
                                              std::vector<LampAccount>* accounts) const {
  std::vector<LampLux> out;
  for (const PredictedLamp& lamp : lamps_) {
    LampLux part;
    LampAccount account;
    bool bounce = lamp.has_walls();
    if (bounce && settings_.room_bounce == EffectChoice::kGate) {
      const double bound = lamp.BounceOverDirect({&at, 1});
      bounce = bound > kOffShare * settings_.tolerance;
      if (!bounce) account.bounce_left_off = bound;
    }
    const SourceDetail detail =
        DetailOf(settings_.finite_source, settings_.tolerance - account.bounce_left_off);
    part.direct_lx = LuxOf(lamp.lamp(), at, detail);
    part.u95_lx = lamp.DirectU95(at, part.direct_lx, detail, account.bounce_left_off);
    const MapForm form = part.direct_lx > 0.0 ? MapForm::kExact : MapForm::kDark;
    account.points[static_cast<std::size_t>(form)] = 1;
    if (bounce) {
      part.bounce_lx = lamp.Walls().At(at);
      part.u95_lx += lamp.WallsU95Relative() * part.bounce_lx;
      account.points[static_cast<std::size_t>(MapForm::kBounce)] = 1;
      account.bounce_evaluated = 1;
    }
    if (accounts != nullptr) accounts->push_back(account);
    out.push_back(part);
  }
  return out;
}

IlluminanceMap IlluminancePredictor::Over(const PlaneGrid& grid) const {
  IlluminanceMap map;
  Over(grid, map);
  return map;
}

void IlluminancePredictor::Over(const PlaneGrid& grid, IlluminanceMap& map) const {
  const Plane plane(grid);
  map.width = grid.width;
  map.height = grid.height;
  map.lux.resize(static_cast<std::size_t>(grid.width) * grid.height);
  map.u95.resize(map.lux.size());
  const std::size_t count = lamps_.size();
  std::vector<LampOverPlane> over;
  std::vector<BounceChoice> bounce;
  over.reserve(count);
  for (const PredictedLamp& lamp : lamps_) {
    over.emplace_back(lamp.lamp(), plane);
    bounce.push_back(ChoiceOver(lamp, plane, grid, settings_));
  }
  const int across = (grid.width + kTile - 1) / kTile;
  const int down = (grid.height + kTile - 1) / kTile;
  std::vector<LampAccount> accounts(count * static_cast<std::size_t>(across) * down);
  const auto work = [&](int index) {
    const int left = index % across * kTile;
    const int top = index / across * kTile;
    const PixelTile tile{left, top, std::min(left + kTile, grid.width),
                         std::min(top + kTile, grid.height)};
    Clear(tile, map);
    for (std::size_t k = 0; k < count; ++k) {
      LampAccount& account = accounts[static_cast<std::size_t>(index) * count + k];
      WorkTile(lamps_[k], over[k], settings_, tile, bounce[k], {plane, map, account});
    }
  };
  ParallelFor(across * down, work, settings_.threads);
  map.accounts.assign(count, {});
  for (std::size_t i = 0; i < accounts.size(); ++i) map.accounts[i % count] += accounts[i];
}

}  // namespace lightcal
