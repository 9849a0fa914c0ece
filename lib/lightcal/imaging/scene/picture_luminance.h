// SPDX-License-Identifier: Apache-2.0
// A scene-linear colour picture -> luminance, by a stated convention.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/view2d.h"
#include "lightcal/records/frame.h"

namespace lightcal {

enum class LuminanceConvention {
  // L = K (y_R R + y_G G + y_B B): y from the file's chromaticities, Rec. ITU-R BT.709's where it
  // names none; K the file's whiteLuminance, 1 cd/m^2 where it names none (warned:
  // relative_scale).
  kPhotometric,
  // The same in W/(sr m^2) of light as the eye weighs it: K = 683 lm/W.
  kRadiometric,
  // Radiance's: L = 179 lm/W (.265 R + .670 G + .065 B), R, G, B in W/(sr m^2).
  // Source: Ward, Radiance color.h (WHTEFFICACY, bright()).
  kRadiance,
};

// How sure a picture in cd/m^2 is that does not say so, all in common: HDR captures are mostly
// within 20 % (95 %). Source: Inanici, Lighting Res. Technol. 38 (2006).
inline constexpr double kUnstatedScaleU95 = 0.2;
// 1 sigma of ln of a unit that nobody states, over 1 cd/m^2: within a factor of 10^4 in 95 %.
// Panoramas are published with a mean near 1, of rooms of 10^2 and of skies of 10^4 cd/m^2.
inline constexpr double kUnstatedUnitSdLn = 4.7;

struct PictureLuminance {
  int width = 0, height = 0;
  std::vector<float> nits;     // row after row
  double nits_per_unit = 1.0;  // luminance of the file's samples (1, 1, 1)
  std::string scale;           // "white_luminance" "assumed_nits" "radiometric_683" "radiance_179"
  Warnings warnings;           // relative_scale, primaries_assumed

  [[nodiscard]] View2d<const float> view() const { return {nits.data(), width, height}; }
};

// Samples are divided by the file's radiance_exposure first. Negative luminance stays.
// Refused: not_linear (sensor values, codes), no_colour (channels that are neither Y, R G B nor
// X Y Z), over_range (a luminance beyond 3e38).
[[nodiscard]] Result<PictureLuminance> LuminanceOfPicture(
    const Frame& frame, LuminanceConvention convention = LuminanceConvention::kPhotometric);

}  // namespace lightcal
