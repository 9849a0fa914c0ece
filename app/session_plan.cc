// SPDX-License-Identifier: Apache-2.0
#include "session_plan.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "calibration_options.h"
#include "joint_progress.h"
#include "lightcal/core/interval_text.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/parallel.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/plan/next_step.h"
#include "lightcal/fit/plan/plan_readings.h"
#include "lightcal/records/keep_lights.h"
#include "minutes_answer.h"
#include "progress_line.h"
#include "session_names.h"

namespace lightcal::app {
namespace {

constexpr double kAdvisedSpan = 8.0;
constexpr std::size_t kCandidatesShown = 8;

struct PlannedLight {
  const LightDescription* light = nullptr;
  Result<ReadingPlan> plan;
  std::string next{};  // as run and quick name it; "" before a reading
};

// The step that is worth most for its minutes, the same that run and quick name.
void SayNext(const Session& session, const FitSettings& settings,
             std::vector<PlannedLight>& planned, const Progress& progress) {
  Session sound = session;
  const auto is_sound = [&](const std::string& name) {
    return std::ranges::none_of(
        planned, [&](const PlannedLight& one) { return !one.plan && one.light->name == name; });
  };
  KeepLights(is_sound, sound);
  const auto fitted = FitSession(sound, settings);
  if (!fitted) return;
  JointProgress joint(progress, planned.size());
  ParallelFor(static_cast<int>(planned.size()), [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    PlannedLight& one = planned[at];
    const auto light =
        std::ranges::find(fitted->lights.lights, one.light->name, &FittedLight::name);
    if (light != fitted->lights.lights.end()) {
      one.next = AdviseNext(session, *light, {}, joint.Of(at)).say;
    }
    joint.Done(at);
  });
}

// Refused where every light is, by the first with the others beside it.
Result<void> CheckAnyPlan(const std::vector<PlannedLight>& planned) {
  std::optional<Error> refused;
  for (const PlannedLight& one : planned) {
    if (one.plan) return {};
    if (!refused) {
      refused = one.plan.error();
    } else {
      refused->others.push_back(one.plan.error());
    }
  }
  if (!refused) return {};
  return tl::unexpected(*std::move(refused));
}

// Of every light that is asked for, in the session's order.
std::vector<PlannedLight> PlanEach(const Session& session, const FitSettings& settings,
                                   const SessionPlanOptions& options, std::optional<double> reach_m,
                                   const Progress& progress) {
  std::vector<PlannedLight> planned;
  for (const LightDescription& light : session.lights) {
    if (options.light.empty() || light.name == options.light) planned.push_back({&light, {}});
  }
  JointProgress joint(progress, planned.size());
  ParallelFor(static_cast<int>(planned.size()), [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    planned[at].plan = PlanReadings(session, planned[at].light->name, settings, options.steps,
                                    reach_m, joint.Of(at));
    joint.Done(at);
  });
  return planned;
}

std::string SpanAdvice(const ReadingPlan& plan) {
  const std::string wanted =
      "distances in geometric steps that span 8 : 1 (0.5, 1, 2, 4 m) tell "
      "the lamp, its offset and other light apart";
  if (!plan.span) return wanted;
  if (*plan.span >= kAdvisedSpan * (1.0 - 1e-9)) return "";
  return wanted + "; so far they span " + RoundedText(*plan.span, 2) + " : 1";
}

// What no interval of typed readings holds.
std::string AdviceOf(const PlannedLight& planned, const Session& session) {
  const LightKind kind = planned.light->kind;
  if (kind == LightKind::kDirectional || kind == LightKind::kDome) return "";
  std::string advice = SpanAdvice(*planned.plan);
  const bool card = std::ranges::any_of(session.readings, [&](const SessionReading& row) {
    return row.reading.light == planned.light->name && row.reading.shadow_card;
  });
  if (!card && session.surroundings == Surroundings::kIndoors) {
    advice += advice.empty() ? "" : ". ";
    advice += "No shadow-card reading yet: one measures what walls and other lamps add";
  }
  if (!session.lit_readings.empty() && session.lights.size() > 1) {
    advice += advice.empty() ? "" : ". ";
    advice +=
        "Each step is of this lamp alone: turn the others off, or read twice, with it on and "
        "off, the same others lit";
  }
  return advice;
}

std::string IntervalsText(double u95_relative, double u95_stops,
                          const std::optional<double>& beam_deg) {
  const std::string beam = beam_deg ? ", beam angle ± " + RoundedText(*beam_deg, 2) + "°" : "";
  return RelativeText(IntervalOfWidths(u95_relative, u95_stops)) + beam;
}
std::string IntervalsText(const PlannedReading& one) {
  return IntervalsText(one.u95_relative, one.u95_stops, one.beam_u95_deg);
}

Node NodeOf(const PlannedLight& planned, const Session& session) {
  Node node = {{"name", planned.light->name}};
  if (!planned.plan) {
    const Error& error = planned.plan.error();
    node.Put("refused", {{"code", error.code}, {"message", error.message}});
    return node;
  }
  const ReadingPlan& plan = *planned.plan;
  node.Put({{"u95_relative", plan.u95_relative},
            {"beam_u95_deg", plan.beam_u95_deg},
            {"span", plan.span},
            {"steps", Node::List(plan.steps, PlannedReadingNode)},
            {"candidates", Node::List(plan.candidates, PlannedReadingNode)},
            {"next", Node::UnlessEmpty(planned.next)},
            {"advice", Node::UnlessEmpty(AdviceOf(planned, session))}});
  return node;
}

std::string TextOf(const PlannedLight& planned, const Session& session, bool verbose) {
  std::string text = planned.light->name + ": ";
  if (!planned.plan) return text + planned.plan.error().message + "\n";
  const ReadingPlan& plan = *planned.plan;
  text += plan.u95_relative
              ? "now " + IntervalsText(*plan.u95_relative, plan.u95_stops, plan.beam_u95_deg) +
                    " (95 %)\n"
              : std::string("no reading yet\n");
  if (!planned.next.empty()) {
    text += "next, for its minutes: " + planned.next + "\nwhatever the minutes:\n";
  }
  std::vector<std::vector<std::string>> rows;
  for (const PlannedReading& step : plan.steps) {
    rows.push_back({std::to_string(rows.size() + 1), SayPlannedReading(step),
                    RoundedText(step.expected.value(), 3) + " lx", IntervalsText(step)});
  }
  text += TextTable({"step", "take this reading", "expect about", "then"}, rows);
  if (verbose) {
    rows.clear();
    for (const PlannedReading& one : plan.candidates) {
      if (rows.size() == kCandidatesShown) break;
      rows.push_back({SayPlannedReading(one), IntervalsText(one)});
    }
    text += "\n" + TextTable({"or first", "then"}, rows);
  }
  const std::string advice = AdviceOf(planned, session);
  return text + (advice.empty() ? "" : "advice: " + advice + "\n");
}

}  // namespace

Result<void> PlanSession(const SessionPlanOptions& options, Console& console) {
  const auto asked = SettingsAsked(options.calibration);
  if (!asked) return tl::unexpected(asked.error());
  const auto wishes = LadderWishesOf(options.minutes);
  if (!wishes) return tl::unexpected(wishes.error());
  const auto measured = MeasureAloud(options.calibration.session, *asked, console);
  if (!measured) return tl::unexpected(measured.error());
  const Session* session = &measured->session;
  if (!options.light.empty()) {
    if (auto known = CheckNames(*session, options.light, ""); !known) return known;
  }
  FitSettings settings;
  settings.tolerance_relative = asked->profile.tolerance_relative;
  settings.effects = asked->profile.effects;
  const auto reach_m = options.reach_stated ? std::optional(wishes->reach_m) : std::nullopt;
  ProgressLine line("planning readings", !console.quiet());
  std::vector<PlannedLight> planned =
      PlanEach(*session, settings, options, reach_m, line.Watcher());
  if (auto any = CheckAnyPlan(planned); !any) return any;
  line.Begin("weighing their minutes");
  SayNext(*session, settings, planned, line.Watcher());
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  std::vector<MinutesLadder> ladders;
  if (options.with_minutes) {
    line.Begin("planning the minutes");
    ladders = LaddersOf(*session, settings, *wishes, line.Watcher());
    if (!options.light.empty()) {
      std::erase_if(ladders, [&](const auto& ladder) { return ladder.light != options.light; });
    }
  }
  line.Wipe();
  const auto pictures = MinutesPictures(options.minutes, ladders);
  if (!pictures) return tl::unexpected(pictures.error());
  if (auto written = WriteOutputs(*pictures, options.force); !written) return written;
  std::vector<Node> lights;
  for (const PlannedLight& light : planned) {
    console.Print((&light == planned.data() ? "" : "\n") +
                  TextOf(light, *session, console.verbose()));
    lights.push_back(NodeOf(light, *session));
  }
  if (!ladders.empty()) console.Print("\n" + MinutesTable(ladders) + "\n");
  for (const std::string& sentence : MinutesSentences(ladders)) console.Print(sentence + "\n");
  for (const OutputFile& file : *pictures) console.Note("wrote " + file.path);
  console.PrintDocument(
      {{"lights", lights}, {"minutes", Node::UnlessEmpty(Node::List(ladders, MinutesNode))}});
  return {};
}

}  // namespace lightcal::app
