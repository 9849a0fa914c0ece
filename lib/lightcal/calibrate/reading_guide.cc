// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/reading_guide.h"

#include <algorithm>
#include <ranges>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/fit_light.h"

namespace lightcal {
namespace {

constexpr double kOtherLightMatters = 0.005;
constexpr double kLeastGain = 0.05;

bool IsLit(const Reading& reading) {
  return reading.illuminance && reading.lamp == LampState::kOn && !reading.shadow_card;
}

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

std::optional<PlannedReading> ReadingGuide::PendingCard() const {
  if (!shadow_cards_ || !uncarded_) return std::nullopt;
  const double lux = uncarded_->illuminance->value();
  if (other_lux_ && *other_lux_ < kOtherLightMatters * lux) return std::nullopt;
  PlannedReading card{PlannedAction::kShadowCard, uncarded_->distance, uncarded_->position_m,
                      uncarded_->normal};
  if (uncarded_->off_axis.value() != 0.0) card.off_axis = uncarded_->off_axis;
  return card;
}

bool ReadingGuide::IsSkipped(const PlannedReading& step) const {
  if (step.action == PlannedAction::kShadowCard && !shadow_cards_) return true;
  return std::ranges::any_of(skipped_, [&](const PlannedReading& one) {
    return one.action == step.action && one.distance == step.distance &&
           one.position_m == step.position_m && one.off_axis == step.off_axis;
  });
}

Result<GuideAdvice> ReadingGuide::Next() const {
  if (const auto card = PendingCard()) return GuideAdvice{GuideAdvice::Kind::kMeasure, *card};
  const std::optional<double> now = u95_relative();
  if (now && *now <= until_relative_) return GuideAdvice{GuideAdvice::Kind::kReached};
  auto plan = PlanReadings(session_, session_.lights.front().name, {}, 1);
  if (!plan) return Propagate(std::move(plan));
  const auto best = std::ranges::find_if(
      plan->candidates, [this](const PlannedReading& step) { return !IsSkipped(step); });
  if (best == plan->candidates.end()) return GuideAdvice{GuideAdvice::Kind::kNoGain};
  const auto open = [](double u95, const std::optional<double>& beam) {
    return u95 * beam.value_or(1.0);
  };
  const bool helps = !now || open(best->u95_relative, best->beam_u95_deg) <
                                 (1.0 - kLeastGain) * open(*now, plan->beam_u95_deg);
  return GuideAdvice{helps ? GuideAdvice::Kind::kMeasure : GuideAdvice::Kind::kNoGain, *best};
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
  if (IsLit(reading)) {
    const bool carded = std::ranges::any_of(session_.readings, [&](const SessionReading& row) {
      return row.reading.shadow_card && SamePlace(row.reading, reading);
    });
    if (!carded) uncarded_ = reading;
  } else {
    const Reading* const lit = reading.shadow_card ? LitAtPlaceOf(reading) : nullptr;
    if (lit != nullptr && lit->illuminance->value() > 0.0) {
      other_lux_ = reading.illuminance->value();
      other_share_ = *other_lux_ / lit->illuminance->value();
    }
    if (reading.shadow_card) uncarded_.reset();
  }
  FitAll();
}

bool ReadingGuide::TakeBack() {
  if (session_.readings.size() == given_) return false;
  const std::vector<SessionReading> added(session_.readings.begin() + std::ptrdiff_t(given_),
                                          session_.readings.end() - 1);
  session_.readings.resize(given_);
  uncarded_.reset();
  other_share_.reset();
  other_lux_.reset();
  FitAll();
  for (const SessionReading& row : added) Add(row.reading);
  return true;
}

void ReadingGuide::Skip(const PlannedReading& step) {
  if (step.action == PlannedAction::kShadowCard) shadow_cards_ = false;
  skipped_.push_back(step);
}

}  // namespace lightcal
