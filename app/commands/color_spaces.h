// SPDX-License-Identifier: Apache-2.0
// The RGB spaces `lightcal color` answers in, by their words in JSON and in tables: the same XYZ in
// each, and of the space whose white is not D65 also what a scene's light has.
#pragma once

#include <array>
#include <string_view>

#include "lightcal/colorimetry/rgb_spaces.h"

namespace lightcal::app {

struct NamedSpace {
  std::string_view key, title;
  RgbSpace space;
  bool of_scene = false;  // adapted from D65, as exported lights are and as OpenColorIO converts
};
inline constexpr std::array kSpaces = {
    NamedSpace{"srgb_linear", "linear sRGB at Y = 1", RgbSpace::kSrgb},
    NamedSpace{"acescg", "ACEScg at Y = 1", RgbSpace::kAcescg},
    NamedSpace{"acescg_d65", "ACEScg of a light, D65 white as in OCIO", RgbSpace::kAcescg, true},
    NamedSpace{"rec2020", "linear Rec. 2020 at Y = 1", RgbSpace::kRec2020},
    NamedSpace{"display_p3", "linear Display P3 at Y = 1", RgbSpace::kDisplayP3},
};

}  // namespace lightcal::app
