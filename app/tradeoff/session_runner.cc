// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/session_runner.h"

#include "lightcal/presets/export_presets.h"

namespace lightcal::app {

Console MutedConsole() {
  return Console({.json = true, .quiet = true, .verbose = false, .strict = false, .muted = true});
}

Result<tradeoff::Outcome> OutcomeOf(const CalibratedSession& calibrated, StageClock& clock) {
  const auto presets = ExportPresets(calibrated.lights, {}, calibrated.session.stem);
  if (!presets) return tl::unexpected(presets.error());
  clock.Lap(tradeoff::Stage::kExport);
  return tradeoff::Outcome{tradeoff::FiguresOf(calibrated.lights), clock.seconds()};
}

tradeoff::Runner SessionRunner(const std::string& session) {
  return [session](const AccuracyProfile& profile) -> Result<tradeoff::Outcome> {
    Console silent = MutedConsole();
    StageClock clock;
    auto calibrated =
        CalibrateSession(session, CalibrationRequest{profile, false, false, &clock}, silent);
    if (!calibrated) return Propagate(std::move(calibrated));
    return OutcomeOf(*calibrated, clock);
  };
}

}  // namespace lightcal::app
