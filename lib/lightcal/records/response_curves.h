// SPDX-License-Identifier: Apache-2.0
// The curve by which a camera turned light into the codes of a JPEG or PNG, and its table as text.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"

namespace lightcal {

// Code -> signal for red, green and blue (a grey picture has the first alone), increasing; the
// highest code is signal 1.
struct ResponseCurves {
  std::array<std::vector<float>, 3> signal_of_code;
};

// A curve that has a name: "srgb" (IEC 61966-2-1, what programs write; a camera's own JPEG follows
// no standard) or "linear".
inline constexpr std::array<std::string_view, 2> kResponseWords = {"srgb", "linear"};

[[nodiscard]] bool IsResponseWord(std::string_view word);

// `word`: one of those above.
[[nodiscard]] ResponseCurves ResponseNamed(std::string_view word);

// Lines of code,red,green,blue (or code,signal for all channels) under a heading, the signals in
// any unit: codes rise from 0 or 1 to the picture's highest, in any steps, between which the signal
// is a straight line; signals rise or stay. Lines that begin with # are none.
// Refused: bad_response, with the line.
[[nodiscard]] Result<ResponseCurves> ResponseFromText(std::string_view text,
                                                      const std::string& where);
[[nodiscard]] std::string ResponseToText(const ResponseCurves& curves);

// The same curve of codes up to `top`, for `channels` channels (1 or 3): a code's share of the
// highest one decides.
[[nodiscard]] ResponseCurves ResponseOfCodes(const ResponseCurves& curves, int top, int channels);

}  // namespace lightcal
