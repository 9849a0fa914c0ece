// SPDX-License-Identifier: Apache-2.0
// Linear RGB of the spaces renderers work in, derived from their primaries and white points.
#pragma once

#include <array>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/core/matrix3.h"

namespace lightcal {

enum class RgbSpace {
  kSrgb,       // IEC 61966-2-1 = Rec. ITU-R BT.709 primaries, D65
  kRec2020,    // Rec. ITU-R BT.2020, D65
  kAcescg,     // AP1 primaries, ACES white (0.32168, 0.33767): S-2014-004
  kDisplayP3,  // SMPTE EG 432-1 primaries, D65
};
inline constexpr std::array kRgbSpaces = {RgbSpace::kSrgb, RgbSpace::kRec2020, RgbSpace::kAcescg,
                                          RgbSpace::kDisplayP3};

// Linear, scene-referred, no transfer function, no clamping: colours outside the space have
// negative components (black bodies below 1900 K in sRGB, below 1063 K in Rec. 2020).
struct Rgb {
  double r = 0.0, g = 0.0, b = 0.0;
};

struct RgbPrimaries {
  Xy red, green, blue, white;
};
[[nodiscard]] RgbPrimaries PrimariesOf(RgbSpace space);

// M with XYZ = M rgb, such that rgb = (1,1,1) is the space's white at Y = 1: the columns are the
// primaries' XYZ, scaled to that sum. The exact sRGB matrix differs from IEC's four decimals
// by 3.9e-5; its last entry is 0.950532. Source: SMPTE RP 177.
[[nodiscard]] Matrix3 XyzFromRgbMatrix(RgbSpace space);
// The same of any primaries that SpanColors (a picture file's).
[[nodiscard]] Matrix3 XyzFromRgbMatrix(const RgbPrimaries& primaries);
// Whether primaries make a space: finite, not on one line, a white of positive y. A primary's
// y may be 0: those of XYZ itself are (1, 0), (0, 1), (0, 0).
[[nodiscard]] bool SpanColors(const RgbPrimaries& primaries);
[[nodiscard]] Matrix3 RgbFromXyzMatrix(RgbSpace space);

// Colorimetric (the same XYZ, no chromatic adaptation).
[[nodiscard]] Rgb LinearRgbFromXyz(const Xyz& color, RgbSpace space);
[[nodiscard]] Xyz XyzFromLinearRgb(const Rgb& color, RgbSpace space);
[[nodiscard]] inline Rgb LinearSrgbFromXyz(const Xyz& color) {
  return LinearRgbFromXyz(color, RgbSpace::kSrgb);
}
// Y of a colour: what an engine's intensity must be divided by when its light takes a colour.
[[nodiscard]] double LuminanceOfRgb(const Rgb& color, RgbSpace space);

// Chromatic adaptation of a colour seen under white `from` to the one that looks alike under `to`
// (Bradford cone responses, linear form).  Holds for y > 0 of both whites.
// Source: Lam 1985; ICC.1:2022 annex E.
[[nodiscard]] Xyz AdaptBradford(const Xyz& color, Xy from, Xy to);

// What a renderer's scene means by white unless its pipeline was neutralised to another: D65, also
// where its space has a white of its own. OpenColorIO's ACES configurations adapt what is made for
// D65 (textures in sRGB, Rec. 709, P3) to ACEScg's 6000 K by Bradford, so that 1, 1, 1 stays
// 1, 1, 1; a lamp of D65 beside them must be 1, 1, 1, too.
inline constexpr Xy kSceneWhite = {0.3127, 0.3290};
// A colour as a scene of that white holds it in the space: adapted to the space's own white.
[[nodiscard]] Xyz AdaptedToSpace(const Xyz& color, Xy scene_white, RgbSpace space);

}  // namespace lightcal
