// SPDX-License-Identifier: Apache-2.0
// What `quick` answers of one lamp: the fit, what a meter would read elsewhere, the next step.
#pragma once

#include <optional>
#include <vector>

#include "console.h"
#include "lamp_answer.h"
#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/records/session.h"
#include "match/behind_gels.h"
#include "minutes_answer.h"
#include "quick/quick_session.h"

namespace lightcal::app {

struct QuickPrediction {
  Metres distance;
  PredictedIlluminance predicted;
  std::optional<IlluminanceInRoom> in_room;
};

struct QuickAnswer {
  Session session;
  FittedSession fitted;
  std::vector<QuickPrediction> predictions;
  std::optional<BehindGels> behind;
  std::vector<LampAnswer> answers;  // of the lights in `fitted`
  std::vector<MinutesLadder> ladders;
};

// Of readings or a data sheet's figures; warnings go to the console. Writes nothing.
// Wrong usage: what cannot be read. Refused: as ParseTypedReading, FitSession, PutBehindGels.
[[nodiscard]] Result<QuickAnswer> AnswerQuick(const QuickOptions& options, Console& console);
// As light.json, and "next_step", "through", "predictions", "minutes".
[[nodiscard]] Node DocumentOf(const QuickAnswer& answer);

}  // namespace lightcal::app
