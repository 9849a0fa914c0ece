// SPDX-License-Identifier: Apache-2.0
// Light that goes to and fro between a room's walls, with its place: radiosity of a grey box.
#pragma once

#include <span>
#include <vector>

#include "lightcal/light/scene.h"
#include "lightcal/light/wall_patch.h"

namespace lightcal {

// About 200 patches, 4 a side at least, smaller towards the edges, where walls light each other
// most.
//   E_i = E1_i + rho sum_j F_ij E_j,  A_i F_ij = A_j F_ji, sum_j F_ij = 1
// F_ij from i's middle to the whole of j (rect_source.h), the mean of both ways, then made whole:
// the box is closed, no light gets lost. Source: Goral et al., SIGGRAPH 1984.
class RoomExchange {
 public:
  explicit RoomExchange(const RoomBox& room);

  [[nodiscard]] std::span<const WallPatch> patches() const { return patches_; }
  // What arrives at each patch of light thrown back once or more often, from what of it was thrown
  // back once, `once_lx`, whose mean over the room shall be `mean_lx`.                      [lx]
  [[nodiscard]] std::vector<double> Settled(std::vector<double> once_lx, double mean_lx) const;

 private:
  void FindShares();
  [[nodiscard]] double MeanOf(const std::vector<double>& lux) const;

  double reflectance_;
  std::vector<WallPatch> patches_;
  std::vector<double> shares_;  // F_ij, row by row
  double area_m2_ = 0.0;
};

}  // namespace lightcal
