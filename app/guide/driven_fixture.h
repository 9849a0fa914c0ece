// SPDX-License-Identifier: Apache-2.0
// A fixture that a sweep sets by itself, and when its light stands still.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/dmx_map.h"
#include "lightcal_devices/transport/sacn.h"
#include "meter_session.h"

namespace lightcal::app {

// "1" multicasts universe 1; "1@10.0.0.5", "1@console.local:5568" unicast it. Wrong usage else.
[[nodiscard]] Result<devices::SacnTarget> ParseSacnTarget(const std::string& text);

class DrivenFixture {
 public:
  // Reads the map, tries it on every state, and only then sends the first of them.
  // Wrong usage: the map is of another universe. Refused: as DmxMapFromToml and SlotsAt. Fails: as
  // SacnSender::Open, and unheard.
  [[nodiscard]] static Result<DrivenFixture> Open(const std::string& sacn,
                                                  const std::string& map_file,
                                                  const std::string& session,
                                                  const std::vector<FixtureState>& states);
  // Sends it from now on. Refused: as SlotsAt. Fails: unheard.
  [[nodiscard]] Result<void> Set(const FixtureState& state);
  // Fails: unheard, io, since the last state was set.
  [[nodiscard]] Result<void> Trouble() const { return sender_->Trouble(); }
  [[nodiscard]] const DmxMap& map() const { return map_; }
  [[nodiscard]] int universe() const { return universe_; }
  [[nodiscard]] const std::string& address() const { return sender_->address(); }

 private:
  DmxMap map_;
  int universe_ = 1;
  std::unique_ptr<devices::SacnSender> sender_;
};

// What is asked of light that stands still.
struct SteadyRule {
  double change_relative = 0.01;    // over the last half second and six readings
  std::optional<double> before_lx;  // of the state before: unchanged light may not yet have moved
  std::chrono::milliseconds limit{15000};
};

// Measures until the light stands still; a tape is read on its own time. False: it still moved at
// the limit. Fails: as MeterSession::Measure.
[[nodiscard]] Result<bool> WaitUntilSteady(MeterSession& meter, const SteadyRule& rule);

}  // namespace lightcal::app
