// SPDX-License-Identifier: Apache-2.0
// What a person types of a lamp, its size, its room and the meter: "52lx@1m,card=5lx", "120x60cm",
// "5,4,2.6", "hobby".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/session.h"

namespace lightcal::app {

// The pieces between separators: one more than there are separators, blanks kept.
[[nodiscard]] std::vector<std::string> SplitAt(std::string_view text, char separator);

// "192lx@0.5m" is a reading facing the lamp; ",card=5lx" what the same place showed behind a shadow
// card, ",off=2lx" with the lamp off, ",15deg" off its axis, ",2900K" its colour temperature.
// Fails: usage. Refused: bad_reading (a distance of 0, a negative illuminance).
[[nodiscard]] Result<std::vector<Reading>> ParseTypedReading(const std::string& text,
                                                             const std::string& light);

// "6m", "6x4m", "5,4,2.6": lengths between `separator`s; the last one's unit stands for bare ones.
[[nodiscard]] Result<std::vector<double>> ParseLengths(const std::string& option,
                                                       const std::string& text, char separator);

// So many lengths above zero ("120x60cm", "5,4,2.6"), or none of an empty text. Fails: usage, with
// the example.
[[nodiscard]] Result<std::vector<double>> ParseSides(const std::string& text, std::size_t count,
                                                     const std::string& example);

// The colour temperature of a lamp. Refused: bad_reading (what no lamp has: below
// 1000 K, above 100 000 K).
[[nodiscard]] Result<Kelvin> ParseLampTemperature(const std::string& text);

// How far a light's colour lies from the black body's, in u, v of 1960. Refused: bad_reading
// (beyond .1, which is no lamp's).
[[nodiscard]] Result<double> ParseDuv(const std::string& text);

// "5,4,2.6" (metres, a reflectance of half) or "5,4,2.6,0.7", "dark", "outdoors". Fails: usage.
[[nodiscard]] Result<void> SetRoom(const std::string& text, Session& session);

// 1 sigma of a meter by its maker's figure ("3%": 95 % of such meters) or by its class: phone 25 %,
// hobby 5 %, lab 2 %. Fails: usage.
[[nodiscard]] Result<double> SigmaOfMeter(const std::string& text);

}  // namespace lightcal::app
