// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/states/state_answer.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/fit/model/truncated_normal.h"
#include "lightcal/fit/states/control_curve.h"
#include "lightcal/fit/states/known_curves.h"
#include "lightcal/fit/states/ln_of.h"
#include "lightcal/fit/states/mixing_line.h"
#include "lightcal/fit/states/state_spectrum.h"
#include "lightcal/fit/states/states_near.h"

namespace lightcal {
namespace {

using fit::ControlCurve;
using fit::ControlKind;
using fit::CurvePoint;
using fit::CurveTarget;
using fit::CurveValue;
using fit::KnownCurves;
using fit::Scaled;
using fit::SdOfLn;
using fit::States;

constexpr double kLeastRepeatability = 1e-4;

const ControlCurve& LightCurve(const States& states, KnownCurves& curves) {
  std::vector<CurvePoint> points;
  for (const MeasuredState* one : states.kept()) {
    points.push_back({states.LabelsOf(one->state), std::log(one->relative.value),
                      std::max(kLeastRepeatability, one->repeatability)});
  }
  return curves.Of(states.Kinds(), CurveTarget::kLnLight, std::move(points));
}

// Light does not fall as a dimmer rises: what lies between two states that were read is no darker
// than the lower and no brighter than the upper (each within 2 sigma of its own). ln of the light
// over that of `unit`, or of the reference.
CurveValue BetweenNeighbours(const States& states, const MeasuredState* unit, CurveValue value) {
  const auto [lower, upper] = states.DimmerNeighbours();
  if (lower == nullptr || upper == nullptr || !(value.sd > 0.0)) return value;
  const auto bound = [&](const MeasuredState& one, double sigmas) {
    if (&one == unit) return 0.0;
    const double over = unit != nullptr ? unit->relative.value : 1.0;
    const double sd = std::hypot(one.repeatability, unit != nullptr ? unit->repeatability : 0.0);
    return std::log(one.relative.value / over) + sigmas * sd;
  };
  const double low = bound(*lower, -2.0);
  const double high = bound(*upper, 2.0);
  if (!(low < high)) return value;  // no dimmer
  const fit::TruncatedNormal left = fit::TruncateBetween(value.value, value.sd, low, high);
  return {left.mean, std::sqrt(std::max(0.0, left.variance))};
}

// 1 sigma of ln of one state's light over another's that no reading of theirs shows: what the fit
// predicts of the reference where it was not read. States that were read elsewhere share it.
double PredictedApart(const MeasuredState& one, const MeasuredState& other) {
  return std::abs(one.predicted_reference.value_or(0.0) - other.predicted_reference.value_or(0.0));
}

// The same of a state between those.
double PredictedApart(const States& states, const MeasuredState* other) {
  double most = 0.0;
  for (const MeasuredState* one : states.kept()) {
    const double apart =
        other != nullptr ? PredictedApart(*one, *other) : one->predicted_reference.value_or(0.0);
    most = std::max(most, apart);
  }
  return most;
}

// What a colour's interval holds beside repeatability: the meter's own error, which every state of
// one lamp shares.
double SharedSd(double sd, double repeatability) {
  return std::sqrt(std::max(0.0, sd * sd - repeatability * repeatability));
}

// Of ln of a state's light, 1 sigma: its part of the reference without what that has of its own.
double OwnOfLight(const FittedLight& light, const MeasuredState& read) {
  const MeasuredState& reference = light.states.front();
  const double sd = &read == &reference ? 0.0 : SdOfLn(read.relative);
  return std::max(read.repeatability, SharedSd(sd, reference.repeatability));
}

struct SharedColor {
  double ln_mired = 0.0;
  double sd_ln_mired = 0.0, sd_duv = 0.0;
};

// At a colour between those that were read: one chromaticity error is more kelvin to a cold lamp.
SharedColor SharedAt(std::vector<SharedColor> read, double ln_mired) {
  std::ranges::sort(read, {}, &SharedColor::ln_mired);
  const auto above = std::ranges::lower_bound(read, ln_mired, {}, &SharedColor::ln_mired);
  if (above == read.begin()) return read.front();
  if (above == read.end()) return read.back();
  const SharedColor& a = *(above - 1);
  const double share = (ln_mired - a.ln_mired) / (above->ln_mired - a.ln_mired);
  return {ln_mired, a.sd_ln_mired + share * (above->sd_ln_mired - a.sd_ln_mired),
          a.sd_duv + share * (above->sd_duv - a.sd_duv)};
}

FittedColor ColorBetween(const States& states, const FixtureState& at, KnownCurves& curves,
                         OwnErrors& own) {
  std::vector<CurvePoint> mireds;
  std::vector<CurvePoint> duvs;
  std::vector<Xy> xys;
  std::vector<SharedColor> shared;
  std::vector<std::optional<ColorMeter>> meters;
  for (const MeasuredState* one : states.kept()) {
    const FittedColor& color = one->color;
    if (!color.cct_K || !color.duv || !color.xy) continue;
    const std::vector<double> labels = states.LabelsOf(one->state);
    mireds.push_back({labels, std::log(1e6 / color.cct_K->value), kRepeatsLnMired});
    duvs.push_back({labels, color.duv->value, kRepeatsDuv});
    xys.push_back(*color.xy);
    meters.push_back(color.meter);
    shared.push_back({mireds.back().value, SharedSd(SdOfLn(*color.cct_K), kRepeatsLnMired),
                      SharedSd(color.duv->u95 / kZ95, kRepeatsDuv)});
  }
  FittedColor out;
  if (mireds.size() < 2) return out;
  const std::vector<double> labels = states.LabelsOf(at);
  const CurveValue ln_mired =
      curves.Of(states.Kinds(), CurveTarget::kLnMired, std::move(mireds)).At(labels);
  CurveValue duv = curves.Of(states.Kinds(), CurveTarget::kDuv, std::move(duvs)).At(labels);
  const Kelvin cct(1e6 / std::exp(ln_mired.value));
  if (const auto line = fit::MixingLineOf(xys)) {
    // The line's Duv where it is the surer of the two.
    if (const auto on_line = fit::DuvOnLine(*line, cct); on_line && line->sd_duv < duv.sd) {
      duv = {*on_line, std::max(line->sd_duv, kRepeatsDuv)};
    }
  }
  const SharedColor meter = SharedAt(std::move(shared), ln_mired.value);
  const double sd = std::hypot(ln_mired.sd, meter.sd_ln_mired);
  out.cct_K = UncertainFromLog(std::log(cct.value()), sd);
  out.duv = UncertainFromNormal(duv.value, std::hypot(duv.sd, meter.sd_duv));
  out.xy = XyFromCct(cct, duv.value);
  const bool one_meter = std::ranges::count(meters, meters.front()) == std::ssize(meters);
  if (one_meter) out.meter = meters.front();
  // What several meters are off by is no state's and no lamp's.
  own.ln_mired = one_meter ? ln_mired.sd : sd;
  own.duv = one_meter ? duv.sd : std::hypot(duv.sd, meter.sd_duv);
  return out;
}

// The states whose mixtures are known, as they lie from the one asked for.
std::vector<fit::MixtureNear> MixturesAround(const States& states) {
  std::vector<fit::MixtureNear> around;
  for (const MeasuredState* one : states.kept()) {
    if (one->emitter_amounts.empty()) continue;
    around.push_back({states.OffsetOf(*one), one->emitter_amounts});
    for (double& amount : around.back().amounts) amount /= one->relative.value;
  }
  return around;
}

Result<void> CheckControlsOf(const FittedLight& light, const FixtureState& at) {
  if (light.states.empty()) {
    return Refused(
        "no_states", light.name,
        "was read at no state of its controls; give its readings state = { dimmer = 50 } "
        "and the like, and fit again");
  }
  const FixtureState& known = light.states.front().state;
  const bool same = std::ranges::equal(at, known, [](const ControlValue& a, const ControlValue& b) {
    return a.name == b.name && a.IsWord() == b.IsWord();
  });
  if (same) return {};
  const auto without = [](const FixtureState& some, const FixtureState& others) {
    std::string names;
    for (const ControlValue& one : some) {
      if (std::ranges::find(others, one.name, &ControlValue::name) != others.end()) continue;
      names += (names.empty() ? "" : ", ") + one.name;
    }
    return names;
  };
  const std::string missing = without(known, at);
  const std::string unknown = without(at, known);
  std::string what;
  if (!missing.empty()) what = " does not say " + missing;
  if (!unknown.empty()) {
    what += (what.empty() ? "" : ", and") + std::string(" says ") + unknown +
            ", which none of them does";
  }
  if (what.empty()) what = " says a number where they say a word, or a word for a number";
  return Refused("state_controls", light.name,
                 "was read at states such as " + StateText(known) + "; " + StateText(at) + what);
}

Result<StateAnswer> AnswerFrom(const FittedLight& light, const FixtureState& at,
                               std::size_t without, KnownCurves& curves) {
  States states(light, at, without);
  if (states.kept().empty()) {
    return Refused("state_word", light.name,
                   StateText(at) + ": no state with these words was read; there are such as " +
                       StateText(light.states.front().state));
  }
  if (auto inside = states.CheckInside(); !inside) return Propagate(std::move(inside));
  StateAnswer answer;
  answer.state = at;
  answer.full = states.Full();
  if (const auto dimmer = NumberOfControl(at, kDimmerControl)) {
    const double full = NumberOfControl(answer.full, kDimmerControl).value_or(100.0);
    if (full > 0.0) answer.promised_of_full = *dimmer / full;
  }
  answer.promised_cct_K = NumberOfControl(at, kCctControl);
  const MeasuredState* read = states.Exact(at);
  const MeasuredState* full = states.Exact(answer.full);
  if (read != nullptr && full != nullptr) {
    answer.basis = StateBasis::kMeasured;
    answer.relative = read->relative;
    answer.intensity_cd = read->intensity_cd;
    answer.illuminance_lx = read->illuminance_lx;
    answer.color = read->color;
    answer.own = {OwnOfLight(light, *read), kRepeatsLnMired, kRepeatsDuv};
    fit::AddSpectrumRead(light, *read, answer);
    const double sd = std::hypot(std::hypot(read->repeatability, full->repeatability),
                                 PredictedApart(*read, *full));
    answer.relative_to_full =
        read == full ? Uncertain{1.0, 0.0, {}, {}}
                     : UncertainFromLog(std::log(read->relative.value / full->relative.value), sd);
    return answer;
  }
  if (states.axes().empty()) {
    return Refused("too_few_states", light.name,
                   "one state alone was read; nothing tells what lies between");
  }
  const auto levels =
      std::ranges::count(states.axes(), ControlKind::kLevel, &fit::ControlAxis::kind);
  if (read == nullptr && levels > 1) {
    return Refused(
        "several_levels", light.name,
        "several of its controls each add light; what it is between the states that were "
        "read is not known: read " +
            StateText(at));
  }
  states.KeepNearest();
  const ControlCurve& curve = LightCurve(states, curves);
  const std::vector<double> labels = states.LabelsOf(at);
  CurveValue of_full = curve.Difference(labels, states.LabelsOf(answer.full));
  if (read == nullptr && full != nullptr) of_full = BetweenNeighbours(states, full, of_full);
  answer.relative_to_full =
      UncertainFromLog(of_full.value, std::hypot(of_full.sd, PredictedApart(states, full)));
  if (read != nullptr) {
    answer.relative = read->relative;
    answer.intensity_cd = read->intensity_cd;
    answer.illuminance_lx = read->illuminance_lx;
    answer.color = read->color;
    answer.own = {OwnOfLight(light, *read), kRepeatsLnMired, kRepeatsDuv};
    fit::AddSpectrumRead(light, *read, answer);
    return answer;
  }
  const CurveValue light_there = BetweenNeighbours(states, nullptr, curve.At(labels));
  answer.basis = states.BetweenTwo() ? StateBasis::kBetween : StateBasis::kCombined;
  const double sd = std::hypot(light_there.sd, PredictedApart(states, nullptr));
  answer.relative = UncertainFromLog(light_there.value, sd);
  answer.intensity_cd = Scaled(light.intensity_cd, light_there.value, sd);
  answer.illuminance_lx = Scaled(light.illuminance_lx, light_there.value, sd);
  answer.own.ln_light = sd;
  answer.color = ColorBetween(states, at, curves, answer.own);
  fit::AddSpectrumBetween(light, MixturesAround(states), answer);
  return answer;
}

}  // namespace

struct StateAnswers::Curves {
  KnownCurves known;
};

StateAnswers::StateAnswers(const FittedLight& light)
    : light_(light), curves_(std::make_unique<Curves>()) {}
StateAnswers::~StateAnswers() = default;

Result<StateAnswer> StateAnswers::At(const FixtureState& at) {
  if (auto fits = CheckControlsOf(light_, at); !fits) return Propagate(std::move(fits));
  return AnswerFrom(light_, at, light_.states.size(), curves_->known);
}

Result<StateAnswer> AnswerState(const FittedLight& light, const FixtureState& at) {
  return StateAnswers(light).At(at);
}

std::optional<StateAnswer> AnswerWithout(const FittedLight& light, std::size_t index) {
  const FixtureState at = light.states[index].state;
  const States others(light, at, index);
  if (others.kept().size() < 2 || !others.CheckInside() || !others.BetweenTwo()) {
    return std::nullopt;
  }
  KnownCurves curves;
  auto answer = AnswerFrom(light, at, index, curves);
  if (!answer) return std::nullopt;
  return *std::move(answer);
}

}  // namespace lightcal
