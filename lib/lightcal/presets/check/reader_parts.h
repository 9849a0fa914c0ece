// SPDX-License-Identifier: Apache-2.0
// What the readers of preset files share. They share nothing with the exporters, so that one slip
// cannot hide in both. All throw std::exception with what is wrong.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/presets/check/engine_light.h"

namespace lightcal {

// Makes it a table light with the candela of an IES or EULUMDAT file, and its luminaire's name
// where the light has none.
void TakeTable(EngineLight& light, const std::string& photometric);

// Y up to Z up.
[[nodiscard]] inline Vec3 FromYUp(const Vec3& v) { return {v[0], -v[2], v[1]}; }

// Luminance of linear Rec. 709, whose white D65 has 1. Rgb: anything of three numbers.
template <class Rgb>
[[nodiscard]] double Rec709Luminance(const Rgb& rgb) {
  return 0.2126390 * rgb[0] + 0.7151687 * rgb[1] + 0.0721923 * rgb[2];
}

// The same of the space a preset says it is written in ("acescg"); "" = Rec. 709.
[[nodiscard]] double LuminanceOfSpace(std::string_view space, const Vec3& rgb);

// Linear Rec. 709, white D65, of a colour in that space; negative where it is beyond.
[[nodiscard]] Vec3 Rec709OfSpace(std::string_view space, const Vec3& rgb);

// Throws where a light has a NaN or infinity.
void RequireFinite(const std::vector<EngineLight>& lights);
// The value; throws where it is not above 0, naming `what`.
[[nodiscard]] double Above0(const std::string& what, double value);

// The one number that a text is; throws where it is none, naming `what`.
[[nodiscard]] double OneNumber(const std::string& what, std::string_view text);
// Those of "Color(1, .5, 0, 1)" or "(1, 0, 0)", `count` and nothing else; throws as well.
[[nodiscard]] std::vector<double> NumbersOf(const std::string& what, std::string_view text,
                                            std::size_t count);

// The {...} that starts at or after `from`, by its braces.
[[nodiscard]] std::string ObjectFrom(const std::string& text, std::size_t from);

// All finite numbers in "Color(1, .5, 0, 1)" or "( (1, 0), (0, 1) )", or one alone.
[[nodiscard]] std::vector<double> NumbersIn(std::string_view text);

}  // namespace lightcal
