// SPDX-License-Identifier: Apache-2.0
// Where the search for a lamp's position starts: a closed form where the layout has one, and a scan
// of all directions and distances, so that no mirror image stays hidden.
#pragma once

#include <optional>
#include <vector>

#include "lightcal/fit/locate/placed_solve.h"

namespace lightcal::fit {

// The plane that all meters lie in and face away from: readings taken flat on a table or a floor.
struct CommonPlane {
  Vec3 origin{};  // the meters' mean
  Vec3 normal{};
  Vec3 across{}, along{};  // unit, in the plane
};
// Absent when a lit reading has no position, no normal, another normal or another height.
[[nodiscard]] std::optional<CommonPlane> CommonPlaneOf(const std::vector<PlacedRow>& rows);

// The linear solution, exact without noise and ambient light, E0 taken as `ambient`:
//   common plane  |p|^2 = 2 p.s - q + c E^(-2/3),  h = sqrt(q - |s|^2), I = c^(3/2)/h
//   (lamp shining straight at it: c E^(-1/2),  I = c^2/h^2)
//   facing meters |p|^2 = 2 p.s - q + I/E,  s in three dimensions
// by least squares weighted with the readings' sigmas. Absent for other layouts, fewer rows than
// unknowns, points of one circle, line or sphere, or q <= |s|^2.
// Source: reference/physics.md 4.2 c, 4.3.
[[nodiscard]] std::optional<PlacedTheta> LinearPlacedStart(const PlacedEstimation& estimation,
                                                           double ambient);

// ln I as the weighted mean of what each reading asks for with the lamp at this place; absent where
// some meter or the lamp faces away.
[[nodiscard]] std::optional<PlacedTheta> PlacedStartAt(const PlacedEstimation& estimation,
                                                       const Vec3& lamp, double ambient);

// Up to eight of the best of a scan over directions from the meters' middle and distances of 0.15
// to 40 times their extent, unlike each other.
[[nodiscard]] std::vector<PlacedTheta> ScanPlacedStarts(PlacedEstimation estimation,
                                                        double ambient);

// The best of such a scan at one distance, in extents of the layout.
[[nodiscard]] std::optional<PlacedTheta> BestStartAt(PlacedEstimation estimation, double extents,
                                                     double ambient);

// Middle of the meters' positions and the root of their mean squared distance from it (1 where all
// stand in one place).
struct Layout {
  Vec3 middle{};
  double extent = 1.0;
};
[[nodiscard]] Layout LayoutOf(const std::vector<PlacedRow>& rows);

}  // namespace lightcal::fit
