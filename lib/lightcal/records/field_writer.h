// SPDX-License-Identifier: Apache-2.0
// The mirror of FieldReader: the same methods, writing a record into a table. What is absent, empty
// text, false, or zero degrees is left out. Internal to the records room.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/core/units.h"
#include "lightcal/records/document.h"
#include "lightcal/records/field_rules.h"
#include "lightcal/records/fixture_state.h"

namespace lightcal::records {

class FieldWriter {
 public:
  void Number(std::string_view key, double value, const NumberRule& /*rule*/ = kAnyNumber) {
    Put(key, Unsigned0(value));
  }
  void Number(std::string_view key, const std::optional<double>& value,
              const NumberRule& /*rule*/ = kAnyNumber) {
    if (value) Put(key, Unsigned0(*value));
  }
  template <class Kind>
  void Number(std::string_view key, const std::optional<Quantity<Kind>>& value,
              const NumberRule& /*rule*/ = kAnyNumber) {
    if (value) Put(key, Unsigned0(value->value()));
  }
  template <class Kind>
  void Number(std::string_view key, const Quantity<Kind>& value,
              const NumberRule& /*rule*/ = kAnyNumber) {
    Put(key, Unsigned0(value.value()));
  }
  void Degrees(std::string_view key, Radians value, const NumberRule& rule);
  void Integer(std::string_view key, int value) { Put(key, value); }
  void Count(std::string_view key, int value) { Put(key, value); }
  void Text(std::string_view key, const std::string& value) {
    if (!value.empty()) Put(key, value);
  }
  void Flag(std::string_view key, bool value) {
    if (value) Put(key, true);
  }
  // As Flag, but written when false too.
  void Truth(std::string_view key, bool value) { Put(key, value); }
  template <class Enum>
  void Word(std::string_view key, Enum value, std::span<const std::string_view> words) {
    Put(key, words[static_cast<std::size_t>(value)]);
  }
  // The first word is what an absent key means.
  template <class Enum>
  void WordUnlessFirst(std::string_view key, Enum value, std::span<const std::string_view> words) {
    if (value != Enum{}) Word(key, value, words);
  }
  template <std::size_t N>
  void Array(std::string_view key, const std::optional<std::array<double, N>>& values,
             const NumberRule& /*rule*/ = kAnyNumber) {
    if (values) PutNumbers(key, *values);
  }
  template <std::size_t N>
  void Array(std::string_view key, const std::array<double, N>& values,
             const NumberRule& /*rule*/ = kAnyNumber) {
    PutNumbers(key, values);
  }
  void Numbers(std::string_view key, const std::vector<double>& values,
               const NumberRule& /*rule*/ = kAnyNumber) {
    PutNumbers(key, values);
  }
  void Chromaticity(std::string_view key, const std::optional<Xy>& xy) {
    if (xy) PutNumbers(key, std::array{xy->x, xy->y});
  }
  // As FieldReader::Controls; left out where there is none.
  void Controls(std::string_view key, const FixtureState& state);
  void Integers(std::string_view key, const std::vector<int>& values) { Put(key, values); }
  void Counts(std::string_view key, const std::vector<int>& values) { Put(key, values); }
  void Texts(std::string_view key, const std::vector<std::string>& values) { Put(key, values); }

  template <class T, class Visit>
  void Object(std::string_view key, const std::optional<T>& value, const Visit& visit) {
    if (value) Group(key, [&](auto& a) { visit(a, *value); });
  }
  template <class Visit>
  void Group(std::string_view key, const Visit& visit) {
    FieldWriter inner;
    visit(inner);
    if (!inner.table_.members.empty()) Put(key, std::move(inner.table_));
  }
  template <class T, class Visit>
  void List(std::string_view key, const std::vector<T>& values, const Visit& visit) {
    Put(key, Node::List(values, [&](const T& value) { return Visited(value, visit); }));
  }
  void Require(std::initializer_list<std::string_view> /*keys*/) {}

  void Put(std::string_view key, Node value) { table_.Put(key, std::move(value)); }
  [[nodiscard]] Node TakeTable() { return std::move(table_); }

  // The table that visit(archive, value) writes.
  template <class T, class Visit>
  [[nodiscard]] static Node Visited(const T& value, const Visit& visit) {
    FieldWriter writer;
    visit(writer, value);
    return writer.TakeTable();
  }

 private:
  // No file says -0.
  static double Unsigned0(double value) { return value == 0.0 ? 0.0 : value; }
  void PutNumbers(std::string_view key, std::span<const double> values) {
    Put(key, Node::List(values, Unsigned0));
  }

  Node table_ = Node::Table();
};

// Where a tree holds a number that is not finite ("lights[0].fit.condition"); absent where none.
[[nodiscard]] std::optional<std::string> FindNotFinite(const Node& node);

}  // namespace lightcal::records
