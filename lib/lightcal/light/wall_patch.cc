// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/wall_patch.h"

#include <cstddef>

namespace lightcal {

std::vector<WallPatch> PatchesOf(const RoomWall& wall, const Vec3& size_m,
                                 const std::vector<double>& u_edges,
                                 const std::vector<double>& v_edges) {
  Vec3 inward{};
  inward[wall.axis] = wall.upper ? -1.0 : 1.0;
  Vec3 along{};
  along[wall.u()] = 1.0;
  const SourceFrame frame = SourceFrame::Facing(inward, along);
  std::vector<WallPatch> patches;
  for (std::size_t i = 0; i + 1 < u_edges.size(); ++i) {
    for (std::size_t j = 0; j + 1 < v_edges.size(); ++j) {
      const double half_u = 0.5 * (u_edges[i + 1] - u_edges[i]);
      const double half_v = 0.5 * (v_edges[j + 1] - v_edges[j]);
      WallPatch patch{{half_u, half_v}, {{}, frame, 0.0}};
      patch.pose.position_m[wall.axis] = wall.at_m(size_m);
      patch.pose.position_m[wall.u()] = 0.5 * (u_edges[i + 1] + u_edges[i]);
      patch.pose.position_m[wall.v()] = 0.5 * (v_edges[j + 1] + v_edges[j]);
      patches.push_back(patch);
    }
  }
  return patches;
}

}  // namespace lightcal
