// SPDX-License-Identifier: Apache-2.0
// From a session on disk to fitted lights: the way `fit`, `run`, `explain` and `report` share.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "captures/ball_capture.h"
#include "console.h"
#include "lightcal/core/result.h"
#include "lightcal/records/accuracy_profile.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"
#include "lightcal/tradeoff/outcome.h"

namespace lightcal::app {

struct CalibratedSession {
  Session session;   // spectra resolved to colour (and illuminance), captures to readings
  LightFile lights;  // with provenance
};

// Seconds that each stage of a calibration took so far.
class StageClock {
 public:
  // Counts the time since the last lap for `stage`.
  void Lap(tradeoff::Stage stage);
  [[nodiscard]] const tradeoff::StageSeconds& seconds() const { return seconds_; }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  tradeoff::StageSeconds seconds_{};
};

struct CalibrationRequest {
  AccuracyProfile profile{};
  bool monte_carlo = false;     // intervals by sampling instead of the covariance
  bool full_angles = false;     // inner_deg and outer_deg are full angles, as some data sheets have
  StageClock* clock = nullptr;  // counts, where given
};

// A session whose spectra are resolved to colour (and illuminance), its captures to readings.
struct MeasuredSession {
  Session session;
  std::vector<BallPlacement> placed;  // lamps whose place mirror balls gave
};

// Loads the session, resolves `spectrum = "file"` of its readings through the importers and its
// [[capture]]s to readings. Warnings go to the console as they come up.
[[nodiscard]] Result<MeasuredSession> LoadMeasuredSession(const std::string& path,
                                                          const CalibrationRequest& request,
                                                          Console& console);

// The same, fitted, with the inputs' hashes.
[[nodiscard]] Result<CalibratedSession> CalibrateSession(const std::string& path,
                                                         const CalibrationRequest& request,
                                                         Console& console);

// Who made an output from what: the session's input files with their hashes, the newest time found
// in its readings (or SOURCE_DATE_EPOCH).  Fails as ReadWholeFile.
[[nodiscard]] Result<Provenance> ProvenanceOf(const Session& session);

// Where a session's outputs go when the person names no place: <session directory>/out.
[[nodiscard]] std::string DefaultOutputDirectory(const Session& session);

// "1%" or "0.01" -> 0.01.
[[nodiscard]] Result<double> ParseTolerance(const std::string& text);

}  // namespace lightcal::app
