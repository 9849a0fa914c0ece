// SPDX-License-Identifier: Apache-2.0
#include "simulate/map_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "typed_reading.h"

namespace lightcal::app {
namespace {

constexpr int kMostPixels = 8192;
constexpr double kReachOfHeight = 2.0;  // beyond the lamps' feet, each way
constexpr double kLeastHalf = 1.0;      // metres
constexpr double kMostHalf = 50.0;
constexpr double kAimReach = 10.0;  // heights, to where a beam meets the plane
constexpr double kWallHeight = 2.6;
constexpr char kAxes[] = "xyz";

struct Where {
  int axis = 2;
  double at = 0.0;
};

Result<Where> ParseWhere(const std::string& text) {
  if (text == "floor") return Where{};
  const bool named = text.size() > 2 && text[1] == '=' && text[0] >= 'x' && text[0] <= 'z';
  const auto length = named ? ParseLength(text.substr(2)) : ParseLength("");
  if (!length) {
    return WrongUsage("--plane", "\"" + text + "\" must be floor, z=0.8, x=-2 or y=1.5 (metres)");
  }
  return Where{text[0] - 'x', length->value()};
}

// Whether the plane's +axis side sees the light: up for a floor, else as most lamps do.
bool FacesPlus(const Where& where, const std::vector<PlacedLamp>& lamps) {
  int plus = 0;
  int minus = 0;
  for (const PlacedLamp& lamp : lamps) {
    if (IsSky(lamp.source)) continue;
    const double side = std::holds_alternative<SunSource>(lamp.source)
                            ? -lamp.pose.frame.z[where.axis]
                            : lamp.pose.position_m[where.axis] - where.at;
    ++(side >= 0.0 ? plus : minus);
  }
  return plus >= minus;
}

struct Extent {
  double low = 1e300, high = -1e300;
  void Add(double v) {
    low = std::min(low, v);
    high = std::max(high, v);
  }
};

// Feet of the lamps, where their beams meet the plane, and the largest height over it.
struct Scenery {
  std::array<Extent, 2> around;
  double height = 0.0;
};
Scenery SceneryOf(const Where& where, const std::array<int, 2>& axes,
                  const std::vector<PlacedLamp>& lamps) {
  Scenery out;
  for (const PlacedLamp& lamp : lamps) {
    if (IsEverywhere(lamp.source)) continue;
    const Vec3& p = lamp.pose.position_m;
    const double height = std::abs(p[where.axis] - where.at);
    out.height = std::max(out.height, height);
    for (std::size_t k = 0; k < 2; ++k) out.around[k].Add(p[axes[k]]);
    const bool beam = std::holds_alternative<SpotSource>(lamp.source) ||
                      std::holds_alternative<TableSource>(lamp.source);
    const Vec3& aim = lamp.pose.frame.z;
    if (!beam || aim[where.axis] == 0.0) continue;
    const double along = (where.at - p[where.axis]) / aim[where.axis];
    if (!(along > 0.0) || along > kAimReach * height) continue;
    for (std::size_t k = 0; k < 2; ++k) out.around[k].Add(p[axes[k]] + along * aim[axes[k]]);
  }
  if (out.around[0].low > out.around[0].high) out.around = {Extent{0.0, 0.0}, Extent{0.0, 0.0}};
  return out;
}

std::array<Extent, 2> DefaultExtent(const Where& where, const std::array<int, 2>& axes,
                                    const std::vector<PlacedLamp>& lamps,
                                    const std::optional<RoomBox>& room) {
  std::array<Extent, 2> out;
  const Scenery scenery = SceneryOf(where, axes, lamps);
  const double reach = std::clamp(kReachOfHeight * scenery.height, kLeastHalf, kMostHalf);
  for (std::size_t k = 0; k < 2; ++k) {
    const int axis = axes[k];
    if (room) {
      const double size = room->size_m[axis];
      out[k] = axis == 2 ? Extent{0.0, size} : Extent{-0.5 * size, 0.5 * size};
    } else if (axis == 2) {
      out[k] = {0.0, std::max(kWallHeight, scenery.around[k].high + 0.5)};
    } else {
      out[k] = {scenery.around[k].low - reach, scenery.around[k].high + reach};
    }
  }
  if (room || where.axis != 2) return out;
  const double longer = std::max(out[0].high - out[0].low, out[1].high - out[1].low);
  for (Extent& e : out) {
    const double middle = 0.5 * (e.low + e.high);
    e = {middle - 0.5 * longer, middle + 0.5 * longer};
  }
  return out;
}

Result<void> ApplySize(const MapPlaneWords& words, std::array<Extent, 2>& extent) {
  if (!words.size.empty()) {
    const auto size = ParseLengths("--size", words.size, 'x');
    if (!size) return tl::unexpected(size.error());
    if (size->size() > 2 || !(size->front() > 0.0) || !(size->back() > 0.0)) {
      return WrongUsage("--size", "\"" + words.size + "\" must be one or two lengths: 6m or 6x4m");
    }
    const std::array<double, 2> sides = {size->front(), size->back()};
    for (std::size_t k = 0; k < 2; ++k) {
      // A wall keeps its foot.
      const bool foot = words.plane[0] != 'z' && words.plane != "floor" && k == 1;
      const double middle =
          foot ? extent[k].low + 0.5 * sides[k] : 0.5 * (extent[k].low + extent[k].high);
      extent[k] = {middle - 0.5 * sides[k], middle + 0.5 * sides[k]};
    }
  }
  if (words.center.empty()) return {};
  const auto center = ParseLengths("--center", words.center, ',');
  if (!center) return tl::unexpected(center.error());
  if (center->size() != 2) {
    return WrongUsage("--center", "\"" + words.center + "\" must be two coordinates: 1,2");
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const double half = 0.5 * (extent[k].high - extent[k].low);
    extent[k] = {(*center)[k] - half, (*center)[k] + half};
  }
  return {};
}

struct Pixels {
  int across = 0, down = 0;
};
Result<Pixels> ParseGrid(const std::string& text, double width, double height) {
  const auto bad = [&] {
    return WrongUsage("--grid", "\"" + text + "\" must be 512 or 512x256, at most " +
                                    std::to_string(kMostPixels) + " a side");
  };
  const std::size_t cross = text.find('x');
  const auto first = ParseNumber(text.substr(0, cross));
  const auto second = cross == std::string::npos ? first : ParseNumber(text.substr(cross + 1));
  const auto fits = [](double v) { return v >= 1.0 && v <= kMostPixels && v == std::floor(v); };
  if (!first || !second || !fits(*first) || !fits(*second)) return bad();
  if (cross != std::string::npos) {
    return Pixels{static_cast<int>(*first), static_cast<int>(*second)};
  }
  const double per_metre = *first / std::max(width, height);
  const auto side = [&](double metres) {
    return std::max(1, static_cast<int>(std::lround(metres * per_metre)));
  };
  return Pixels{side(width), side(height)};
}

}  // namespace

Result<MapPlane> ReadMapPlane(const MapPlaneWords& words, const std::vector<PlacedLamp>& lamps,
                              const std::optional<RoomBox>& room) {
  const auto where = ParseWhere(words.plane);
  if (!where) return tl::unexpected(where.error());
  const int axis = where->axis;
  const bool plus = words.plane == "floor" || FacesPlus(*where, lamps);
  const std::array<int, 2> axes = axis == 2   ? std::array<int, 2>{0, 1}
                                  : axis == 0 ? std::array<int, 2>{1, 2}
                                              : std::array<int, 2>{0, 2};
  std::array<Extent, 2> extent = DefaultExtent(*where, axes, lamps, room);
  if (auto sized = ApplySize(words, extent); !sized) return Propagate(std::move(sized));
  const double width = extent[0].high - extent[0].low;
  const double height = extent[1].high - extent[1].low;
  const auto pixels = ParseGrid(words.grid, width, height);
  if (!pixels) return tl::unexpected(pixels.error());

  MapPlane out;
  // A wall seen from the room: its right hand is -normal x up.
  const bool mirrored = (axis == 0 && !plus) || (axis == 1 && plus);
  out.left = mirrored ? extent[0].high : extent[0].low;
  out.right = mirrored ? extent[0].low : extent[0].high;
  out.bottom = extent[1].low;
  out.top = extent[1].high;
  out.across_axis = kAxes[axes[0]];
  out.up_axis = kAxes[axes[1]];
  const std::string at = ShortestText(where->at) + " m";
  out.name = words.plane == "floor" ? "floor"
             : axis == 2            ? "plane z = " + at
                                    : "wall " + std::string(1, kAxes[axis]) + " = " + at;
  PlaneGrid& grid = out.grid;
  grid.width = pixels->across;
  grid.height = pixels->down;
  grid.normal = {};
  grid.normal[axis] = plus ? 1.0 : -1.0;
  const double step_x = (out.right - out.left) / grid.width;
  const double step_y = height / grid.height;
  grid.across_m[axes[0]] = step_x;
  grid.down_m[axes[1]] = -step_y;
  grid.first_m[axis] = where->at;
  grid.first_m[axes[0]] = out.left + 0.5 * step_x;
  grid.first_m[axes[1]] = out.top - 0.5 * step_y;
  return out;
}

Vec3 PointOf(const MapPlane& plane, int i, int j) {
  return plane.grid.first_m + plane.grid.across_m * static_cast<double>(i) +
         plane.grid.down_m * static_cast<double>(j);
}

}  // namespace lightcal::app
