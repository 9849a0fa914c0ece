// SPDX-License-Identifier: Apache-2.0
// The report page with everything that stands beside the lights, as `report` and `run` write it.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/calibrate/calibrate_session.h"
#include "lightcal/presets/environment_picture.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/report/report_extras.h"

namespace lightcal::app {

// What engines make of the lights (of those presets can export); with the pictures that domes name,
// one a light, of those too.
[[nodiscard]] ReportExtras ExtrasOf(
    const LightFile& lights,
    const std::vector<std::shared_ptr<const EnvironmentPicture>>& environments = {});
// One a light: of a lamp with controls its first state's.
[[nodiscard]] std::vector<LightSpectrum> SpectraOf(const CalibratedSession& calibrated);
// With the session's spectra and pictures. `answers`: EngineAnswersOf its lights; `sweeps`:
// ControlSweepsOf them.
[[nodiscard]] ReportExtras ExtrasOf(const CalibratedSession& calibrated, EngineAnswers answers,
                                    std::vector<ControlSweep> sweeps);

// The session's name, else its directory's.
[[nodiscard]] const std::string& TitleOf(const Session& session);

[[nodiscard]] std::string ReportHtml(const LightFile& lights, std::string_view title);
// `answers`: EngineAnswersOf its lights; `sweeps`: ControlSweepsOf them. advice: what to do next of
// each light (AdviceOf). `engines`: titles of those asked for, whose numbers are shown; none: all.
[[nodiscard]] std::string ReportHtml(const CalibratedSession& calibrated, EngineAnswers answers,
                                     std::vector<ControlSweep> sweeps,
                                     const std::vector<std::string>& engines,
                                     std::vector<LightAdvice> advice);

}  // namespace lightcal::app
