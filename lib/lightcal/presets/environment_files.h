// SPDX-License-Identifier: Apache-2.0
// The picture of a measured dome as a file, in the encodings that engines read.
#pragma once

#include <string>

#include "lightcal/core/vec3.h"
#include "lightcal/presets/environment_picture.h"
#include "lightcal/presets/light_color.h"

namespace lightcal {

// As an engine of that colour gets it. What an encoding cannot hold is cut, and how much of the
// whole luminance that was: below zero (out of the space's gamut), beyond the greatest number.
struct EncodedPicture {
  std::string bytes;
  double cut_below = 0.0, cut_above = 0.0;  // of the luminance over the sphere
  double most_nits = 0.0;
};

// A Radiance .hdr: mantissas of eight bits, rounded, for readers that take them as they are (all
// engines here but Blender before 3.6; that and Radiance add half a step, up to .4 %).
// Source: Ward, Real Pixels (1991).
[[nodiscard]] EncodedPicture RadianceFile(const EnvironmentPicture& picture,
                                          const ColorTarget& color);

// An OpenEXR of scanlines, not packed: half floats (within 1/4096), 32 bits where it is brighter
// than those hold. Nothing is cut above.   Source: OpenEXR, "OpenEXR File Layout".
[[nodiscard]] EncodedPicture ExrFile(const EnvironmentPicture& picture, const ColorTarget& color);

// IEEE 754 binary16 of 0 to 65504, rounded, its lower byte first.
void AppendHalf(double value, std::string& bytes);

// A .pfm of floats: the equal-area octahedral square of pbrt-v4's infinite lights, each texel the
// mean of what it covers, so that its sides bring what the picture's did (below .5 %).
// Source: Clarberg, Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD (2008).
[[nodiscard]] EncodedPicture EqualAreaSquare(const EnvironmentPicture& picture,
                                             const ColorTarget& color);

// The direction in which the square's (u, v) looks, both 0..1.
[[nodiscard]] Vec3 DirectionOfSquare(double u, double v);

}  // namespace lightcal
