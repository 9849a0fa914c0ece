// SPDX-License-Identifier: Apache-2.0
// An archive that neither reads nor writes: the rules of a record's fields alone, for records that
// no file was read for. The first fault stays. Internal to the records room.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "lightcal/core/units.h"
#include "lightcal/records/field_rules.h"
#include "lightcal/records/fixture_state.h"
#include "lightcal/records/reading.h"

namespace lightcal::records {

class FieldChecker {
 public:
  template <class Unit>
  void Number(const char* key, const std::optional<Quantity<Unit>>& value,
              const NumberRule& rule = kAnyNumber) {
    if (value) Number(key, value->value(), rule);
  }
  void Number(const char* key, const std::optional<double>& value,
              const NumberRule& rule = kAnyNumber) {
    if (value) Number(key, *value, rule);
  }
  void Number(const char* key, double value, const NumberRule& rule = kAnyNumber) {
    Keep(key, FaultOfNumber(key, value, rule));
  }
  template <std::size_t N>
  void Array(const char* key, const std::array<double, N>& values,
             const NumberRule& rule = kAnyNumber) {
    for (const double value : values) Number(key, value, rule);
  }
  template <std::size_t N>
  void Array(const char* key, const std::optional<std::array<double, N>>& values,
             const NumberRule& rule = kAnyNumber) {
    if (values) Array(key, *values, rule);
  }
  void Degrees(const char* key, Radians value, const NumberRule& rule) {
    Number(key, DegreesFromRadians(value), rule);
  }
  void Degrees(const char* key, const std::optional<Radians>& value, const NumberRule& rule) {
    if (value) Degrees(key, *value, rule);
  }
  void Text(const char* key, const std::string& value) { Keep(key, FaultOfText(key, value)); }
  void Chromaticity(const char* key, const std::optional<Xy>& xy) {
    if (xy) Keep(key, FaultOfChromaticity(key, *xy));
  }
  void Flag(const char* /*key*/, bool /*value*/) {}
  void Controls(const char* key, const FixtureState& state) { Keep(key, FaultOfState(state)); }
  template <class Enum, class Words>
  void Word(const char* /*key*/, const Enum& /*value*/, const Words& /*words*/) {}
  template <class Enum, class Words>
  void WordUnlessFirst(const char* /*key*/, Enum /*value*/, const Words& /*words*/) {}

  void Keep(const char* key, std::string message) {
    if (!fault_ && !message.empty()) fault_ = ReadingFault{key, std::move(message)};
  }
  void Keep(std::optional<ReadingFault> fault) {
    if (!fault_) fault_ = std::move(fault);
  }
  [[nodiscard]] const std::optional<ReadingFault>& fault() const { return fault_; }

 private:
  std::optional<ReadingFault> fault_;
};

}  // namespace lightcal::records
