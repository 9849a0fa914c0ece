// SPDX-License-Identifier: Apache-2.0
// Why a preset strays from the readings: what its engine lacks, or what became of the file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightcal/calibrate/calibrate_session.h"
#include "lightcal/presets/check/compare_readings.h"

namespace lightcal::app {

// Every reading against what a file's lights give of it.
[[nodiscard]] std::vector<ComparedReading> ComparedWith(const CalibratedSession& calibrated,
                                                        const std::vector<EngineLight>& lights);

// Sentences: of a file that is as this engine's is written, what the engine holds the lamps as and
// which others hold them within max_error; of any other, what writing it anew would bring.
[[nodiscard]] std::string CauseOfStraying(std::string_view preset,
                                          const CalibratedSession& calibrated,
                                          const std::vector<ComparedReading>& rows,
                                          double max_error);

}  // namespace lightcal::app
