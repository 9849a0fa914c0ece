// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/reading_guide.h"

#include <algorithm>
#include <ranges>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/plan/next_step.h"
#include "lightcal/fit/plan/plan_readings.h"

namespace lightcal {
namespace {

bool SamePlace(const Reading& a, const Reading& b) {
  return a.distance == b.distance && a.position_m == b.position_m && a.off_axis == b.off_axis;
}

// Where nothing but distance tells readings apart, other light is part of what is measured.
bool TakesShadowCards(LightKind kind) {
  return kind != LightKind::kDirectional && kind != LightKind::kDome;
}

}  // namespace

ReadingGuide::ReadingGuide(const Session& session, const std::string& light, double until_relative,
                           bool shadow_cards)
    : until_relative_(until_relative) {
  session_.room = session.room;
  session_.surroundings = session.surroundings;
  session_.haze_per_metre = session.haze_per_metre;
  session_.meters = session.meters;
  session_.lights = {*FindLight(session, light)};
  for (const SessionReading& row : session.readings) {
    if (row.reading.light == light) session_.readings.push_back(row);
  }
  shadow_cards_ = shadow_cards && TakesShadowCards(session_.lights.front().kind);
  given_ = session_.readings.size();
  FitAll();
}

void ReadingGuide::FitAll() {
  auto fitted = FitOf(session_.readings);
  fitted_.reset();
  warnings_.clear();
  if (!fitted) return;
  fitted_ = std::move(fitted->lights.lights.front());
  warnings_ = std::move(fitted->warnings);
}

Result<FittedSession> ReadingGuide::FitOf(const std::vector<SessionReading>& readings) const {
  const bool read =
      std::ranges::any_of(readings, [](const SessionReading& row) { return IsLit(row.reading); });
  if (!read) {
    return Refused("no_readings", session_.lights.front().name, "nothing was read yet");
  }
  Session session = session_;
  session.readings = readings;
  return FitSession(session, {});
}

Result<FittedLight> ReadingGuide::FitWith(const Reading& reading) const {
  std::vector<SessionReading> readings = session_.readings;
  readings.push_back({reading, "this reading"});
  auto fitted = FitOf(readings);
  if (!fitted) return Propagate(std::move(fitted));
  return std::move(fitted->lights.lights.front());
}

std::optional<double> ReadingGuide::u95_relative() const {
  return fitted_ ? RelativeUncertainty(*fitted_) : std::nullopt;
}

const Reading* ReadingGuide::LitAtPlaceOf(const Reading& card) const {
  for (const SessionReading& row : session_.readings | std::views::reverse) {
    if (IsLit(row.reading) && SamePlace(row.reading, card)) return &row.reading;
  }
  return nullptr;
}

std::vector<PlannedReading> ReadingGuide::Skipped() const {
  std::vector<PlannedReading> out = skipped_;
  if (shadow_cards_) return out;
  for (const SessionReading& row : session_.readings) {
    const Reading& reading = row.reading;
    if (!IsLit(reading)) continue;
    out.push_back(
        {PlannedAction::kShadowCard, reading.distance, reading.position_m, reading.normal});
    if (reading.off_axis.value() != 0.0) out.back().off_axis = reading.off_axis;
  }
  return out;
}

Result<GuideAdvice> ReadingGuide::Next() const {
  const auto skipped = [this](const PlannedReading& step) {
    return std::ranges::any_of(skipped_,
                               [&](const PlannedReading& one) { return SameStep(one, step); });
  };
  const std::optional<double> now = u95_relative();
  if (now && *now <= until_relative_) return GuideAdvice{GuideAdvice::Kind::kReached};
  if (fitted_) {
    NextStepAdvice advice = AdviseNext(session_, *fitted_, Skipped());
    using Kind = NextStepAdvice::Kind;
    const bool nearer = advice.kind == Kind::kSay && advice.reading && !skipped(*advice.reading);
    if (advice.kind == Kind::kReading || nearer) {
      return GuideAdvice{GuideAdvice::Kind::kMeasure, *std::move(advice.reading)};
    }
    if (advice.kind != Kind::kSay) return GuideAdvice{GuideAdvice::Kind::kNoGain};
  }
  // Before any reading, and where only words tell more.
  LadderWishes wishes;
  wishes.reach_m = ReachIn(session_);
  wishes.steps = 1;
  wishes.skip = Skipped();
  auto ladder = PlanMinutes(session_, session_.lights.front().name, {}, wishes);
  if (!ladder) return Propagate(std::move(ladder));
  if (ladder->steps.empty()) return GuideAdvice{GuideAdvice::Kind::kNoGain};
  return GuideAdvice{GuideAdvice::Kind::kMeasure, std::move(ladder->steps.front().reading)};
}

std::string ReadingGuide::DoubtAbout(const Reading& reading) const {
  if (reading.over_range || reading.under_range) {
    return "it lies outside the meter's range, so it says little";
  }
  if (!IsLit(reading)) {
    const Reading* const lit = LitAtPlaceOf(reading);
    const bool brighter = lit != nullptr && *reading.illuminance >= *lit->illuminance;
    return brighter ? "with the lamp's light taken away the meter shows no less than with it" : "";
  }
  const auto with = FitWith(reading);
  if (!with)
    return fitted_ ? "the readings then contradict each other: " + with.error().message : "";
  const int index = with->fit.readings - 1;
  if (std::ranges::find(with->fit.rejected, index) == with->fit.rejected.end()) return "";
  const auto row = std::ranges::find(with->residuals, index, &ResidualRow::index);
  if (row == with->residuals.end()) return "it does not fit the other readings";
  return "it does not fit the other readings, which predict " + RoundedText(row->predicted_lx, 3) +
         " lx of the lamp's own light here";
}

void ReadingGuide::Add(const Reading& reading) {
  session_.readings.push_back({reading, "readings.jsonl"});
  const Reading* const lit = reading.shadow_card ? LitAtPlaceOf(reading) : nullptr;
  if (lit != nullptr && lit->illuminance->value() > 0.0) {
    other_share_ = reading.illuminance->value() / lit->illuminance->value();
  }
  FitAll();
}

bool ReadingGuide::TakeBack() {
  if (session_.readings.size() == given_) return false;
  const std::vector<SessionReading> added(session_.readings.begin() + std::ptrdiff_t(given_),
                                          session_.readings.end() - 1);
  session_.readings.resize(given_);
  other_share_.reset();
  FitAll();
  for (const SessionReading& row : added) Add(row.reading);
  return true;
}

void ReadingGuide::Skip(const PlannedReading& step) {
  if (step.action == PlannedAction::kShadowCard) shadow_cards_ = false;
  skipped_.push_back(step);
}

}  // namespace lightcal
