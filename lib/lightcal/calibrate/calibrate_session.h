// SPDX-License-Identifier: Apache-2.0
// A session -> fitted lights: readings, spectra, photometric files, captures and walls, all of it.
#pragma once

#include <string>
#include <vector>

#include "lightcal/calibrate/captures/ball_capture.h"
#include "lightcal/calibrate/evidence.h"
#include "lightcal/core/processor_time.h"
#include "lightcal/core/progress.h"
#include "lightcal/core/result.h"
#include "lightcal/records/accuracy_profile.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"
#include "lightcal/records/sources.h"
#include "lightcal/tradeoff/outcome.h"

namespace lightcal {

// Seconds of processor time that each stage of a calibration took so far.
class StageClock {
 public:
  // Counts the time since the last lap for `stage`.
  void Lap(tradeoff::Stage stage);
  [[nodiscard]] const tradeoff::StageSeconds& seconds() const { return seconds_; }

 private:
  double last_ = ProcessorSeconds();
  tradeoff::StageSeconds seconds_{};
};

struct CalibrationSettings {
  AccuracyProfile profile{};
  bool monte_carlo = false;     // intervals by sampling instead of the covariance
  bool full_angles = false;     // inner_deg and outer_deg are full angles, as some data sheets have
  std::string time{};           // of provenance, ISO 8601; "" = the newest among the readings
  StageClock* clock = nullptr;  // counts, where given
  bool time_effects = false;    // effects' cost_ns measured here and now, not as declared
  std::vector<std::string> lights{};   // these alone of the session's, empty = all
  std::vector<std::string> without{};  // all but these
  Progress progress{};                 // of sampling intervals
};

// What the person should know of an answer, in the order it was found.
struct Remarks {
  Warnings warnings;
  std::vector<std::string> notes;
};

// A refusal and what was found before it, which may say why.
struct CalibrationRefusal : Error {
  Remarks remarks;
  std::vector<std::string> sound{};  // lights that nothing is wrong with, where it is of others
};
template <class T>
using Calibrated = tl::expected<T, CalibrationRefusal>;

// A session as it was measured: spectra resolved to colour (and illuminance), photometric files to
// distributions, pictures to readings.
struct MeasuredSession {
  Session session;
  std::vector<BallPlacement> placed;  // lamps whose place mirror balls gave
  std::vector<NamedSpectrum> spectra;
  std::vector<RecordedPicture> pictures;
  Remarks remarks;
};

struct CalibratedSession {
  Session session;                        // as measured
  LightFile lights;                       // with provenance
  std::vector<NamedSpectrum> spectra;     // one a light that has any
  std::vector<RecordedPicture> pictures;  // made small, in the order they were measured
  Remarks remarks;
};

// Loads a session and measures everything but walls, whose lights are measured with the fit.
// Refused: unknown_light (of settings.lights, without), and as LoadSession, ReadSpectra,
// WithDistributions, PlaceByBalls, ReadCaptures.
[[nodiscard]] Calibrated<MeasuredSession> MeasureSession(const std::string& path,
                                                         const Sources& sources,
                                                         const CalibrationSettings& settings);

// Lights that walls measured, and all others fitted to their readings, in the session's order, with
// the hashes of all files read.   Refused: as MeasureWalls, FitSession.
[[nodiscard]] Calibrated<CalibratedSession> FitMeasured(MeasuredSession measured,
                                                        const Sources& sources,
                                                        const CalibrationSettings& settings);

// Both, one after the other.
[[nodiscard]] Calibrated<CalibratedSession> CalibrateSession(const std::string& path,
                                                             const Sources& sources,
                                                             const CalibrationSettings& settings);

// Who made an output from what: the session's input files with their hashes, and `time`, where that
// is empty the newest of its readings.  Fails: not_found, unreadable.
[[nodiscard]] Result<Provenance> ProvenanceOf(const Session& session, const Sources& sources,
                                              const std::string& time);

}  // namespace lightcal
