// SPDX-License-Identifier: Apache-2.0
// A picture that looks somewhere: which of its pixels shows a direction of the sphere, and what.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"
#include "lightcal/core/view2d.h"
#include "lightcal/imaging/panorama/ball_mirror.h"
#include "lightcal/imaging/panorama/panorama.h"

namespace lightcal {

// Where the camera looked: yaw right of +Y, pitch above the horizon, then roll: its top leaning to
// the right. A camera tilted up to pitch 90 degrees has its picture's top towards -Y.
struct ViewAim {
  Radians yaw{0.0}, pitch{0.0}, roll{0.0};
};

// How a lens bends what its projection draws: a point at the share s of the rim (RimShare) belongs
// where the projection has s (1 + a (s^2 - 1) + b (s^4 - 1)), so that the rim and the middle stay.
// Holds while that grows with s.
struct ViewLens {
  double a = 0.0, b = 0.0;

  template <class T>
  [[nodiscard]] static T Stretch(const T& s2, const T& a, const T& b) {
    return 1.0 + a * (s2 - 1.0) + b * (s2 * s2 - 1.0);
  }
  // The share at which the picture shows what belongs at `ideal`, by Newton's steps.
  [[nodiscard]] double ShownAt(double ideal) const;
};

class AimedView {
 public:
  AimedView(PixelSolidAngles angles, const ViewAim& aim, const ViewLens& lens = {});
  // What a mirror ball shows to a camera so aimed.
  AimedView(BallMirror ball, const ViewAim& aim);

  struct Sight {
    std::array<double, 2> point{};  // of the picture
    double rim_share = 0.0;         // PixelSolidAngles::RimShare; of a ball the outline is 1
    double passed = 1.0;            // of the light: a ball's reflectance there
    double worth = 1.0;             // 0 where the camera sees itself in the ball
  };
  // Absent where PointOf is.
  [[nodiscard]] std::optional<Sight> See(const Vec3& direction) const;

  // The point of the picture (pixel centres at .5) that shows a direction of the sphere; absent
  // where it shows none, and in the last two pixels before a fisheye's rim, which darkens them.
  [[nodiscard]] std::optional<std::array<double, 2>> PointOf(const Vec3& direction) const;
  [[nodiscard]] const PixelSolidAngles& angles() const { return angles_; }
  [[nodiscard]] const std::optional<BallMirror>& ball() const { return ball_; }
  // Of the sphere: the direction through a unit vector of the picture's frame.
  [[nodiscard]] Vec3 Outward(const Vec3& v) const {
    return right_ * v[0] + forward_ * v[1] + up_ * v[2];
  }
  // The angle that a pixel's side covers where the picture is finest.
  [[nodiscard]] Radians Pitch() const;

 private:
  PixelSolidAngles angles_;
  std::optional<BallMirror> ball_;
  ViewLens lens_;
  Vec3 right_, forward_, up_;
  double rim_share_;  // of the last point taken
};

// Samples of (1, 1, 1) are `1 unit` of luminance, whatever the unit; pixels lie row after row.
struct AimedPicture {
  std::string name;  // the file, for messages
  AimedView view;
  View2d<const float> samples;            // its colours, as many channels as it has
  View2d<const float> nits;               // their luminance
  std::span<const std::uint8_t> clipped;  // by pixel; empty: none is
};

// The four pixels around a point, by number, and their bilinear weights. Across the seam of
// kLatLong; at other edges the last pixel goes on.
struct PictureTap {
  std::array<std::size_t, 4> pixel{};
  std::array<float, 4> weight{};
};
[[nodiscard]] PictureTap TapAt(const PictureView& view, const std::array<double, 2>& point);
[[nodiscard]] bool AnyClipped(const AimedPicture& picture, const PictureTap& tap);

}  // namespace lightcal
