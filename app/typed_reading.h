// SPDX-License-Identifier: Apache-2.0
// What a person types of a lamp, its room and the meter: "52lx@1m,card=5lx", "5,4,2.6", "hobby".
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/session.h"

namespace lightcal::app {

// "192lx@0.5m" is a reading facing the lamp; ",card=5lx" what the same place showed behind a shadow
// card, ",off=2lx" with the lamp off, ",15deg" off its axis, ",2900K" its colour temperature.
// Fails: usage. Refused: bad_reading (a distance of 0, a negative illuminance).
[[nodiscard]] Result<std::vector<Reading>> ParseTypedReading(const std::string& text,
                                                             const std::string& light);

// "5,4,2.6" (metres, a reflectance of half) or "5,4,2.6,0.7", "dark", "outdoors". Fails: usage.
[[nodiscard]] Result<void> SetRoom(const std::string& text, Session& session);

// 1 sigma of a meter by its maker's figure ("3%": 95 % of such meters) or by its class: phone 25 %,
// hobby 5 %, lab 2 %. Fails: usage.
[[nodiscard]] Result<double> SigmaOfMeter(const std::string& text);

}  // namespace lightcal::app
