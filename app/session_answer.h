// SPDX-License-Identifier: Apache-2.0
// What `run` answers of one session, and the files that it makes of it.
#pragma once

#include <string>
#include <vector>

#include "calibration_options.h"
#include "console.h"
#include "lamp_answer.h"
#include "lightcal/calibrate/calibrate_session.h"
#include "lightcal/core/result.h"
#include "output_files.h"

namespace lightcal::app {

struct AnsweredSession {
  CalibratedSession calibrated;
  LampAnswers answers;  // of the lights in `calibrated`
};

// Warnings and notes go to the console; writes nothing.   Refused: as CalibrateSession.
[[nodiscard]] Result<AnsweredSession> AnswerSession(const CalibrationOptions& options,
                                                    const std::vector<std::string>& targets,
                                                    Console& console);
// light.json, report.html and the presets, below `directory`; not yet written.
[[nodiscard]] Result<std::vector<OutputFile>> SessionOutputs(
    const AnsweredSession& run, const std::string& directory,
    const std::vector<std::string>& targets, bool rig, Console& console);
// As light.json, and "next_steps" of each lamp that readings measured.
[[nodiscard]] Node DocumentOf(const AnsweredSession& run);

}  // namespace lightcal::app
