// SPDX-License-Identifier: Apache-2.0
// What people type about pictures. `option` stands in messages.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal/imaging/bracket/shutter_check.h"
#include "lightcal/imaging/panorama/panorama.h"
#include "lightcal/imaging/scene/picture_luminance.h"

namespace lightcal::app {

inline constexpr std::array<std::string_view, 3> kConventionWords = {"photometric", "radiometric",
                                                                     "radiance"};
// One of kConventionWords.
[[nodiscard]] Result<LuminanceConvention> ParseConvention(const std::string& option,
                                                          const std::string& word);
// What --luminance-convention's help says.
inline constexpr const char* kConventionHelp =
    "photometric: Y of the file's primaries (Rec. 709) in cd/m², times its whiteLuminance; "
    "radiometric: Y in W/(sr m²), times 683 lm/W; radiance: 179 lm/W (.265 R + .670 G + .065 B)";

// One of kProjectionWords.
[[nodiscard]] Result<Projection> ParseProjection(const std::string& option,
                                                 const std::string& word);

// "2%" or "0.02": above 0 and below 1.
[[nodiscard]] Result<double> ParseShare(const std::string& option, const std::string& text);

inline constexpr std::array<std::string_view, 3> kMainsWords = {"50", "60", "none"};
// --mains, one of kMainsWords, and --pwm HZ[,DUTY], empty = not given.
[[nodiscard]] Result<LampsOnSet> ParseLamps(const std::string& mains, const std::string& pwm);

}  // namespace lightcal::app
