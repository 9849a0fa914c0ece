// SPDX-License-Identifier: Apache-2.0
#include "quick/quick_answer.h"

#include <cmath>
#include <utility>

#include "engine_colors.h"
#include "lamp_words.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal/match/gelled_light.h"
#include "lightcal/records/light_codec.h"
#include "output_files.h"

namespace lightcal::app {
namespace {

Result<std::vector<QuickPrediction>> Predict(const QuickOptions& options,
                                             const FittedLight& light) {
  std::vector<QuickPrediction> predictions;
  const auto asked = SigmaAsked(options);
  if (!asked) return tl::unexpected(asked.error());
  const double sigma = asked->value_or(kSigmaUnnamedMeter);
  for (const std::string& text : options.predict_at) {
    const auto distance = ParseLength(text);
    if (!distance) return tl::unexpected(distance.error());
    auto predicted = PredictIlluminance(light, *distance, sigma);
    if (!predicted) return Propagate(std::move(predicted));
    auto in_room = PredictInRoom(light, *distance, sigma);
    if (!in_room) return Propagate(std::move(in_room));
    predictions.push_back({*distance, *predicted, *std::move(in_room)});
  }
  return predictions;
}

// The fitted light behind its gels. Without a spectrum its colour stands for a black body or
// daylight, which is said.
Result<BehindGels> PutGelBefore(const QuickOptions& options, FittedLight& light, Console& console) {
  MatchLightWords words;
  words.source = options.spectrum;
  if (options.spectrum.empty()) {
    if (!light.color.cct_K) {
      return Refused("no_spectrum", "--gel",
                     "what a gel makes of a lamp depends on its spectrum; give --spectrum FILE, or "
                     "at least --cct 3200K");
    }
    words.source = ShortestText(std::round(light.color.cct_K->value)) + "K";
    console.Warn({"spectrum_assumed", "--gel",
                  "a black body or daylight of " + words.source +
                      " stands for the lamp; give its own with --spectrum FILE"});
  }
  auto lamp = ReadMatchLight(words, console);
  if (!lamp) return Propagate(std::move(lamp));
  auto behind = PutBehindGels(lamp->spectrum, lamp->measured, options.gel, options.gels, console);
  if (!behind) return Propagate(std::move(behind));
  if (behind->size() != 1) return WrongUsage("--gel", "name one gel, or a stack: L204+L298");
  light = match::LightBehind(light, behind->front().match);
  light.in_room.clear();  // of the lamp without it
  return std::move(behind->front());
}

// "20lx@2m,card=LUX": the reading a person typed there, and what to add to it.
std::string TypedStep(const Session& session, const PlannedReading& step) {
  std::string before;
  for (const SessionReading& row : session.readings) {
    const bool there = row.reading.distance == step.distance &&
                       row.reading.off_axis == step.off_axis.value_or(Radians(0.0));
    if (IsLit(row.reading) && there) before = row.where;
  }
  const std::string metres =
      step.distance ? ShortestText(std::round(step.distance->value() * 1000.0) / 1000.0) : "";
  const std::string at = metres + " m";
  switch (step.action) {
    case PlannedAction::kShadowCard:
      return "block the direct beam at " + at + " with a card, type what is left: " + before +
             ",card=LUX";
    case PlannedAction::kLampOff:
      return "switch the lamp off, type what is left: " +
             (session.readings.empty() ? before : session.readings.back().where) + ",off=LUX";
    case PlannedAction::kRead:
      break;
  }
  const std::string degrees = step.off_axis ? DegreesText(*step.off_axis) : "";
  const std::string place =
      degrees.empty() ? "read at " + at : "read " + degrees + " degrees off the axis, at " + at;
  return place + (before.empty() ? " too, facing the lamp" : " once more") + ": add LUX@" + metres +
         "m" + (degrees.empty() ? "" : "," + degrees + "deg");
}

std::vector<LampAnswer> AnswersOf(const QuickOptions& options, const Session& session,
                                  const LightFile& lights, bool gelled) {
  LampQuestion question;
  question.lights = &lights;
  question.session = &session;
  question.targets = options.targets;
  question.typed_color = !gelled;
  question.by_name = options.name != QuickOptions().name;
  question.fixture_words = "add --fixture bulb";
  question.size_words = "add --kind rect --size 60x30cm";
  question.syntax = [&](const FittedLight&, const PlannedReading& step) {
    return TypedStep(session, step);
  };
  return LampAnswersOf(question).lamps;
}

}  // namespace

Result<QuickAnswer> AnswerQuick(const QuickOptions& options, Console& console) {
  QuickAnswer answer;
  auto session = SessionFromOptions(options);
  if (!session) return Propagate(std::move(session));
  answer.session = *std::move(session);
  const auto wishes = LadderWishesOf(options.minutes);
  if (!wishes) return tl::unexpected(wishes.error());
  auto fitted = FitSession(answer.session, FitSettings{});
  if (!fitted) return Propagate(std::move(fitted));
  answer.fitted = *std::move(fitted);
  LightFile& lights = answer.fitted.lights;
  lights.provenance.generator = GeneratorName();
  if (!options.gel.empty()) {
    auto put = PutGelBefore(options, lights.lights.front(), console);
    if (!put) return Propagate(std::move(put));
    answer.behind = *std::move(put);
  }
  auto predictions = Predict(options, lights.lights.front());
  if (!predictions) return Propagate(std::move(predictions));
  answer.predictions = *std::move(predictions);
  if (const auto json = LightFileToJson(lights); !json) return tl::unexpected(json.error());
  console.Warn(answer.fitted.warnings);
  answer.answers = AnswersOf(options, answer.session, lights, answer.behind.has_value());
  if (options.plan) answer.ladders = LaddersOf(answer.session, {}, *wishes);
  return answer;
}

Node DocumentOf(const QuickAnswer& answer) {
  Node document = DocumentOf(answer.fitted.lights);
  document.Put("next_step", answer.answers.front().next.say);
  document.Put("type_in",
               Node::UnlessEmpty(Node::List(answer.answers.front().figures, TypeInNode)));
  if (answer.behind) document.Put("through", ThroughNode(*answer.behind));
  const auto prediction = [](const QuickPrediction& p) -> Node {
    Node node = {{"distance_m", p.distance},
                 {"model_lx", DocumentOf(p.predicted.model_lx)},
                 {"reading_lx", DocumentOf(p.predicted.reading_lx)}};
    if (p.in_room) {
      node.Put("in_room_lx", DocumentOf(p.in_room->whole_lx));
      node.Put("in_room_reading_lx", DocumentOf(p.in_room->reading_lx));
      node.Put("walls_lx", DocumentOf(p.in_room->walls_lx));
    }
    return node;
  };
  document.Put("predictions", Node::UnlessEmpty(Node::List(answer.predictions, prediction)));
  document.Put("minutes", Node::UnlessEmpty(Node::List(answer.ladders, MinutesNode)));
  return document;
}

}  // namespace lightcal::app
