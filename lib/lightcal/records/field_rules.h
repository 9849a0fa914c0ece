// SPDX-License-Identifier: Apache-2.0
// What a number in a file must satisfy, with the words that say so. Internal to the records room.
#pragma once

#include <string>
#include <string_view>

#include "lightcal/colorimetry/chromaticity.h"

namespace lightcal::records {

struct NumberRule {
  bool (*holds)(double value);  // asked of finite values only
  std::string_view demand;      // follows "key = value: " in messages
};

inline constexpr NumberRule kAnyNumber{[](double) { return true; }, "must be a finite number"};
inline constexpr NumberRule kPositive{[](double v) { return v > 0.0; }, "must be above 0"};
inline constexpr NumberRule kNotNegative{[](double v) { return v >= 0.0; }, "must not be negative"};
inline constexpr NumberRule kDistanceRule{
    [](double v) { return v > 0.0; },
    "must be above 0: metres from the lamp's reference point to the meter"};
inline constexpr NumberRule kIlluminanceRule{
    [](double v) { return v >= 0.0; },
    "must not be negative: give lux as the meter displayed it, ambient light included"};
inline constexpr NumberRule kSigmaRule{[](double v) { return v > 0.0 && v < 1.0; },
                                       "must lie between 0 and 1: 0.05 means 5 %, 1 sigma"};
inline constexpr NumberRule kErrorFractionRule{[](double v) { return v >= 0.0 && v < 1.0; },
                                               "must be a fraction from 0 to below 1: 0.03 is 3 %"};
inline constexpr NumberRule kDepthRule{
    [](double v) { return v >= 0.0 && v <= 1.0; },
    "must lie between 0 and 1: (largest - least)/(largest + least) light of a period"};
inline constexpr NumberRule kDutyRule{[](double v) { return v > 0.0 && v <= 1.0; },
                                      "must be above 0, up to 1: the lit part of a period"};
inline constexpr NumberRule kReflectanceRule{[](double v) { return v >= 0.0 && v < 1.0; },
                                             "must be a fraction from 0 to below 1"};
inline constexpr NumberRule kCardRule{[](double v) { return v > 0.0 && v <= 1.0; },
                                      "must be a fraction above 0, up to 1: 0.18 is a grey card"};
inline constexpr NumberRule kTiltRule{
    [](double v) { return v > -90.0 && v < 90.0; },
    "must lie between -90 and 90 degrees: a meter turned further does not see the lamp"};
inline constexpr NumberRule kOffAxisRule{[](double v) { return v > -180.0 && v < 180.0; },
                                         "must lie between -180 and 180 degrees from the lamp's "
                                         "axis; the sign tells its two sides apart"};
inline constexpr NumberRule kHalfAngleRule{[](double v) { return v >= 0.0 && v <= 180.0; },
                                           "must be a half angle from 0 to 180 degrees"};
inline constexpr NumberRule kFullAngleRule{[](double v) { return v > 0.0 && v <= 360.0; },
                                           "must be a full angle above 0, up to 360 degrees"};

// What is wrong with one value, with the key before it; empty where nothing is.
[[nodiscard]] std::string FaultOfNumber(std::string_view key, double value, const NumberRule& rule);
[[nodiscard]] std::string FaultOfText(std::string_view key, std::string_view value);
// A real colour has x >= 0, y > 0, x + y <= 1.
[[nodiscard]] std::string FaultOfChromaticity(std::string_view key, Xy xy);

}  // namespace lightcal::records
