// SPDX-License-Identifier: Apache-2.0
// The answer first, in the words of a set: candela, low … high, stops; the numbers to type; why it
// is no surer; the next step; what that is enough for.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lightcal/calibrate/calibrate_session.h"
#include "lightcal/fit/plan/next_step.h"
#include "lightcal/records/engine_answers.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"
#include "lightcal/report/report_extras.h"

namespace lightcal::app {

// One lamp's answer. `better` is what to type for advice.reading.
struct LampAnswer {
  const FittedLight* light = nullptr;
  std::string label;  // "bulb, in a room"
  std::string color;  // "2900 K as typed", "" = nothing is known of it
  std::vector<EngineFigure> figures;
  NextStepAdvice next;
  std::string better;
  std::string say_what;  // where that nobody says what lamp it is is the largest part: how to
};

struct LampQuestion {
  const LightFile* lights = nullptr;
  const Session* session = nullptr;
  std::vector<std::string> targets;  // presets asked for; none: four that most people use
  bool typed_color = false;          // the colour is what a person typed
  bool by_name = true;               // a label is the light's name; else what it is built like
  std::string fixture_words;         // how a person says what a lamp is: "add --fixture bulb"
  std::string size_words;            // and how large: "add --kind rect --size 60x30cm"
  // How a person enters the next reading of a light; "" = as SayPlannedReading says it.
  std::function<std::string(const FittedLight&, const PlannedReading&)> syntax;
  Progress progress{};
};

struct LampAnswers {
  std::vector<LampAnswer> lamps;
  EngineAnswers engines;  // of all engines, as a report shows them
};

[[nodiscard]] LampAnswers LampAnswersOf(const LampQuestion& question);

// Of a calibrated session: the next reading is a line that takes it.
[[nodiscard]] LampAnswers SessionAnswersOf(const CalibratedSession& calibrated,
                                           const std::string& path,
                                           const std::vector<std::string>& targets,
                                           const Progress& progress = {});

// What a report says of each. `session` is its name, not where it was typed to lie: the same
// session gives the same page from any folder.
[[nodiscard]] std::vector<LightAdvice> AdviceOf(const std::vector<LampAnswer>& answers,
                                                const std::string& session);

// At most ten lines of 100 columns.
[[nodiscard]] std::string LampAnswerText(const LampAnswer& answer, const Session& session);
// A row a lamp, and what to do next, alike steps together.
[[nodiscard]] std::string LampAnswersTable(const std::vector<LampAnswer>& answers);
// Either, by how many there are.
[[nodiscard]] std::string LampAnswersText(const std::vector<LampAnswer>& answers,
                                          const Session& session);

}  // namespace lightcal::app
