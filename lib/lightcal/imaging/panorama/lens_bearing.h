// SPDX-License-Identifier: Apache-2.0
// Where a point of a picture lies, seen by its camera, for lenses that are being fitted.
#pragma once

#include <array>
#include <cmath>

#include "lightcal/core/vec3.h"
#include "lightcal/imaging/panorama/aimed_picture.h"
#include "lightcal/imaging/panorama/panorama.h"

namespace lightcal {

// Where RimShare is 1, in pixels from the middle: the corner of a rectilinear picture, a fisheye's
// circle.
[[nodiscard]] inline double RimPixels(const PictureView& view) {
  if (view.projection == Projection::kRectilinear) {
    return std::hypot(view.width, view.height) / 2.0;
  }
  return (view.width < view.height ? view.width : view.height) / 2.0;
}

// f [pixels] of r = f tan theta, f theta, 2 f sin(theta/2), and the field of view that PictureView
// means by it.   Hold for every projection but kLatLong, which has none.
[[nodiscard]] double FocalOf(const PictureView& view);
[[nodiscard]] Radians FieldOfViewOf(const PictureView& view, double focal_px);

// The direction (right, forward, up) of unit length through a point, pixel centres at .5; T is
// double or an automatic-differentiation scalar. view.field_of_view is not read.
template <class T>
[[nodiscard]] Vec3Of<T> BearingOf(const PictureView& view, const std::array<double, 2>& point,
                                  const T& focal_px, const T& a, const T& b) {
  using std::asin;
  using std::cos;
  using std::sin;
  using std::sqrt;
  constexpr double kNoRadius = 1e-9;
  const double right = point[0] - view.width / 2.0, up = view.height / 2.0 - point[1];
  const double r = std::hypot(right, up), share = r / RimPixels(view);
  const T stretch = ViewLens::Stretch(T(share * share), a, b);
  if (view.projection == Projection::kRectilinear) {
    const T x = right * stretch, y = up * stretch;
    const T length = sqrt(x * x + y * y + focal_px * focal_px);
    return {x / length, focal_px / length, y / length};
  }
  const T ideal = (r + kNoRadius) * stretch;
  const T half = ideal / (2.0 * focal_px);
  T theta = 2.0 * half;
  if (view.projection == Projection::kEquisolid && half < 1.0) theta = 2.0 * asin(half);
  const T aside = sin(theta) / (r + kNoRadius);
  return {right * aside, cos(theta), up * aside};
}

}  // namespace lightcal
