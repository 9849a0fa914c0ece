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
#include "lightcal/imaging/panorama/panorama.h"

namespace lightcal {

// Where the camera looked: yaw right of +Y, pitch above the horizon, then roll: its top leaning to
// the right. A camera tilted up to pitch 90 degrees has its picture's top towards -Y.
struct ViewAim {
  Radians yaw{0.0}, pitch{0.0}, roll{0.0};
};

class AimedView {
 public:
  AimedView(PixelSolidAngles angles, const ViewAim& aim);

  // The point of the picture (pixel centres at .5) that shows a direction of the sphere; absent
  // where it shows none, and in the last two pixels before a fisheye's rim, which darkens them.
  [[nodiscard]] std::optional<std::array<double, 2>> PointOf(const Vec3& direction) const;
  [[nodiscard]] const PixelSolidAngles& angles() const { return angles_; }

 private:
  PixelSolidAngles angles_;
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
