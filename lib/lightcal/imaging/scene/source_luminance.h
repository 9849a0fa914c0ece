// SPDX-License-Identifier: Apache-2.0
// The picture of a lamp -> what it shines towards the camera, and from how large a face.
#pragma once

#include <cstdint>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/core/view2d.h"
#include "lightcal/imaging/panorama/panorama.h"
#include "lightcal/imaging/scene/blurred_face.h"
#include "lightcal/imaging/scene/patches.h"

namespace lightcal {

// With L what a pixel holds above the room around the lamp, Omega its solid angle and theta its
// angle from the lamp's middle:
//   E = sum of L cos(theta) Omega                [lx] at the camera, facing the lamp
//   I = sum of L Omega d^2 = sum of L cos dA     [cd] of a lamp much farther than it is large
// The luminous face are the pixels above a tenth of its bright part's mean, those on its edge by
// the share they hold of the level inside. Area, width and height are those of a plane at distance
// 1 facing the camera: multiply by d^2 and d. Of a face less than eight pixels across they are what
// the picture's blur leaves them to be (blurred_face.h); E and I hold at any size.
struct SourceLuminance {
  Lux illuminance{0.0};
  Nits luminance{0.0};               // mean of the luminous face
  double area = 0.0;                 // [m^2 / m^2]
  double width = 0.0, height = 0.0;  // sides of a rectangle of this area and these second moments
  Steradians solid_angle{0.0};       // of the luminous face
  double area_sd_relative = 0.0;
  double pixels_across = 0.0, pixels_long = 0.0;  // its sides as they are seen, blur and all
  bool resolved = true;           // false: too small for its blur, sizes and luminance tell nothing
  Vec3 direction{0.0, 1.0, 0.0};  // of its middle, in the picture's frame
  Nits background{0.0};           // median of the region's rim
  double noise_sd_relative = 0.0;  // of the illuminance, pixels taken as independent
  std::vector<std::uint8_t> face;  // by pixel of the region, row after row: 1 = luminous face
};

// sigma: 1 standard deviation of nits, as large as they are where a sample is clipped.
// Refused: bad_region, bad_view, no_source (nothing stands three times above the rim), source_cut
// (the lamp reaches the region's rim), source_clipped (part of the face is saturated in every
// frame).
[[nodiscard]] Result<SourceLuminance> MeasureSource(View2d<const float> nits,
                                                    View2d<const float> sigma,
                                                    const PixelSolidAngles& angles,
                                                    const Region& region, FaceShape shape);

}  // namespace lightcal
