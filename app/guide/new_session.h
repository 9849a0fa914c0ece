// SPDX-License-Identifier: Apache-2.0
// What a person says of a lamp that is to be measured, and the session.toml it becomes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/records/session.h"

namespace lightcal::app {

struct NewSession {
  std::string directory;
  LightDescription light;
  std::optional<Kelvin> cct;         // as the box says
  std::string device;                // a connected meter, as read --device takes it; "" = typed
  double meter_sigma_relative = 0;   // 1 sigma; 0: of a connected meter, as its driver knows it
  std::vector<std::string> targets;  // engines; none = all of them
  std::optional<Room> room;
  std::string surroundings{};  // "dark" or "outdoors": no walls; "" = a room
};

// The name that a meter whose accuracy is stated has in the session.
inline constexpr const char* kTypedMeterName = "my_meter";

// A commented session.toml that ParseSessionToml reads back.
// Refused: whatever it says of names and values that cannot stand in one.
[[nodiscard]] Result<std::string> SessionText(const NewSession& session);

// The lines to type next, as a shell takes them: the guided readings, then the main job.
[[nodiscard]] std::string ReadLine(const NewSession& session);
[[nodiscard]] std::string RunLine(const NewSession& session);

}  // namespace lightcal::app
