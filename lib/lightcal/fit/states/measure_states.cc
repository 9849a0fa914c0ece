// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/states/measure_states.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/colour/fit_color.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/fit/states/doubted_states.h"
#include "lightcal/fit/states/drift.h"
#include "lightcal/fit/states/predicted_reading.h"
#include "lightcal/fit/states/split_geometries.h"
#include "lightcal/light/fixture.h"
#include "lightcal/records/reading_time.h"

namespace lightcal::fit {
namespace {

// Other lamps, of the dimmest reading, 1 sigma: what light/effects takes where none is stated.
constexpr double kOtherLamps = 0.025;

struct StateReadings {
  FixtureState state;
  std::vector<const SessionReading*> rows;
};

bool Counts(const Reading& reading) {
  return reading.illuminance && reading.lamp == LampState::kOn && !reading.shadow_card &&
         !reading.over_range && !reading.under_range && reading.illuminance->value() > 0.0;
}

struct Background {
  double lux = 0.0;
  double sd = 0.0;
};

class Measuring {
 public:
  Measuring(const Session& session, const LightDescription& description, FittedLight& light)
      : session_(session), description_(description), light_(light) {
    Note(session.readings);
    Note(session.state_readings);
    const bool surely_dark = session.surroundings == Surroundings::kDark;
    unknown_sd_ = surely_dark || !std::isfinite(dimmest_) ? 0.0 : kOtherLamps * dimmest_;
  }

  [[nodiscard]] const std::vector<StateReadings>& states() const { return states_; }

  // ln of this state's light over the reference's; nothing where no reading tells it.
  struct Ratio {
    double ln = 0.0;
    double variance = 0.0, own_variance = 0.0;
    double predicted_variance = 0.0;  // of it, what a predicted reference brings
    int readings = 0;
  };
  [[nodiscard]] std::optional<Ratio> RatioOf(const StateReadings& state) const {
    Ratio out;
    double weights = 0.0;
    double shared = 0.0;
    double predicted = 0.0;
    for (const SessionReading* row : state.rows) {
      if (!Counts(row->reading)) continue;
      // What is behind a card holds the walls' light, which both sides have or neither.
      const bool cards = CardsAt(state, row->reading) && CardsAt(OfReference(), row->reading);
      const auto at_reference =
          Reference(row->reading, SameState(state.state, light_.state), cards);
      const auto own = Direct(*row, cards);
      if (!at_reference || !own) continue;
      const double weight = 1.0 / own->variance;
      out.ln += weight * (own->ln - at_reference->ln);
      shared += weight * at_reference->variance;
      if (at_reference->predicted) predicted += weight * at_reference->variance;
      weights += weight;
      ++out.readings;
    }
    if (!(weights > 0.0)) return std::nullopt;
    out.ln /= weights;
    out.own_variance = 1.0 / weights;
    out.variance = out.own_variance + shared / weights;
    out.predicted_variance = predicted / weights;
    return out;
  }

 private:
  void Note(const std::vector<SessionReading>& rows) {
    for (const SessionReading& row : rows) {
      const Reading& reading = row.reading;
      if (reading.light != light_.name) continue;
      if (reading.lamp == LampState::kOff) {
        if (reading.illuminance) off_.push_back(&row);
        continue;
      }
      if (reading.state.empty()) continue;  // what the box says
      auto known = std::ranges::find_if(
          states_, [&](const StateReadings& one) { return SameState(one.state, reading.state); });
      if (known == states_.end()) {
        known = states_.insert(states_.end(), StateReadings{reading.state, {}});
      }
      known->rows.push_back(&row);
      if (Counts(reading)) dimmest_ = std::min(dimmest_, reading.illuminance->value());
    }
  }

  [[nodiscard]] const StateReadings& OfReference() const { return Of(light_.state); }
  [[nodiscard]] const StateReadings& Of(const FixtureState& state) const {
    return *std::ranges::find_if(
        states_, [&](const StateReadings& one) { return SameState(one.state, state); });
  }
  [[nodiscard]] static bool CardsAt(const StateReadings& state, const Reading& place) {
    return std::ranges::any_of(state.rows, [&](const SessionReading* row) {
      const Reading& reading = row->reading;
      return reading.shadow_card && reading.illuminance && SamePlace(reading, place);
    });
  }

  // What else shone on the meter.
  [[nodiscard]] Background BackgroundOf(const Reading& reading, bool cards) const {
    double sum = 0.0;
    int count = 0;
    const auto add = [&](const std::vector<const SessionReading*>& rows, const auto& fits) {
      for (const SessionReading* row : rows) {
        if (!row->reading.illuminance || !fits(row->reading)) continue;
        sum += row->reading.illuminance->value();
        ++count;
      }
    };
    const auto sigma = [&] { return count > 0 ? 0.02 * sum / count : 0.0; };
    if (cards) {
      add(Of(reading.state).rows,
          [&](const Reading& r) { return r.shadow_card && SamePlace(r, reading); });
      return {sum / count, sigma()};
    }
    add(off_, [&](const Reading& r) { return SamePlace(r, reading); });
    if (count > 0) return {sum / count, sigma()};
    add(off_, [](const Reading& /*any*/) { return true; });
    if (count > 0) return {sum / count, 0.3 * sum / count};
    const bool told = light_.ambient_lx && light_.ambient_lx->u95 > 0.0;
    if (told) return {light_.ambient_lx->value, light_.ambient_lx->u95 / kZ95};
    return {0.0, unknown_sd_};
  }

  [[nodiscard]] std::optional<LogAt> Direct(const SessionReading& row, bool cards) const {
    const double lux = row.reading.illuminance->value();
    const Background behind = BackgroundOf(row.reading, cards);
    const double direct = lux - behind.lux;
    const double repeat = RepeatabilityRelative(session_, row.reading) * lux;
    const double sd = std::hypot(repeat, behind.sd);
    if (!(direct > 2.0 * sd)) return std::nullopt;
    return LogAt{std::log(direct), sd * sd / (direct * direct)};
  }

  // What a meter in that place shows of the lamp at the reference: read there, else predicted.
  struct ReferenceLog : LogAt {
    bool predicted = false;
  };
  [[nodiscard]] std::optional<ReferenceLog> Reference(const Reading& reading, bool is_reference,
                                                      bool cards) const {
    std::vector<DatedLog> read;
    for (const SessionReading* row : OfReference().rows) {
      if (!Counts(row->reading) || !SamePlace(row->reading, reading)) continue;
      const auto direct = Direct(*row, cards);
      if (direct) {
        read.push_back({SecondsOfTime(row->reading.time), direct->ln, direct->variance});
      }
    }
    if (!read.empty()) {
      LogAt there = DriftedLog(read, SecondsOfTime(reading.time));
      if (is_reference) there.variance = 0.0;
      return ReferenceLog{there, false};
    }
    const auto predicted = PredictReading(description_, light_, reading);
    if (!predicted) return std::nullopt;
    const double own = light_.meter ? light_.meter->calibration_relative : 0.0;
    const double sd = predicted->sd_relative;
    const double variance = std::max(1e-4 * sd * sd, sd * sd - own * own);
    return ReferenceLog{{std::log(predicted->lux), variance}, true};
  }

  const Session& session_;
  const LightDescription& description_;
  FittedLight& light_;
  std::vector<StateReadings> states_;
  std::vector<const SessionReading*> off_;
  double dimmest_ = std::numeric_limits<double>::infinity();
  double unknown_sd_ = 0.0;
};

FittedColor ColorOf(const StateReadings& state, const LightDescription& description,
                    const OtherLight& others, CctMethod method, Warnings& warnings) {
  Session alone;
  for (const SessionReading* row : state.rows) alone.readings.push_back(*row);
  return FitColor(alone, description, &others, warnings, method).color;
}

std::optional<Uncertain> Times(const std::optional<Uncertain>& reference, double ln, double sd) {
  if (!reference) return std::nullopt;
  Uncertain scaled = *reference;
  const double factor = std::exp(ln);
  scaled.value *= factor;
  scaled.u95 *= factor;
  if (scaled.low) *scaled.low *= factor;
  if (scaled.high) *scaled.high *= factor;
  if (scaled.low && scaled.high && *scaled.low > 0.0) {
    WidenInLn(scaled, 1.0, sd);
  } else {
    scaled.u95 = std::hypot(scaled.u95, kZ95 * sd * scaled.value);
  }
  return scaled;
}

// What was said of the states' colours; of those that no white is near, once for all.
void WarnOfColors(const FittedLight& light, Warnings said, Warnings& warnings) {
  const auto withheld = [](const Warning& one) { return one.code == "cct_withheld"; };
  if (std::erase_if(said, withheld) > 0) {
    std::vector<const MeasuredState*> without;
    for (const MeasuredState& one : light.states) {
      const bool reference = SameState(one.state, light.state);  // said with the light's own
      if (!reference && one.color.xy && !one.color.cct_K) without.push_back(&one);
    }
    const auto name = [](const MeasuredState* one) { return StateText(one->state); };
    warnings.push_back({"cct_withheld", light.name,
                        "no colour temperature is given at " + Joined(without, "; ", name) +
                            ": no white is near its colour there; use xy"});
  }
  std::ranges::move(said, std::back_inserter(warnings));
}

// Said once: the worst of the states that were read where the reference was not.
void WarnOfPredictedReference(const FittedLight& light, Warnings& warnings) {
  constexpr double kWorthSaying = 0.02;
  const auto sd = [](const MeasuredState& one) { return one.predicted_reference.value_or(0.0); };
  const auto worst = std::ranges::max_element(light.states, {}, sd);
  if (worst == light.states.end() || sd(*worst) < kWorthSaying) return;
  warnings.push_back({"reference_predicted", light.name,
                      StateText(worst->state) + " was read where " + StateText(light.state) +
                          " was not, so that its part of it is known to " +
                          PercentText(kZ95 * sd(*worst)) + " alone: read " +
                          StateText(light.state) + " there too"});
}

// Of ln I, 1 sigma: another front or another zoom may shine from elsewhere, and the nearer it was
// read the more that is.
double OffsetSd(const StateReadings& state, const LightDescription& description,
                const FittedLight& light) {
  if (!light.intensity_cd || SameGeometry(state.state, light.state)) return 0.0;
  const double sd_m = MatchedOffset(OffsetParts(description.fixture)).sd_m;
  double nearest = std::numeric_limits<double>::infinity();
  for (const SessionReading* row : state.rows) {
    const Reading& reading = row->reading;
    if (Counts(reading) && reading.distance) {
      nearest = std::min(nearest, reading.distance->value());
    }
  }
  return 2.0 * sd_m / nearest;
}

}  // namespace

void MeasureStates(const Session& session, const LightDescription& description,
                   CctMethod cct_method, FittedLight& light, Warnings& warnings) {
  light.state = ReferenceState(session, light.name);
  if (light.state.empty()) return;
  const Measuring measuring(session, description, light);
  const OtherLight others(session, description, light);
  std::vector<MeasuredState> out;
  Warnings colors;
  bool other_geometry = false;
  for (const StateReadings& state : measuring.states()) {
    const bool reference = SameState(state.state, light.state);
    const std::string subject = light.name + " at " + StateText(state.state);
    const auto ratio = measuring.RatioOf(state);
    if (!ratio) {
      const bool any = std::ranges::any_of(
          state.rows, [](const SessionReading* row) { return Counts(row->reading); });
      const bool zero = std::ranges::any_of(state.rows, [](const SessionReading* row) {
        return row->reading.illuminance && row->reading.illuminance->value() == 0.0;
      });
      if (!any && zero) {
        warnings.push_back({"state_dark", subject,
                            "the meter showed 0 lx: the lamp is out there, or too dim to read. It "
                            "is no part of the curve, which ends at the dimmest state with light; "
                            "read one just above where it comes on"});
        continue;
      }
      warnings.push_back({any ? "state_dark" : "state_without_light", subject,
                          any ? "no reading of this state can be compared with the reference's (" +
                                    StateText(light.state) +
                                    "): too dim, or at a place the fit cannot predict"
                              : "no reading of this state holds illuminance; it is left out"});
      continue;
    }
    MeasuredState one{state.state, {}, std::sqrt(ratio->own_variance)};
    if (!reference && ratio->predicted_variance > 0.0) {
      one.predicted_reference = std::sqrt(ratio->predicted_variance);
    }
    const double ln = reference ? 0.0 : ratio->ln;
    const double sd =
        reference ? 0.0
                  : std::hypot(std::sqrt(ratio->variance), OffsetSd(state, description, light));
    one.relative = reference ? Uncertain{1.0, 0.0, {}, {}} : UncertainFromLog(ln, sd);
    one.intensity_cd = Times(light.intensity_cd, ln, sd);
    one.illuminance_lx = Times(light.illuminance_lx, ln, sd);
    one.color = reference ? light.color : ColorOf(state, description, others, cct_method, colors);
    one.readings = ratio->readings;
    other_geometry = other_geometry || !SameGeometry(state.state, light.state);
    if (reference) {
      out.insert(out.begin(), std::move(one));
    } else {
      out.push_back(std::move(one));
    }
  }
  light.states = std::move(out);
  WarnOfColors(light, std::move(colors), warnings);
  WarnOfPredictedReference(light, warnings);
  WarnOfDoubtedStates(light, warnings);
  if (other_geometry && light.intensity_cd) {
    warnings.push_back({"offset_shared", light.name,
                        "some zoom or modifier was read at one distance alone; where its light "
                        "starts is taken from " +
                            StateText(light.state) +
                            ", within what such fixtures differ: read it at a second distance"});
  }
}

}  // namespace lightcal::fit
