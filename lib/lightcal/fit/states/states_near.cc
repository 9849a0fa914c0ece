// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/states/states_near.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lightcal/core/numbers_text.h"

namespace lightcal::fit {
namespace {

// More states than these, nearest to it and to full, say nothing new of a place between them.
constexpr std::size_t kNearestStates = 20, kNearestToFull = 10;

bool SameNumbers(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

ControlKind KindOf(const std::string& name) {
  if (name == kCctControl) return ControlKind::kTemperature;
  if (name == kZoomControl) return ControlKind::kZoom;
  const bool other =
      name == "tint" || name == "hue" || name == "saturation" || name.ends_with("_deg");
  return other ? ControlKind::kOther : ControlKind::kLevel;
}

double OffsetAlong(const ControlAxis& axis, double here, double there) {
  return axis.kind == ControlKind::kLevel ? std::log((there + 0.03) / (here + 0.03)) / 3.0
                                          : (there - here) / (axis.most - axis.least);
}

}  // namespace

States::States(const FittedLight& light, const FixtureState& at, std::size_t without)
    : light_(light), at_(at) {
  for (std::size_t i = 0; i < light.states.size(); ++i) {
    if (i != without && SameWords(at_, light.states[i].state)) kept_.push_back(&light.states[i]);
  }
  FindAxes();
}

const MeasuredState* States::Exact(const FixtureState& state) const {
  for (const MeasuredState* one : kept_) {
    if (SameState(one->state, state)) return one;
  }
  return nullptr;
}

Result<void> States::CheckInside() const {
  for (const ControlValue& control : at_) {
    if (control.IsWord()) continue;
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (const MeasuredState* one : kept_) {
      const double there = NumberOfControl(one->state, control.name).value_or(0.0);
      least = std::min(least, there);
      most = std::max(most, there);
    }
    const bool inside = (control.number >= least || SameNumbers(control.number, least)) &&
                        (control.number <= most || SameNumbers(control.number, most));
    if (inside) continue;
    return Refused("outside_states", light_.name,
                   control.name + "=" + ShortestText(control.number) +
                       " lies outside of what was read (" + ShortestText(least) + " ... " +
                       ShortestText(most) +
                       "); how the fixture goes on there is not known: read it there");
  }
  return {};
}

bool States::BetweenTwo() const {
  return std::ranges::any_of(axes_, [&](const ControlAxis& axis) {
    bool below = false;
    bool above = false;
    const double here = NumberOfControl(at_, axis.name).value_or(0.0);
    for (const MeasuredState* one : kept_) {
      if (!OthersAlike(one->state, axis.name)) continue;
      const double there = NumberOfControl(one->state, axis.name).value_or(0.0);
      below = below || (there < here && !SameNumbers(there, here));
      above = above || (there > here && !SameNumbers(there, here));
    }
    return below && above;
  });
}

std::pair<const MeasuredState*, const MeasuredState*> States::DimmerNeighbours() const {
  const std::string dimmer(kDimmerControl);
  const auto here = NumberOfControl(at_, dimmer);
  std::pair<const MeasuredState*, const MeasuredState*> out{nullptr, nullptr};
  if (!here) return out;
  const auto label = [&](const MeasuredState* one) {
    return NumberOfControl(one->state, dimmer).value_or(0.0);
  };
  for (const MeasuredState* one : kept_) {
    if (!OthersAlike(one->state, dimmer) || SameNumbers(label(one), *here)) continue;
    const MeasuredState*& side = label(one) < *here ? out.first : out.second;
    const bool nearer =
        side == nullptr || std::abs(label(one) - *here) < std::abs(label(side) - *here);
    if (nearer) side = one;
  }
  return out;
}

std::vector<double> States::LabelsOf(const FixtureState& state) const {
  std::vector<double> labels;
  for (const ControlAxis& axis : axes_) {
    const double number = NumberOfControl(state, axis.name).value_or(0.0);
    const bool percent = axis.name == kDimmerControl;
    const double unit = axis.kind != ControlKind::kLevel ? 1.0 : percent ? 100.0 : axis.most;
    labels.push_back(unit > 0.0 ? number / unit : number);
  }
  return labels;
}

std::vector<ControlKind> States::Kinds() const {
  std::vector<ControlKind> kinds;
  for (const ControlAxis& axis : axes_) kinds.push_back(axis.kind);
  return kinds;
}

void States::KeepNearest() {
  if (kept_.size() <= kNearestStates + kNearestToFull) return;
  SortByDistance(Full(), kept_.begin());
  SortByDistance(at_, kept_.begin() + static_cast<std::ptrdiff_t>(kNearestToFull));
  kept_.resize(kNearestStates + kNearestToFull);
  std::ranges::sort(kept_);  // as they were read: the same ones make the same curve
}

std::vector<double> States::OffsetOf(const MeasuredState& one) const {
  const std::vector<double> here = LabelsOf(at_);
  std::vector<double> offset = LabelsOf(one.state);
  for (std::size_t i = 0; i < here.size(); ++i) {
    const ControlAxis& axis = axes_[i];
    const bool kelvin = axis.kind == ControlKind::kTemperature && axis.least > 0.0;
    offset[i] = kelvin ? (1.0 / offset[i] - 1.0 / here[i]) / (1.0 / axis.least - 1.0 / axis.most)
                       : OffsetAlong(axis, here[i], offset[i]);
  }
  return offset;
}

FixtureState States::Full() const {
  FixtureState full = at_;
  for (ControlValue& control : full) {
    if (control.name != kDimmerControl) continue;
    for (const ControlAxis& axis : axes_) {
      if (axis.name == kDimmerControl) control.number = axis.most;
    }
    return full;
  }
  const auto brightest = std::ranges::max_element(
      kept_, {}, [](const MeasuredState* one) { return one->relative.value; });
  return (*brightest)->state;
}

bool States::OthersAlike(const FixtureState& state, const std::string& but) const {
  return std::ranges::all_of(axes_, [&](const ControlAxis& axis) {
    return axis.name == but || SameNumbers(NumberOfControl(state, axis.name).value_or(0.0),
                                           NumberOfControl(at_, axis.name).value_or(0.0));
  });
}

void States::SortByDistance(const FixtureState& from,
                            std::vector<const MeasuredState*>::iterator begin) {
  const std::vector<double> here = LabelsOf(from);
  const auto far = [&](const MeasuredState* one) {
    const std::vector<double> there = LabelsOf(one->state);
    double sum = 0.0;
    for (std::size_t i = 0; i < here.size(); ++i) {
      const double off = OffsetAlong(axes_[i], here[i], there[i]);
      sum += off * off;
    }
    return sum;
  };
  std::stable_sort(begin, kept_.end(),
                   [&](const MeasuredState* a, const MeasuredState* b) { return far(a) < far(b); });
}

void States::FindAxes() {
  for (const ControlValue& control : at_) {
    if (control.IsWord()) continue;
    ControlAxis axis{control.name, KindOf(control.name), std::numeric_limits<double>::infinity(),
                     -std::numeric_limits<double>::infinity()};
    for (const MeasuredState* one : kept_) {
      const double there = NumberOfControl(one->state, control.name).value_or(0.0);
      axis.least = std::min(axis.least, there);
      axis.most = std::max(axis.most, there);
    }
    if (axis.kind == ControlKind::kLevel && axis.least < 0.0) axis.kind = ControlKind::kOther;
    if (axis.kind == ControlKind::kZoom && axis.least <= 0.0) axis.kind = ControlKind::kOther;
    if (axis.most > axis.least && !SameNumbers(axis.most, axis.least)) axes_.push_back(axis);
  }
}

}  // namespace lightcal::fit
