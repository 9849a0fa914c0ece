// SPDX-License-Identifier: Apache-2.0
// What colour painted surfaces give the light that they throw back.
#pragma once

namespace lightcal {

// Light thrown back has X/Y of what fell there times exp(ln_x), and Z/Y times exp(ln_z), both
// normal. A filter tells this alike of a candle, a white LED and daylight: in mireds it is 40 of
// any.
struct SurfaceTint {
  double ln_x = 0.0, sd_x = 0.0;
  double ln_z = 0.0, sd_z = 0.0;
  double correlation = 0.0;
};

// All light but the lamp's own, off walls, ceiling, floor and furniture: of 600 path-traced
// ordinary rooms at .5 to 3 m (tests/tools/traced_rooms: colours; bulbs .030, -.21, panels .040,
// -.26, beams .056, -.36, 1 sigma .035 to .060 and .14 to .22, by illuminant A, CIE LED-B3 and 5600
// K): white and grey paint warms by repetition, and so do wooden floors.
inline constexpr SurfaceTint kTintOfRoom = {0.036, 0.042, -0.24, 0.165, -0.85};
inline constexpr double kRoomTintPlaceX = 0.009, kRoomTintPlaceZ = 0.055;  // 1 sigma within a room

// One bounce off a wall's paint, which is any that walls have (1,246 walls of those rooms: ln_x
// .004 to .016, ln_z -.105 to -.12, whites alone -.08), and off one that its maker's sRGB tells:
// prints are of 8 bits, paint ages, and another lamp's spectrum sees it otherwise.
inline constexpr SurfaceTint kTintOfPaint = {0.009, 0.032, -0.112, 0.13, -0.75};
inline constexpr double kToldPaintSdX = 0.02, kToldPaintSdZ = 0.05;
// The other walls have that paint too: what it is off its mean, in ln, the room is off by this part
// (.57 and .71 of those rooms, .79 and .72 of unseen ones).
inline constexpr double kRoomFollowsPaint = 0.7;

}  // namespace lightcal
