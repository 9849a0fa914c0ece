// SPDX-License-Identifier: Apache-2.0
#include "color_words.h"

#include <array>
#include <string_view>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/illuminants.h"
#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"

namespace lightcal::app {

Result<Xy> ParseWhite(const std::string& option, const std::string& text) {
  if (const auto comma = text.find(','); comma != std::string::npos) {
    const auto x = ParseNumber(TrimBlanks(std::string_view(text).substr(0, comma)));
    const auto y = ParseNumber(TrimBlanks(std::string_view(text).substr(comma + 1)));
    if (!x || !y) return WrongUsage(option, "\"" + text + "\" is not x,y");
    if (CctFromXy({*x, *y}).status == CctStatus::kNotAChromaticity) {
      return Refused("bad_chromaticity", option, "no light has this chromaticity");
    }
    return Xy{*x, *y};
  }
  if (const auto kelvin = ParseTemperature(text)) {
    if (kelvin->value() >= 400.0) return XyFromCct(*kelvin);
    return Refused("out_of_range", option, "a white below 400 K is none");
  }
  const auto spectrum = IlluminantSpectrum(text);
  const auto xyz = spectrum ? XyzFromSpectrum(*spectrum) : Result<Xyz>(Xyz{});
  if (!spectrum || !xyz) {
    return WrongUsage(option, "\"" + text +
                                  "\" is no white; give x,y, a temperature such as 3200K or an "
                                  "illuminant such as D65");
  }
  return XyFromXyz(*xyz);
}

Result<RgbSpace> ParseSpace(const std::string& option, const std::string& text) {
  constexpr std::array<RgbSpace, kSpaceWords.size()> kSpaces = {
      RgbSpace::kSrgb, RgbSpace::kSrgb, RgbSpace::kAcescg, RgbSpace::kRec2020,
      RgbSpace::kDisplayP3};
  for (std::size_t i = 0; i < kSpaceWords.size(); ++i) {
    if (kSpaceWords[i] == text) return kSpaces[i];
  }
  return WrongUsage(option, "\"" + text + "\" is no space; rec709, acescg, rec2020 or p3");
}

Result<ColorWords> ParseColorWords(const std::string& space, const std::string& white) {
  ColorWords words;
  if (!space.empty()) {
    const auto parsed = ParseSpace("--space", space);
    if (!parsed) return tl::unexpected(parsed.error());
    words.space = *parsed;
  }
  if (!white.empty()) {
    const auto parsed = ParseWhite("--white", white);
    if (!parsed) return tl::unexpected(parsed.error());
    words.white = *parsed;
  }
  return words;
}

}  // namespace lightcal::app
