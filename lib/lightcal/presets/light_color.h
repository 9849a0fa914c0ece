// SPDX-License-Identifier: Apache-2.0
// The colour an engine's light gets, and the luminance that colour carries.
#pragma once

#include <optional>
#include <string_view>

#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/colorimetry/srgb_encoding.h"
#include "lightcal/core/result.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal {

// The RGB space a pipeline works in, linear. With a white, the pipeline is neutralised to it: its
// pictures show that white as R = G = B, so the lamp's colour is adapted from it to the space's own
// (Bradford), luminance kept. Without one that white is D65 (kSceneWhite).
struct ColorTarget {
  RgbSpace space = RgbSpace::kSrgb;
  std::optional<Xy> white{};

  [[nodiscard]] Xy SceneWhite() const { return white.value_or(kSceneWhite); }
};
[[nodiscard]] std::string_view RgbSpaceWord(RgbSpace space);  // "rec709", "acescg", ...

// Linear RGB, in the target's space, of a lamp's chromaticity c.
//   unit_luminance  c scaled to Y = 1; components may be negative (out of gamut) or above 1
//   max_normalised  negatives clipped to 0, then divided by the largest component: in [0,1]
//   luminance       Y(max_normalised), in (0,1]
// Engines multiply intensity and colour, so what they emit is intensity * Y(colour); to emit I_v a
// light of colour max_normalised needs
//   intensity = I_v / luminance.
// Skipping the division costs .95 stop at 2700 K.   luminance_u95 is the half width of the 95 %
// interval of ln(luminance) that the lamp's CCT uncertainty leaves; absent when there is none.
struct EmittedColor {
  std::optional<Xy> xy;
  ColorTarget target{};
  Rgb unit_luminance{1.0, 1.0, 1.0};
  Rgb max_normalised{1.0, 1.0, 1.0};
  double luminance = 1.0;
  std::optional<double> luminance_u95;
};

// Chromaticity from color.xy, else from CCT and Duv; with neither, white and the warning
// color_unknown. Clipped components give the warning out_of_gamut.
[[nodiscard]] EmittedColor ColorOfLight(const FittedLight& light, const ColorTarget& target,
                                        Warnings& warnings);

}  // namespace lightcal
