// SPDX-License-Identifier: Apache-2.0
// What `quick` was asked, and the session in memory that it makes of one lamp.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/session.h"
#include "minutes_answer.h"

namespace lightcal::app {

struct QuickOptions {
  std::vector<std::string> readings;
  std::string name = "light";
  std::string kind;
  std::string cct, duv, diameter, size, length, radius, fixture, room, meter, sigma, beam, field,
      lumens, watts, inner, outer;
  std::vector<std::string> predict_at;
  std::vector<std::string> targets;
  std::string output = "lightcal-quick";
  std::string gel, gels, spectrum;
  std::string table, columns;
  bool full_angles = false;
  bool rig = false;
  bool bare = false;  // what is done anyway
  bool force = false;
  bool plan = false;
  MinutesOptions minutes;
};

inline constexpr std::array<std::string_view, 7> kQuickKinds = {
    "point", "spot", "sphere", "disk", "rect", "tube", "directional"};

// Wrong usage: what cannot be read. Refused as ParseTypedReading.
[[nodiscard]] Result<Session> SessionFromOptions(const QuickOptions& options);

// 1 sigma of a reading as it was typed, or by what the meter's maker says; absent where neither is.
[[nodiscard]] Result<std::optional<double>> SigmaAsked(const QuickOptions& options);

}  // namespace lightcal::app
