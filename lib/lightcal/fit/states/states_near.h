// SPDX-License-Identifier: Apache-2.0
// The states of a lamp that were read and can tell of one that somebody asks for.
// Internal to this room.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/fit/states/control_curve.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::fit {

// A control that took several numbers in the states that count.
struct ControlAxis {
  std::string name;
  ControlKind kind = ControlKind::kOther;
  double least = 0.0, most = 0.0;
};

// Those with the words of the state asked for, but for the state `without` (an index into
// light.states; its size leaves out none). `light` and `at` must outlive it.
class States {
 public:
  States(const FittedLight& light, const FixtureState& at, std::size_t without);

  [[nodiscard]] const std::vector<const MeasuredState*>& kept() const { return kept_; }
  [[nodiscard]] const std::vector<ControlAxis>& axes() const { return axes_; }
  [[nodiscard]] const MeasuredState* Exact(const FixtureState& state) const;
  // Refused (outside_states) where a number lies beyond what was read.
  [[nodiscard]] Result<void> CheckInside() const;
  // Whether two states that were read differ from it in one control alone, on both sides.
  [[nodiscard]] bool BetweenTwo() const;
  // The nearest that differ in the dimmer alone, below and above; null where there is none.
  [[nodiscard]] std::pair<const MeasuredState*, const MeasuredState*> DimmerNeighbours() const;
  // One number an axis, as a curve takes it: levels as parts of the largest, a dimmer of 100.
  [[nodiscard]] std::vector<double> LabelsOf(const FixtureState& state) const;
  [[nodiscard]] std::vector<ControlKind> Kinds() const;
  // Keeps the nearest to the state asked for and to full, by ranges.
  void KeepNearest();
  // From the state asked for, in parts of each control's range; colour temperatures by their
  // mireds.
  [[nodiscard]] std::vector<double> OffsetOf(const MeasuredState& one) const;
  // The brightest this lamp is with the other controls as asked.
  [[nodiscard]] FixtureState Full() const;

 private:
  [[nodiscard]] bool OthersAlike(const FixtureState& state, const std::string& but) const;
  void SortByDistance(const FixtureState& from, std::vector<const MeasuredState*>::iterator begin);
  void FindAxes();

  const FittedLight& light_;
  const FixtureState& at_;
  std::vector<const MeasuredState*> kept_;
  std::vector<ControlAxis> axes_;
};

}  // namespace lightcal::fit
