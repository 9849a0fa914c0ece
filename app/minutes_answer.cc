// SPDX-License-Identifier: Apache-2.0
#include "minutes_answer.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <utility>

#include "console.h"
#include "joint_progress.h"
#include "lightcal/core/interval_text.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/parallel.h"
#include "lightcal/core/units_text.h"
#include "lightcal/report/minutes_figure.h"
#include "picture_file.h"

namespace lightcal::app {
namespace {

std::string LeftAfter(const PlannedReading& reading) {
  return RelativeText(IntervalOfWidths(reading.u95_relative, reading.u95_stops));
}
// "" before any reading.
std::string Now(const MinutesLadder& ladder) {
  return ladder.u95_relative
             ? RelativeText(IntervalOfWidths(*ladder.u95_relative, ladder.u95_stops))
             : "";
}

const char* WordOf(PlannedAction action) {
  if (action == PlannedAction::kShadowCard) return "shadow_card";
  return action == PlannedAction::kLampOff ? "lamp_off" : "read";
}

Result<void> SetMinutes(const std::string& part, MeasuringMinutes& minutes) {
  const auto sign = part.find('=');
  const std::string word = part.substr(0, sign);
  double* const target = word == "reading" ? &minutes.reading
                         : word == "card"  ? &minutes.card
                         : word == "move"  ? &minutes.move
                                           : nullptr;
  const auto number = ParseNumber(sign == std::string::npos ? "" : part.substr(sign + 1));
  const double count = number.value_or(-1.0);
  if (!(count >= 0.0) || target == nullptr) {
    return WrongUsage("--minutes " + part,
                      "is no time of a step; write reading=2,card=1,move=3, in minutes");
  }
  *target = count;
  return {};
}

std::string Minutes(double count) {
  return ShortestText(count) + (count == 1.0 ? " minute" : " minutes");
}

std::string StepMark(const LadderStep& step) { return step.meter_limits ? "the meter" : ""; }

// The first step from which on the meter is the limit; null where it is none.
const LadderStep* MeterStep(const MinutesLadder& ladder) {
  for (const LadderStep& step : ladder.steps) {
    if (step.meter_limits) return &step;
  }
  return nullptr;
}

std::string Sentence(const MinutesLadder& ladder) {
  const double meter = ladder.meter_u95_relative;
  const std::string own = "the meter's own " + RelativeText(IntervalOfFactor(meter));
  if (ladder.steps.empty()) {
    const std::string now = ladder.u95_relative ? " (" + Now(ladder) + ")" : "";
    return ladder.light + ": no reading within reach would take 2 % off what is left" + now +
           (meter > 0.0 ? "; " + own + " stays however often it reads" : "") + ".";
  }
  const LadderStep& first = ladder.steps.front();
  const LadderStep& last = ladder.steps.back();
  std::string text = ladder.light + ": ";
  text += ladder.u95_relative ? "now " + Now(ladder) + "; " : "";
  text += Minutes(first.total_minutes) + " (" + first.say + ")" +
          (first.total_minutes == 1.0 ? " leaves " : " leave ") + LeftAfter(first.reading);
  if (&first != &last) {
    text += ", " + Minutes(last.total_minutes) + " " + LeftAfter(last.reading);
  }
  if (const LadderStep* at = MeterStep(ladder)) {
    text += "; from minute " + ShortestText(at->total_minutes) + " on " + own +
            " is most of what is left: only a better meter helps";
  }
  return text + ".";
}

}  // namespace

void AddMinutesOptions(CLI::App& parser, MinutesOptions& options) {
  parser.add_option("--minutes", options.minutes,
                    "Minutes a person takes for each step [reading=2,card=1,move=3]");
  parser.add_option("--reach", options.reach, "How far from the lamp a meter can stand")
      ->capture_default_str();
  parser.add_option("--plot", options.plot, "Accuracy against minutes as a picture")
      ->type_name("FILE.svg|png");
}

Result<LadderWishes> LadderWishesOf(const MinutesOptions& options) {
  LadderWishes wishes;
  std::string rest = options.minutes;
  while (!rest.empty()) {
    const auto comma = rest.find(',');
    if (auto set = SetMinutes(rest.substr(0, comma), wishes.minutes); !set) {
      return Propagate(std::move(set));
    }
    rest = comma == std::string::npos ? "" : rest.substr(comma + 1);
  }
  const auto reach = ParseLength(options.reach);
  if (!reach) return tl::unexpected(reach.error());
  if (!(reach->value() > 0.0)) return WrongUsage("--reach", "must be above 0");
  wishes.reach_m = reach->value();
  if (!options.plot.empty()) {
    if (auto named = CheckPictureName("--plot", options.plot); !named) {
      return Propagate(std::move(named));
    }
  }
  return wishes;
}

std::vector<MinutesLadder> LaddersOf(const Session& session, const FitSettings& settings,
                                     const LadderWishes& wishes, const Progress& progress) {
  const std::size_t count = session.lights.size();
  std::vector<std::optional<MinutesLadder>> of_light(count);
  JointProgress joint(progress, count);
  ParallelFor(static_cast<int>(count), [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    LadderWishes own = wishes;
    own.progress = joint.Of(at);
    auto ladder = PlanMinutes(session, session.lights[at].name, settings, own);
    if (ladder) of_light[at] = *std::move(ladder);
    joint.Done(at);
  });
  std::vector<MinutesLadder> ladders;
  for (std::optional<MinutesLadder>& ladder : of_light) {
    if (ladder) ladders.push_back(*std::move(ladder));
  }
  return ladders;
}

std::vector<std::vector<std::string>> MinutesCells(const MinutesLadder& ladder) {
  std::vector<std::vector<std::string>> rows = {
      {"minutes", "what they buy: " + ladder.light, "leaves", "limit"}};
  if (ladder.u95_relative) rows.push_back({"0", "as it is", Now(ladder), ""});
  for (const LadderStep& step : ladder.steps) {
    rows.push_back(
        {ShortestText(step.total_minutes), step.say, LeftAfter(step.reading), StepMark(step)});
  }
  return rows;
}

std::string MinutesTable(const std::vector<MinutesLadder>& ladders) {
  std::string text;
  for (const MinutesLadder& ladder : ladders) {
    if (ladder.steps.empty()) continue;
    auto rows = MinutesCells(ladder);
    const std::vector<std::string> header = std::move(rows.front());
    rows.erase(rows.begin());
    text += (text.empty() ? "" : "\n") + TextTable(header, rows);
  }
  return text;
}

std::vector<std::string> MinutesSentences(const std::vector<MinutesLadder>& ladders) {
  std::vector<std::string> sentences;
  for (const MinutesLadder& ladder : ladders) sentences.push_back(Sentence(ladder));
  return sentences;
}

Node PlannedReadingNode(const PlannedReading& reading) {
  return {{"action", WordOf(reading.action)},
          {"distance_m", reading.distance},
          {"position_m", reading.position_m},
          {"normal", reading.normal},
          {"off_axis_deg",
           reading.off_axis ? std::optional(DegreesFromRadians(*reading.off_axis)) : std::nullopt},
          {"expected_lx", reading.expected},
          {"u95_relative", reading.u95_relative},
          {"beam_u95_deg", reading.beam_u95_deg},
          {"say", SayPlannedReading(reading)}};
}

Node MinutesNode(const MinutesLadder& ladder) {
  const auto step = [](const LadderStep& one) {
    Node node = PlannedReadingNode(one.reading);
    node.Put({{"minutes", one.minutes},
              {"total_minutes", one.total_minutes},
              {"meter_limits", one.meter_limits}});
    return node;
  };
  return {{"light", ladder.light},
          {"u95_relative", ladder.u95_relative},
          {"meter_u95_relative", ladder.meter_u95_relative},
          {"steps", Node::List(ladder.steps, step)}};
}

Result<std::vector<OutputFile>> MinutesPictures(const MinutesOptions& options,
                                                const std::vector<MinutesLadder>& ladders) {
  std::vector<OutputFile> files;
  if (options.plot.empty()) return files;
  const std::string svg = report::MinutesPlot(ladders);
  if (svg.empty()) return Refused("no_plot", options.plot, "no further reading would help");
  auto picture = PictureFile(options.plot, svg);
  if (!picture) return Propagate(std::move(picture));
  files.push_back(*std::move(picture));
  return files;
}

}  // namespace lightcal::app
