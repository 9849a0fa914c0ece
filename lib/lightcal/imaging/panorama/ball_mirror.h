// SPDX-License-Identifier: Apache-2.0
// A picture of a mirror ball: which of its points shows a direction of the sphere.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"
#include "lightcal/imaging/panorama/panorama.h"

namespace lightcal {

// What chromed and polished steel balls send back at normal incidence (1 sigma).
inline constexpr double kBallReflectance = 0.62, kBallReflectanceSd = 0.05;

struct BallView {
  std::array<double, 4> outline{};  // x, y, width, height of the box around the ball, pixels
  // The lens's full angle across the picture's width. Absent: the picture was cut out or its lens
  // is unknown; the camera is then taken to look at the ball's middle.
  std::optional<Radians> field_of_view;
  // From the camera to the ball's middle, in diameters of the ball, where no field of view tells;
  // absent: far away.
  std::optional<double> distance_diameters;
  double reflectance = kBallReflectance, reflectance_sd = kBallReflectanceSd;  // luminance, normal
};

// Share of unpolarised light that a polished surface sends back at an angle of incidence, by
// Fresnel's formulae. At 0 it is `normal_reflectance`, in (0, 1]: of a metal with chromium's
// n = 3.1 and the k that gives it; below .26, where no such metal is, of a dielectric.
// Source: Born and Wolf, Principles of Optics, 14.2; n: Johnson and Christy 1974 (550 nm).
[[nodiscard]] double MirrorReflectance(double normal_reflectance, Radians incidence);

// With D the camera's distance over the ball's radius, phi the angle of the ball's normal and beta
// that of the light, both from the line ball -> camera, and theta the sight's from that line:
//   theta = atan2(sin phi, D - cos phi),   beta = 2 phi + theta,
// exact for light from far away at any distance of the camera. The picture's frame is panorama.h's.
class BallMirror {
 public:
  // Refused: bad_ball (no sphere fills the box; a box that is no ball's, or leaves the picture; a
  // distance within the ball).
  static Result<BallMirror> Create(const std::string& name, int width, int height,
                                   const BallView& ball);

  struct Seen {
    std::array<double, 2> point{};  // pixel centres at .5
    double rim_share = 0.0;         // sin theta over its largest: the outline is 1
    double reflectance = 1.0;
  };
  // Absent behind the ball, and where it is seen in the last two pixels before the outline, which
  // mix it with what stands behind.
  [[nodiscard]] std::optional<Seen> See(const Vec3& direction) const;

  // Outward unit normal of the ball at the point x, y of the picture, in the picture's frame, and
  // the same share of the rim; absent off the ball.
  struct Surface {
    Vec3 normal;
    double rim_share = 0.0;
  };
  [[nodiscard]] std::optional<Surface> SurfaceAt(double x, double y) const;

  [[nodiscard]] const Vec3& axis() const { return axis_; }  // unit, camera -> ball's middle
  // Half angle around axis() of the directions that See never shows.
  [[nodiscard]] Radians BlindAngle() const { return blind_; }
  // What a pixel in the ball's middle covers of the sphere, from side to side: 2/R - 1/(R D) or so.
  [[nodiscard]] Radians Pitch() const;
  // The lens that drew the picture; without one, one that looks at the ball.
  [[nodiscard]] const PixelSolidAngles& lens() const { return lens_; }

 private:
  BallMirror(PixelSolidAngles lens, const BallView& ball, const Vec3& axis, double angle,
             bool looks_at_ball);
  [[nodiscard]] double LightAngle(double phi) const;  // beta

  PixelSolidAngles lens_;
  BallView ball_;
  Vec3 axis_;
  double angle_, distance_;  // of the outline's cone, half; D
  bool looks_at_ball_;
  double rim_share_ = 1.0;
  Radians blind_{0.0};
};

}  // namespace lightcal
