// SPDX-License-Identifier: Apache-2.0
// A meter in use by a command: plugged in or played from a tape, recorded if wished, interruptible.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "console.h"
#include "lightcal_devices/meters/find_meters.h"
#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/transport/replay.h"
#include "lightcal_devices/transport/tape.h"

namespace lightcal::app {

struct MeterRequest {
  std::string device;       // an id, a driver's name, or "" = the one that is plugged in
  std::string replay_file;  // a tape instead of a device, "" = none
  std::string record_file;  // where to write a tape, "" = nowhere
  std::chrono::milliseconds reply_timeout{1000};
  std::map<std::string, std::string> settings;  // of the driver, --set name=value
};

class MeterSession {
 public:
  // Finds or loads, opens and identifies. Fails: no_device, no_permission, busy, not_found,
  // bad_tape, exists (the file to record into, which no tape may replace), and whatever the meter
  // answers.
  [[nodiscard]] static Result<std::unique_ptr<MeterSession>> Open(const MeterRequest& request,
                                                                  Console& console);
  // One measurement with its time. Ctrl-C gives the meter back and fails as interrupted; a second
  // Ctrl-C ends the program at once.
  [[nodiscard]] Result<devices::MeterReading> Measure();
  // A reading the meter keeps in its memory, from 0; its time is the meter's own, or unknown.
  [[nodiscard]] Result<devices::MeterReading> ReadMemory(int index);

  // Waits between two measurements (not where a tape is played): what the meter sends meanwhile is
  // not read later.
  void Pause(std::chrono::milliseconds time);
  // As after a pause, where a person was waited for.
  void DropBacklog();

  [[nodiscard]] bool IsReplay() const { return replay_ != nullptr; }
  // Whether the tape holds more; always so of a device.
  [[nodiscard]] bool HasMore() const { return !IsReplay() || replay_->Unconsumed() > 0; }

  // Writes the tape, also after a failure: it is what a bug report begins with. A replay that left
  // exchanges unplayed warns as tape_not_finished.
  [[nodiscard]] Result<void> Finish(Console& console);

 private:
  MeterSession(const MeterRequest& request, std::string started)
      : request_(request), time_(std::move(started)) {}
  [[nodiscard]] Result<void> OpenDevice();
  [[nodiscard]] Result<void> OpenTape();
  [[nodiscard]] Result<void> Identify(Console& console);
  void Record();
  // Wrong usage: a setting the driver does not have (lists those it has).
  [[nodiscard]] Result<void> CheckSettings() const;
  [[nodiscard]] devices::MeterSetup Setup() const;

  MeterRequest request_;
  std::string time_;  // as the tape being played says ("" = it does not); else when this began
  const devices::MeterRow* row_ = nullptr;
  std::string serial_;
  std::unique_ptr<devices::Transport> line_;
  devices::ReplayTransport* replay_ = nullptr;  // line_, when it is a tape
  devices::Tape recorded_;
  std::unique_ptr<devices::Transport> recorder_;
  std::unique_ptr<devices::Meter> meter_;
};

}  // namespace lightcal::app
