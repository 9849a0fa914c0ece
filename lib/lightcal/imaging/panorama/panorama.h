// SPDX-License-Identifier: Apache-2.0
// Which part of the sphere each pixel sees. The picture's frame is right-handed with Z up: its
// centre looks along +Y, its right side is +X.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"
#include "lightcal/records/projection.h"

namespace lightcal {

// "rect", "latlong", "equidistant", "equisolid"; absent for other words.
[[nodiscard]] std::optional<Projection> ProjectionByName(std::string_view name);

// theta, below, is the angle from the axis: the optical axis, for kLatLong the zenith, which is the
// picture's upper edge.
struct PictureView {
  Projection projection = Projection::kRectilinear;
  int width = 0, height = 0;
  // Full angle: across the width of a rectilinear picture; across the image circle of a fisheye
  // one, which touches the shorter sides. Of no meaning for kLatLong.
  Radians field_of_view{0.0};
};

// Solid angles of pixels, as areas of pixels and not of their centres.
class PixelSolidAngles {
 public:
  // Refused: bad_view (an empty picture; a field of view outside (0, 180) degrees for rect,
  // (0, 360] for fisheyes; a lat-long picture that is not twice as wide as high within 1 %).
  static Result<PixelSolidAngles> Create(const PictureView& view);

  // Omega = integral of dOmega over the pixel [sr]; 0 outside the image circle, part of it on its
  // rim. Exact (closed form) but for kEquidistant, where the rule errs by less than 1e-7, and for
  // pixels on a rim, which are sampled 16 x 16 times.
  [[nodiscard]] double SolidAngle(int x, int y) const;
  // Integral of cos(theta) dOmega over the part of the pixel with theta < 90 degrees: the weight of
  // its luminance in the illuminance of the plane that faces the axis. The whole hemisphere gives
  // pi.
  [[nodiscard]] double ProjectedSolidAngle(int x, int y) const;
  // Unit vector through the point (x, y) of the picture, pixel centres being at .5. The axis of
  // fisheyes is +Y. Absent outside the image circle.
  [[nodiscard]] std::optional<Vec3> Direction(double x, double y) const;
  // The point x, y that looks along a unit vector; absent where the picture does not show it.
  [[nodiscard]] std::optional<std::array<double, 2>> PointOf(const Vec3& direction) const;
  // Distance from the middle as a share of the farthest the picture shows: what a lens's fall-off
  // depends on. 0 for kLatLong, which no lens drew.
  [[nodiscard]] double RimShare(double x, double y) const;
  // The angle that a pixel's side covers in the middle (for kLatLong: on the equator).
  [[nodiscard]] Radians MiddlePitch() const;

  [[nodiscard]] const PictureView& view() const { return view_; }

 private:
  enum class Weight { kPlain, kCosine };
  explicit PixelSolidAngles(const PictureView& view);
  [[nodiscard]] double LatLongRow(int y, Weight weight) const;
  [[nodiscard]] double Rectilinear(int x, int y, Weight weight) const;
  [[nodiscard]] double Fisheye(int x, int y, Weight weight) const;
  [[nodiscard]] double SmoothMean(double r, Weight weight) const;
  [[nodiscard]] double Density(double r2, Weight weight) const;
  [[nodiscard]] double FisheyeTheta(double r) const;

  PictureView view_;
  double focal_px_ = 1.0;  // f, in pixels
  double rim_px_ = 0.0;    // radius of the image circle
  double front_px_ = 0.0;  // radius at which theta is 90 degrees
  std::vector<double> row_plain_, row_cosine_;
};

}  // namespace lightcal
