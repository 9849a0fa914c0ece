// SPDX-License-Identifier: Apache-2.0
// A session's whole job, done by any profile; and a synthetic twin of it: the lamps its strictest
// fit found are the truth, and every reading is made anew from them, with the noise its meter is
// said to have.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/sources.h"
#include "lightcal/tradeoff/against_truth.h"
#include "lightcal/tradeoff/outcome.h"

namespace lightcal {

// Sources for one run each: none is faster for what an earlier one read.
using OpenSources = std::function<Sources()>;

// Runs the whole job in memory, session to presets of every engine, nothing written.
[[nodiscard]] tradeoff::Runner SessionRunner(const std::string& session, const OpenSources& open);

// What one reading of the twin is made of. Twin values relative to what was read, so that what a
// profile does to the reading itself (a spectrum thinned, a picture merged at half size) stays.
struct TwinReading {
  double expected = 1.0;       // what the fitted lamps give, over what was read
  double repeatability = 0.0;  // 1 sigma, relative, of this reading alone
  double calibration = 0.0;    // 1 sigma, relative, shared by all readings of `instrument`
  std::string instrument;
};

struct SessionTwin {
  std::string path;                             // of the session
  std::vector<tradeoff::LightFigures> truth;    // of the lights whose readings are made anew
  std::map<std::string, TwinReading> readings;  // by where each is written
};

// Readings whose lamp the fit did not use, out of range ones among them, stay as they were read, as
// do chromaticities and the pixels of pictures. Refused: no_twin (several lamps lit at once, or no
// reading that a light was fitted to), and as CalibrateSession.
[[nodiscard]] Result<SessionTwin> TwinOf(const std::string& session, const Sources& sources,
                                         double tolerance_relative);

// The whole job on the twin's first readings, as SessionRunner; the twin must outlive it.
[[nodiscard]] tradeoff::Runner TwinRunner(const SessionTwin& twin, const OpenSources& open);
// The fit alone, of any replica: sessions are measured once a profile. The same.
[[nodiscard]] tradeoff::ReplicaRunner TwinReplicas(const SessionTwin& twin, const Sources& sources);

}  // namespace lightcal
