// SPDX-License-Identifier: Apache-2.0
#include "guide/sweep_readings.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/states/doubted_states.h"

namespace lightcal::app {
namespace {

// A lamp that gives this much less or more when it comes back to full is not yet steady.
constexpr double kDrift = 0.02;
// No warming up changes ln of its light so much: another number was typed, or the lamp is not back.
constexpr double kNoDrift = 0.4;
constexpr double kMeterDoubt = 1.05;
constexpr double kFar = 4.0;

double LuxOf(const Reading& reading) { return reading.illuminance->value(); }

std::string Read(const Reading& reading) {
  return StateText(reading.state) + " read " + RoundedText(LuxOf(reading), 4) + " lx";
}

}  // namespace

SweepReadings::SweepReadings(FixtureState full, const Session& session, const Reading& frame)
    : full_(std::move(full)) {
  VisitReadings(session, [&](const SessionReading& row) {
    const Reading& reading = row.reading;
    const bool here =
        !frame.distance ||
        (reading.distance && std::abs(reading.distance->value() - frame.distance->value()) < 1e-6);
    if (reading.light == frame.light && IsLit(reading) && here && !reading.state.empty()) {
      readings_.push_back({reading, false});
    }
  });
  held_ = readings_.size();
}

std::string SweepReadings::DoubtAbout(const FixtureState& state, double lux) const {
  const auto dimmer = NumberOfControl(state, kDimmerControl);
  const Reading *below = nullptr, *above = nullptr;
  for (const auto& [other, doubted] : readings_) {
    const double read = LuxOf(other);
    if (SameState(other.state, state)) {
      const bool another = read > 0.0 && !(std::abs(std::log(lux / read)) < kNoDrift);
      if (another) return "before, " + Read(other);
      continue;
    }
    const auto at = NumberOfControl(other.state, kDimmerControl);
    if (doubted || !dimmer || !at || !SameState(WithoutDimmer(other.state), WithoutDimmer(state)))
      continue;
    if (*at < *dimmer && read > kMeterDoubt * lux) return Read(other) + ", and is dimmed lower";
    if (*at > *dimmer && lux > kMeterDoubt * read) return Read(other) + ", and is dimmed less";
    const auto nearer = [&](const Reading* known) {
      return known == nullptr ||
             std::abs(*at - *dimmer) <
                 std::abs(*NumberOfControl(known->state, kDimmerControl) - *dimmer);
    };
    if (*at < *dimmer && nearer(below)) below = &other;
    if (*at > *dimmer && nearer(above)) above = &other;
  }
  if (below == nullptr || above == nullptr || !(LuxOf(*below) > 0.0)) return "";
  const auto dimmed = [](const Reading& known) {
    return fit::DimmedLight{*NumberOfControl(known.state, kDimmerControl), std::log(LuxOf(known))};
  };
  const auto between = fit::LnBetween(dimmed(*below), dimmed(*above), *dimmer);
  if (!between) return "";
  const double least = std::exp(between->low), most = std::exp(between->high);
  if (lux > least / kFar && lux < most * kFar) return "";
  return Read(*below) + " and " + Read(*above) + ", so that here about " +
         RoundedText(std::sqrt(least * most), 2) + " lx are expected";
}

std::optional<Warning> SweepReadings::AtFull(const Reading& reading,
                                             const std::string& undo) const {
  if (!reading.illuminance || !SameState(reading.state, full_)) return std::nullopt;
  const auto first =
      std::find_if(readings_.begin() + static_cast<std::ptrdiff_t>(held_), readings_.end(),
                   [&](const Held& one) {
                     return SameState(one.reading.state, full_) && LuxOf(one.reading) > 0.0;
                   });
  if (first == readings_.end()) return std::nullopt;
  const double before = LuxOf(first->reading);
  const double change = LuxOf(reading) / before;
  if (std::abs(std::log(change)) > kNoDrift) {
    return Warning{"return_disagrees", reading.light,
                   "back at " + StateText(reading.state) + " it read " +
                       RoundedText(LuxOf(reading), 4) + " lx where it had read " +
                       RoundedText(before, 4) + ": if the number is wrong, take it back (" + undo +
                       ") and sweep again"};
  }
  if (std::abs(change - 1.0) <= kDrift) return std::nullopt;
  return Warning{"drift", reading.light,
                 "back at " + StateText(reading.state) + " it gives " + PercentText(change - 1.0) +
                     " of a change: let it warm up, and sweep again"};
}

}  // namespace lightcal::app
