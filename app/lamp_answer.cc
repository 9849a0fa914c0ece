// SPDX-License-Identifier: Apache-2.0
#include "lamp_answer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include "console.h"
#include "guide/shell_word.h"
#include "joint_progress.h"
#include "lamp_words.h"
#include "light_table.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/parallel.h"
#include "lightcal/core/stops.h"
#include "lightcal/fit/plan/plan_readings.h"
#include "lightcal/light/fixture.h"
#include "lightcal/presets/check/engine_answers.h"
#include "lightcal/presets/preset_table.h"
#include "lightcal/records/stated_beam.h"

namespace lightcal::app {
namespace {

// Parts of less stops than these change nothing that is shown.
constexpr double kLeastPartStops = 0.02;
constexpr std::size_t kPartsShown = 3;

// ---- the first line ----

bool WasRead(const Session& session, const std::string& light) {
  return std::ranges::any_of(session.readings, [&](const SessionReading& row) {
    const Reading& reading = row.reading;
    return reading.light == light && (reading.duv || reading.xy || !reading.spectrum_file.empty());
  });
}

std::string ColorText(const LampQuestion& question, const FittedLight& light) {
  const auto& cct = light.color.cct_K;
  if (!cct) return "";
  if (question.typed_color) return RoundedText(cct->value, 4) + " K as typed";
  std::string text = KelvinText(*cct);
  const auto& duv = light.color.duv;
  if (duv && WasRead(*question.session, light.name)) {
    text += ", Duv " + ValueWithAbsolute(duv->value, duv->u95, "");
  }
  return text;
}

std::string PlaceWords(const Session& session) {
  if (session.surroundings != Surroundings::kIndoors) return ", no walls";
  return session.room ? ", in its room" : ", in a room";
}

std::string LabelOf(const LampQuestion& question, const FittedLight& light) {
  if (question.by_name) return light.name;
  const LightDescription* described = FindLight(*question.session, light.name);
  std::string word(LightKindName(light.kind));
  if (described != nullptr && described->fixture) {
    word = FixtureName(*described->fixture);
  } else if (light.kind == LightKind::kPoint) {
    word = "lamp";
  }
  std::ranges::replace(word, '_', ' ');
  return word + PlaceWords(*question.session);
}

std::string FirstLine(const LampAnswer& answer) {
  const FittedLight& light = *answer.light;
  const Strength strength = StrengthOf(light);
  std::string text = "nothing is known of how bright it is";
  if (strength.value != nullptr) {
    const std::string stops = StopsText(*strength.value);
    const std::string unit(strength.unit);
    text = stops.empty() ? "below " + UpperEndText(*strength.value) + " " + unit
                         : ValueText(*strength.value) + " " + unit + "   " +
                               RangeText(*strength.value) + "   " + stops;
  }
  if (!answer.color.empty()) text += "   " + answer.color;
  return LabelledLine(answer.label, text);
}

// Why two engines get different candela: one takes the colour apart from its luminance.
std::string WhyTheyDiffer(const LampAnswer& answer) {
  if (!answer.light->intensity_cd) return "";
  const double own = answer.light->intensity_cd->value;
  constexpr double kSame = 0.02;
  for (const EngineFigure& figure : answer.figures) {
    const auto value = ParseNumber(figure.value);
    if (figure.unit != "cd" || !value || !HasColor(figure)) continue;
    if (std::abs(*value / own - 1.0) < kSame) continue;
    return Rounded(*value, 3) + " is the same lamp: " + Rounded(own, 3) + " / " +
           RoundedText(own / *value, 2) + ", the colour's luminance";
  }
  return "";
}

// ---- why ----

constexpr std::array<std::pair<std::string_view, std::string_view>, 18> kPartWords = {
    {{"room_bounce", "walls"},
     {"meter_calibration", "meter"},
     {kCameraScale, "the camera's scale"},
     {"readings", "reading by reading"},
     {"readings_and_place", "meter and place"},
     {"uneven_light", "how evenly it shines"},
     {"distance_offset", "where the light starts"},
     {"unknown_lamp", "what lamp it is"},
     {"data_sheet", "what the box says"},
     {"finite_source", "its size"},
     {"ambient", "other light"},
     {"shadow_card", "what the card hides"},
     {"cone", "the beam's shape"},
     {"aim", "where it aims"},
     {"meter_tilt", "how the meter was turned"},
     {"distance_error", "the tape measure"},
     {"spectral_mismatch", "the meter's colour response"},
     {"warm_up", "warming up"}}};

std::string PartWord(const std::string& name) {
  const auto row = std::ranges::find(kPartWords, name, [](const auto& p) { return p.first; });
  std::string word = row == kPartWords.end() ? name : std::string(row->second);
  std::ranges::replace(word, '_', ' ');
  return word;
}

// Their squares make that of the interval. Where lamps of several kinds stay possible the unlikely
// ones weigh more in a variance than in 95 %: all parts shrink alike then.
std::string Parts(const FittedLight& light, const Uncertain& value) {
  const std::vector<BudgetPart>& parts = light.budget;
  double variance = 0.0;
  for (const BudgetPart& part : parts) variance += part.sd_relative * part.sd_relative;
  const double together = StopsOfSd(std::sqrt(variance));
  const double whole = HalfWidthStops(value).value_or(together);
  const double shrunk = together > whole ? whole / together : 1.0;
  std::string text;
  for (std::size_t i = 0; i < std::min(kPartsShown, parts.size()); ++i) {
    const double stops = shrunk * StopsOfSd(parts[i].sd_relative);
    if (i > 0 && stops < kLeastPartStops) break;
    text += (text.empty() ? "" : " · ") + PartWord(parts[i].name) + " " + BareStops(stops);
  }
  return text;
}

// "about 8 of the 20 lx at 2 m came off the walls: assumed"
std::string WallsPart(const FittedLight& light, const Session& session) {
  const ResidualRow* farthest = nullptr;
  for (const ResidualRow& row : light.residuals) {
    if (!row.used || !row.walls_lx || !row.distance_m) continue;
    if (farthest == nullptr || *row.distance_m > *farthest->distance_m) farthest = &row;
  }
  constexpr double kLeastShare = 0.01;
  if (farthest == nullptr) return "";
  const double share = *farthest->walls_lx / farthest->predicted_lx;
  if (!(share >= kLeastShare)) return "";
  const bool card = std::ranges::any_of(session.readings, [&](const SessionReading& row) {
    return row.reading.light == light.name && row.reading.shadow_card;
  });
  const bool learned =
      std::ranges::find(light.fit.learned, "room_bounce") != light.fit.learned.end();
  return "about " + Rounded(share * farthest->measured_lx, share < 0.1 ? 1 : 2) + " of the " +
         Rounded(farthest->measured_lx, 3) + " lx at " +
         ShortestText(std::round(*farthest->distance_m * 100.0) / 100.0) + " m came off the " +
         (session.surroundings == Surroundings::kOutdoors ? "ground: " : "walls: ") +
         (card ? "the card tells" : (learned ? "as the readings fall" : "assumed"));
}

// What nobody read of its cone, and where the angles come from.
std::string ConeDrawn(const FittedLight& light, const Session& session) {
  const LightDescription* described = FindLight(session, light.name);
  if (described == nullptr) return "";
  if (OfStatedBeam(light) && described->beam) {
    return "cones are drawn from its stated beam of " + DegreesText(*described->beam) + "°";
  }
  const bool unread = light.fit.used == 0 && !described->inner;
  if (!unread || light.kind != LightKind::kSpot || !light.inner_deg) return "";
  return "the inner angle, " + RoundedText(*light.inner_deg, 2) + "°, is the one of its lumens";
}

// ---- what next ----

std::string MinutesBetter(double count) {
  return ShortestText(count) + (count == 1.0 ? " minute better" : " minutes better");
}

// Of a beam's angle where that is what it tells.
std::string WhatItBuys(const PlannedReading& reading) {
  if (!reading.off_axis || !reading.beam_u95_deg) return StopsText(reading.u95_stops);
  return "beam angle ± " + RoundedText(*reading.beam_u95_deg, 2) + "°";
}

struct LabelAndText {
  std::string label, text;
};
LabelAndText NextWords(const LampAnswer& answer) {
  const NextStepAdvice& next = answer.next;
  switch (next.kind) {
    case NextStepAdvice::Kind::kReading:
      return {MinutesBetter(next.minutes), answer.better + ": " + WhatItBuys(*next.reading)};
    case NextStepAdvice::Kind::kSay:
      return {"next", next.say};
    case NextStepAdvice::Kind::kMeter:
    case NextStepAdvice::Kind::kNothing:
      break;
  }
  return {"better", next.say};
}

// What a lamp is, or how large, costs no minute to say.
std::string SayWhat(const LampQuestion& question, const FittedLight& light) {
  const LightDescription* described = FindLight(*question.session, light.name);
  if (question.fixture_words.empty() || described == nullptr || light.budget.empty()) return "";
  if (described->kind != LightKind::kPoint || light.budget.front().name != "unknown_lamp")
    return "";
  if (described->fixture && described->fixture != Fixture::kPanel) return "";
  return described->fixture ? "say how large it is: " + question.size_words
                            : "say what it is: " + question.fixture_words +
                                  " (or panel, reflector, fresnel, softbox, cob_bare)";
}

std::string NextLine(const LampAnswer& answer) {
  const LabelAndText words = NextWords(answer);
  return LabelledLine(words.label, words.text);
}

std::string EnoughOf(const FittedLight& light) {
  const Strength strength = StrengthOf(light);
  const auto stops = strength.value == nullptr ? std::nullopt : HalfWidthStops(*strength.value);
  return stops ? EnoughFor(*stops) : "";
}

std::string EnoughLine(const FittedLight& light) {
  const std::string enough = EnoughOf(light);
  return LabelledLine("enough for",
                      enough.empty() ? "nothing yet: look-dev asks for ± 0.5 stop" : enough);
}

// ---- gathering ----

constexpr std::array<std::string_view, 4> kUsualTargets = {"blender", "unreal", "unity", "gltf"};

std::vector<std::string_view> TitlesOf(const std::vector<std::string>& targets) {
  std::vector<std::string_view> titles;
  const auto add = [&](std::string_view name) {
    for (const PresetTarget& target : PresetTargets()) {
      if (target.name == name && !target.title.empty()) titles.push_back(target.title);
    }
  };
  // All of them are no wish.
  if (targets.empty() || targets.size() == PresetTargets().size()) {
    for (const std::string_view name : kUsualTargets) add(name);
  } else {
    for (const std::string& name : targets) add(name);
  }
  return titles;
}

// The line that takes a planned reading; "" where a distance does not say it.
std::string ReadCommand(const std::string& session, const FittedLight& light,
                        const PlannedReading& step) {
  if (!step.distance && step.action != PlannedAction::kLampOff) return "";
  std::string line = "lightcal read -s " + ShellWord(session) + " --light " + ShellWord(light.name);
  // Of a lamp with controls it is the reference that is read again.
  if (!light.state.empty() && step.action != PlannedAction::kLampOff) {
    line += " --state " + ShellWord(Joined(light.state, ",", ControlText));
  }
  if (step.distance) {
    line +=
        " --distance " + ShortestText(std::round(step.distance->value() * 1000.0) / 1000.0) + "m";
  }
  if (step.off_axis) line += " --off-axis " + DegreesText(*step.off_axis) + "deg";
  switch (step.action) {
    case PlannedAction::kShadowCard:
      return "block the direct beam with a card: " + line + " --shadow-card";
    case PlannedAction::kLampOff:
      return "switch the lamp off: " + line + " --lamp-off";
    case PlannedAction::kRead:
      break;
  }
  return "read once more: " + line;
}

}  // namespace

LampAnswers SessionAnswersOf(const CalibratedSession& calibrated, const std::string& path,
                             const std::vector<std::string>& targets, const Progress& progress) {
  LampQuestion question;
  question.progress = progress;
  question.lights = &calibrated.lights;
  question.session = &calibrated.session;
  question.targets = targets;
  question.fixture_words = "in session.toml fixture = \"bulb\"";
  question.size_words = "in session.toml kind = \"rect\", size_m = [0.6, 0.3]";
  question.syntax = [&](const FittedLight& light, const PlannedReading& step) {
    return ReadCommand(path, light, step);
  };
  return LampAnswersOf(question);
}

LampAnswers LampAnswersOf(const LampQuestion& question) {
  LampAnswers all;
  const std::vector<std::string_view> titles = TitlesOf(question.targets);
  const std::vector<FittedLight>& lights = question.lights->lights;
  std::vector<LampAnswer>& answers = all.lamps;
  answers.resize(lights.size());
  // What to do next is worked out by fits of their own: most of the time of many lamps.
  JointProgress joint(question.progress, lights.size());
  ParallelFor(static_cast<int>(lights.size()) + 1, [&](int i) {
    if (i == 0) {
      all.engines = EngineAnswersOf(*question.lights);
      return;
    }
    const auto at = static_cast<std::size_t>(i - 1);
    answers[at].next = AdviseNext(*question.session, lights[at], {}, joint.Of(at));
    joint.Done(at);
  });
  auto figure = all.engines.figures.cbegin();  // light by light
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const FittedLight& light = lights[i];
    LampAnswer& answer = answers[i];
    answer.light = &light;
    answer.label = LabelOf(question, light);
    answer.color = ColorText(question, light);
    const auto first = figure;
    while (figure != all.engines.figures.cend() && figure->light == light.name) ++figure;
    for (const std::string_view title : titles) {
      std::copy_if(first, figure, std::back_inserter(answer.figures),
                   [&](const EngineFigure& one) { return one.engine == title; });
    }
    answer.say_what = SayWhat(question, light);
    if (answer.next.reading) {
      answer.better = question.syntax ? question.syntax(light, *answer.next.reading) : "";
      if (answer.better.empty()) answer.better = SayPlannedReading(*answer.next.reading);
    }
  }
  return all;
}

std::vector<LightAdvice> AdviceOf(const std::vector<LampAnswer>& answers,
                                  const std::string& session) {
  std::vector<LightAdvice> out;
  for (const LampAnswer& answer : answers) {
    LampAnswer named = answer;
    if (named.next.reading) {
      const std::string line = ReadCommand(session, *named.light, *named.next.reading);
      if (!line.empty()) named.better = line;
    }
    const LabelAndText words = NextWords(named);
    out.push_back({answer.light->name, words.label, words.text, EnoughOf(*answer.light)});
  }
  return out;
}

std::string LampAnswerText(const LampAnswer& answer, const Session& session) {
  const FittedLight& light = *answer.light;
  const Strength strength = StrengthOf(light);
  std::string text = FirstLine(answer);
  if (const std::string typed = TypeIn(answer.figures); !typed.empty()) {
    text += LabelledLine("type in", typed);
    if (const std::string why = WhyTheyDiffer(answer); !why.empty()) text += LabelledLine("", why);
    if (const std::string cones = Cones(answer.figures); !cones.empty()) {
      text += LabelledLine("cone", cones);
    }
    if (const std::string& place = answer.figures.front().place; !place.empty()) {
      text += LabelledLine("place", place);
    }
  }
  if (const std::string cone = ConeDrawn(light, session); !cone.empty()) {
    text += LabelledLine("", cone);
  }
  const std::string stops = strength.value == nullptr ? "" : StopsText(*strength.value);
  const std::string parts = stops.empty() ? "" : Parts(light, *strength.value);
  if (!parts.empty()) {
    text += LabelledLine("why " + stops.substr(0, stops.find(" stop")), parts);
  }
  if (const std::string walls = WallsPart(light, session); !walls.empty()) {
    text += LabelledLine("", walls);
  }
  if (light.position_u95_m) text += LabelledLine("stands at", PlaceFound(light));
  if (light.of_file) {
    const auto percent = [](double part) { return Rounded(100.0 * part, 2); };
    const Uncertain& u = *light.of_file;
    text += LabelledLine("luminaire", percent(u.value) + " % of its file   " +
                                          percent(u.low.value_or(u.value - u.u95)) + " … " +
                                          percent(u.high.value_or(u.value + u.u95)) + " %");
  }
  if (!answer.say_what.empty()) text += LabelledLine("0 minutes better", answer.say_what);
  return text + NextLine(answer) + EnoughLine(light);
}

std::string LampAnswersText(const std::vector<LampAnswer>& answers, const Session& session) {
  return answers.size() == 1 ? LampAnswerText(answers.front(), session) : LampAnswersTable(answers);
}

}  // namespace lightcal::app
