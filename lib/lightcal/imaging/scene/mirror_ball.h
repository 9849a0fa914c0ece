// SPDX-License-Identifier: Apache-2.0
// A mirror ball's highlight -> the ray that a lamp stands on; rays -> the lamp.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"
#include "lightcal/imaging/panorama/panorama.h"

namespace lightcal {

// The camera in the session's axes. Its top is up as far as its aim allows, then leans to the right
// by roll; aim of any length above 0.
struct CameraPose {
  Vec3 position_m{};
  Vec3 aim{0.0, 1.0, 0.0};
  Radians roll{0.0};
};

struct BallPicture {
  std::string name;  // for messages
  PixelSolidAngles view;
  CameraPose camera;
  Metres diameter{0.0};
  std::array<double, 4> outline{};    // x, y, width, height of the box around the ball, pixels
  std::array<double, 2> highlight{};  // pixel centres at .5
};

// 1 sigma of what a person and a picture leave open; pixels, metres, radians.
struct BallErrors {
  double outline_px = 0.5, highlight_px = 0.5;
  double camera_m = 0.005;
  double aim_rad = 0.005;
};

struct BallRay {
  std::string name;
  Vec3 ball_m{};           // the ball's middle
  Vec3 from_m{};           // the point that reflects
  Vec3 direction{};        // unit, from there to the lamp
  double angle_sd = 0.0;   // of the direction, radians
  double from_sd_m = 0.0;  // of the point
};

// The ball's middle lies where a sphere of this diameter fills the box; with v the unit vector from
// the highlight to the camera and n the ball's normal there,
//   L = 2 (n . v) n - v,
// exact at any distance. Errors by finite differences of every input; they come to about
// 2 e / (R cos i) for e pixels on a ball of R pixels.
// Refused: bad_ball (no sphere fills the box, as where it is not a box around an outline),
// highlight_off_ball.
[[nodiscard]] Result<BallRay> RayOfBall(const BallPicture& picture, const BallErrors& errors = {});

struct BallLamp {
  Vec3 position_m{};
  Vec3 sd_m{};
};

// The point nearest to all rays, each weighted by its error at the lamp. One ray alone needs
// `distance`, from its ball's middle to the lamp.
// Refused: one_ball (one ray, no distance), rays_parallel (they meet too flat to tell a depth: sd
// beyond half the distance), rays_miss (they pass each other by more than four times their errors),
// bad_distance (shorter than the ball).
[[nodiscard]] Result<BallLamp> LampOfRays(std::span<const BallRay> rays,
                                          std::optional<Metres> distance = {});

}  // namespace lightcal
