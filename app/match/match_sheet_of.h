// SPDX-License-Identifier: Apache-2.0
// What a camera sees of a lamp, of the light it is to match, and of the lamp behind its best gels.
#pragma once

#include <string>
#include <vector>

#include "console.h"
#include "lightcal/match/match_lights.h"
#include "lightcal/report/match_sheet.h"
#include "match/match_source.h"

namespace lightcal::app {

// The lamp, the target and the cameras; all else as it comes.
[[nodiscard]] match::MatchRequest RequestBetween(const MatchLight& lamp, const MatchLight& target,
                                                 std::vector<CameraSensitivities> cameras);

// gels: the stack's title.   Refused: as match::ViewMatch.
[[nodiscard]] Result<report::MatchSheet> SheetOf(const match::MatchRequest& request,
                                                 const match::Match& match, const std::string& gels,
                                                 const MatchLight& lamp, const MatchLight& target);

// What one page asks for all of its lamps.
struct CameraViewWords {
  std::string target;               // as MatchLightWords::source
  std::string gels;                 // a gel file, "" = the demonstration filters
  std::string camera = "observer";  // as ReadCameras
};
// The sheets of lamps, each with the match that comes first.   Refused: as match::MatchLights, and
// whatever words name that is not there.
[[nodiscard]] Result<std::vector<report::MatchSheet>> SheetsOf(const std::vector<MatchLight>& lamps,
                                                               const CameraViewWords& words,
                                                               Console& console);

}  // namespace lightcal::app
