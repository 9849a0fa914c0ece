// SPDX-License-Identifier: Apache-2.0
// What colour walls, ceiling, floor and furniture give the light that they throw back.
#pragma once

namespace lightcal {

// The walls' light has X/Y of the lamp's own times exp(ln_x), and Z/Y times exp(ln_z), both normal.
// A filter tells this alike of a candle, a white LED and daylight: in mireds it is 40 of any.
struct WallTint {
  double ln_x, sd_x;
  double ln_z, sd_z;
  double correlation;
  double place_x, place_z;  // 1 sigma from place to place in one room
};
// Of 600 path-traced ordinary rooms at .5 to 3 m (tests/tools/traced_rooms: colours; bulbs .030,
// -.21, panels .040, -.26, beams .056, -.36, 1 sigma .035 to .060 and .14 to .22, by illuminant A,
// CIE LED-B3 and 5600 K): white and grey paint warms by repetition, and so do wooden floors.
inline constexpr WallTint kWallTint = {0.036, 0.042, -0.24, 0.165, -0.85, 0.009, 0.055};

}  // namespace lightcal
