// SPDX-License-Identifier: Apache-2.0
// Where the readings of a command come from: a meter, a tape, or a person who types what a display
// shows. What comes out is calibrated, warned about once and fit for the journal.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "console.h"
#include "lightcal/calibrate/meter_calibrations.h"
#include "lightcal/core/result.h"
#include "lightcal/records/reading.h"
#include "lightcal/records/session.h"
#include "measuring.h"
#include "meter_session.h"

namespace lightcal::app {

struct TakenReading {
  Reading reading;
  devices::Summary summary;
};

// "406.96 lx ± 9.8 %, 4995 K  key at 0.5 m  (median of 5, spread 0.1 %)" and a newline.
[[nodiscard]] std::string SayReading(const TakenReading& taken);

// `measured` in the light, place and lamp state of `frame`.
[[nodiscard]] Reading PlacedIn(const Reading& frame, const Reading& measured);

class ReadingSource {
 public:
  struct Settings {
    std::string session;  // whose meters.toml counts; "" = only the person's own
    bool typed = false;   // numbers are typed, whatever is plugged in
    MeterRequest request;
    std::vector<MeterDescription> meters{};  // of the session, by their names in a frame
    std::string to_type{};                   // the option by which a reading is typed, "" = by none
  };
  // Where no meter is plugged in and none is named, `may_type` lets the person type.
  // Fails: as MeterSession::Open and MeterCalibrations::Load.
  [[nodiscard]] static Result<ReadingSource> Open(const Settings& settings, bool may_type,
                                                  Console& console);

  // One reading in the light, place and lamp state of `frame`, measured, or asked for where there
  // is no meter. How far a meter may be off: what its setting says, else what the frame's [[meter]]
  // states, else what meters.toml states, else its driver. Where the driver of an instrument that
  // knows its own accuracy says more than its [[meter]], that counts, with the warning
  // meter_sigma.  Warnings go to the console, each once.  Fails: as TakeSummary; no_device where
  // the person types nothing.
  [[nodiscard]] Result<TakenReading> Take(const Reading& frame, const MeasuringPlan& plan,
                                          Console& console);
  // The same of what was typed already.  Wrong usage, refused: it is no reading.
  [[nodiscard]] Result<TakenReading> TakeTyped(const Reading& frame, const std::string& text,
                                               Console& console);

  // The meter in use; null while a person types.
  [[nodiscard]] MeterSession* meter() const { return meter_.get(); }
  // Whether another reading can come; false only at the end of a tape.
  [[nodiscard]] bool HasMore() const { return meter_ == nullptr || meter_->HasMore(); }
  // As MeterSession::Finish.
  [[nodiscard]] Result<void> Finish(Console& console);

 private:
  [[nodiscard]] Result<TakenReading> Finished(const Reading& frame,
                                              Result<devices::Summary> summary, Console& console);

  // The sigma of what was measured, `guess` being the driver's.
  void HearSigma(const std::string& meter, const std::optional<double>& guess,
                 devices::Summary& summary) const;

  std::unique_ptr<MeterSession> meter_;
  MeterCalibrations calibrations_;
  std::vector<MeterDescription> meters_;
  bool sigma_is_set_ = false;  // by a setting of the driver
  std::set<std::string> warned_;
};

}  // namespace lightcal::app
