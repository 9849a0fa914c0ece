// SPDX-License-Identifier: Apache-2.0
// A value with its interval, and names, as light.json spells them. Internal to the records room.
#pragma once

#include <cmath>
#include <string>

#include "lightcal/core/uncertain.h"
#include "lightcal/records/field_reader.h"
#include "lightcal/records/field_rules.h"
#include "lightcal/records/field_writer.h"

namespace lightcal::records {

// What is read must agree with itself; what is written is the program's own.
inline void CheckInterval(FieldReader& reader, const std::string& key, const Uncertain& read) {
  constexpr double kRounding = 1e-9;
  const double room = kRounding * std::abs(read.value);
  const auto fail = [&](const std::string& end, const char* side) {
    reader.Fail(end, end + " lies " + side + " " + key +
                         ": a value lies between the ends of its 95 % interval");
  };
  const std::string ends = key == "value" ? "" : key + "_";
  if (read.low && *read.low > read.value + room) fail(ends + "low95", "above");
  if (read.high && *read.high < read.value - room) fail(ends + "high95", "below");
}
template <class SomeUncertain>
void CheckInterval(FieldWriter& /*writer*/, const char* /*key*/, const SomeUncertain& /*value*/) {}

inline void CheckNamed(FieldReader& reader, const std::string& name) {
  if (reader.Has("name") && name.empty()) reader.Fail("name", "name must not be empty");
}
inline void CheckNamed(FieldWriter& /*writer*/, const std::string& /*name*/) {}

template <class Archive, class SomeUncertain>
void VisitRuled(Archive& archive, SomeUncertain& uncertain, const NumberRule& rule) {
  archive.Number("value", uncertain.value, rule);
  archive.Number("u95", uncertain.u95, kNotNegative);
  archive.Number("low95", uncertain.low, rule);
  archive.Number("high95", uncertain.high, rule);
  archive.Require({"value", "u95"});
  CheckInterval(archive, "value", uncertain);
}

// One visitor per record, for both directions: what is written is what is read.
inline constexpr auto kVisitUncertain = [](auto& archive, auto& uncertain) {
  VisitRuled(archive, uncertain, kAnyNumber);
};
// Of what is never negative: light, and ratios of it.
inline constexpr auto kVisitAmount = [](auto& archive, auto& uncertain) {
  VisitRuled(archive, uncertain, kNotNegative);
};
inline constexpr auto kVisitKelvin = [](auto& archive, auto& uncertain) {
  VisitRuled(archive, uncertain, kPositive);
};

}  // namespace lightcal::records
