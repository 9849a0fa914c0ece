// SPDX-License-Identifier: Apache-2.0
// A picture of a lit wall -> the lamp's intensity by direction. Wall coordinates: records'
// charuco_board.h; the wall is the plane y = 0.
//
//      lamp (x, y < 0, z)                     z ^   the board's left edge
//        \  r                                   |
//         \          P (x, 0, z) on the wall    |__> x  its lower edge;  y points into the wall
//          \ incidence theta_i
//   wall ___\P____________
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/vec3.h"
#include "lightcal/core/view2d.h"
#include "lightcal/imaging/scene/board_camera.h"
#include "lightcal/imaging/scene/patches.h"
#include "lightcal/light/intensity_sample.h"
#include "lightcal/light/other_wall_light.h"

namespace lightcal {

// A square of pixels that see plain wall.
struct WallBlock {
  std::array<double, 2> pixel{};  // its middle
  double nits = 0.0;              // mean of its pixels, as the picture has them
  double sigma_nits = 0.0;        // 1 sigma of the mean: what its pixels scatter, noise or texture
};

struct WallSelection {
  std::optional<Region> wall;  // what shows the wall; absent = the whole picture
  std::vector<Region> masks;   // what does not: furniture, the lamp itself
  bool board_hangs = true;     // the board is in this very picture: it is left out, with a margin
};

struct WallBlocks {
  std::vector<WallBlock> blocks;
  int side_px = 1;
  int saturated = 0;  // blocks left out because a pixel's sigma is as large as its value
};

// About `wanted` blocks over the picture. sigma (1 standard deviation of each pixel's luminance)
// may be empty. Left out: blocks that touch a mask, the board, saturated pixels, or miss the wall.
// Refused: bad_region, wall_unreadable (fewer than 100 blocks left).
[[nodiscard]] Result<WallBlocks> BlocksOfWall(View2d<const float> nits, View2d<const float> sigma,
                                              const WallSelection& selection,
                                              const WallCamera& camera, const CharucoBoard& board,
                                              int wanted = 6000);

// What turns the wall's luminance into intensity.
struct WallModel {
  CameraParameters camera{};
  double board_scale = 1.0;  // true size of the printed squares over the stated one
  Vec3 lamp_m{};             // y < 0
  double reflectance = 0.0;
  double vignetting = 0.0;   // n: the picture fell off as cos^n of the angle off the lens's axis
  double gloss_light = 0.0;  // a: a surface that is not quite matt reflects 1 - a (1 - cos theta_i)
  double gloss_view = 0.0;   // b: likewise by the angle it is seen at
  OtherWallLight other{};    // taken off what is seen
};

// One sample a block, in the order of the blocks:
//   E_seen = pi/rho seen / [cos^n(off axis) (1 - b (1 - cos theta_v))]
//   E = (E_seen - E_other)/(1 - a (1 - cos theta_i)),   I = E r^2 / cos theta_i,
//   cos theta_i = |y_lamp| / r
// Lambertian but for a and b. Blocks that the light grazes or that are seen at more than 80 degrees
// have intensity and sigma 0 and are not to be used.
[[nodiscard]] std::vector<IntensitySample> IntensitiesOf(const WallBlocks& blocks,
                                                         const WallModel& model);

// E_seen above of the blocks whose intensity can be used.
[[nodiscard]] std::vector<SeenPlace> PlacesSeen(const WallBlocks& blocks, const WallModel& model);

}  // namespace lightcal
