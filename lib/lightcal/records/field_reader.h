// SPDX-License-Identifier: Apache-2.0
// Reads the keys of one table into a record, strictly: a key nobody asked for, a wrong type, a
// number that is not finite or breaks its rule is an error that names file, line and key. The first
// error stays; later calls do nothing. FieldWriter has the same methods, so that one visitor serves
// both directions. Internal to the records room.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/records/document.h"
#include "lightcal/records/field_rules.h"
#include "lightcal/records/fixture_state.h"

namespace lightcal::records {

// How tables inside tables are named in messages.
enum class PlaceStyle {
  kToml,  // [[reading]] 3
  kJson,  // lights[2].cone
};

// One file being read.
struct ReadingOfFile {
  std::string file;
  std::string bad_code;  // of every error but an unknown key
  PlaceStyle style = PlaceStyle::kJson;
  std::optional<Error> error;
};

class FieldReader {
 public:
  // table and file outlive the reader. place is "" at the root.
  FieldReader(const Node& table, std::string place, ReadingOfFile& file);

  template <class T>
  void Number(std::string_view key, std::optional<T>& out, const NumberRule& rule = kAnyNumber) {
    if (const auto value = TakeNumber(key, rule)) out = T(*value);
  }
  void Number(std::string_view key, double& out, const NumberRule& rule = kAnyNumber) {
    out = TakeNumber(key, rule).value_or(out);
  }
  template <class Kind>
  void Number(std::string_view key, Quantity<Kind>& out, const NumberRule& rule = kAnyNumber) {
    if (const auto value = TakeNumber(key, rule)) out = Quantity<Kind>(*value);
  }
  void Degrees(std::string_view key, std::optional<Radians>& out, const NumberRule& rule) {
    if (const auto value = TakeNumber(key, rule)) out = RadiansFromDegrees(*value);
  }
  void Degrees(std::string_view key, Radians& out, const NumberRule& rule) {
    if (const auto value = TakeNumber(key, rule)) out = RadiansFromDegrees(*value);
  }
  void Integer(std::string_view key, int& out);
  // A whole number of things, or a place among them: not negative.
  void Count(std::string_view key, int& out);
  void Text(std::string_view key, std::string& out);
  void Flag(std::string_view key, bool& out);
  void Truth(std::string_view key, bool& out) { Flag(key, out); }
  template <class Enum>
  void Word(std::string_view key, Enum& out, std::span<const std::string_view> words) {
    if (const auto index = TakeWord(key, words)) out = static_cast<Enum>(*index);
  }
  template <class Enum>
  void Word(std::string_view key, std::optional<Enum>& out,
            std::span<const std::string_view> words) {
    if (const auto index = TakeWord(key, words)) out = static_cast<Enum>(*index);
  }
  template <class Enum>
  void WordUnlessFirst(std::string_view key, Enum& out, std::span<const std::string_view> words) {
    Word(key, out, words);
  }
  template <std::size_t N>
  void Array(std::string_view key, std::array<double, N>& out,
             const NumberRule& rule = kAnyNumber) {
    TakeNumbers(key, out, rule);
  }
  template <std::size_t N>
  void Array(std::string_view key, std::optional<std::array<double, N>>& out,
             const NumberRule& rule = kAnyNumber) {
    std::array<double, N> values{};
    if (TakeNumbers(key, values, rule)) out = values;
  }
  // [x, y] of a real colour: x >= 0, y > 0, x + y <= 1.
  void Chromaticity(std::string_view key, std::optional<Xy>& out);
  void Integers(std::string_view key, std::vector<int>& out);
  void Counts(std::string_view key, std::vector<int>& out);
  void Numbers(std::string_view key, std::vector<double>& out, const NumberRule& rule);
  void Texts(std::string_view key, std::vector<std::string>& out);
  // A table of numbers and words under names of the person's own, each once: a fixture's state.
  void Controls(std::string_view key, FixtureState& out);
  // A table of numbers under names of the person's own: { key = 2.0, fill = 1.5 }.
  template <class T>
  void NumbersByName(std::string_view key, std::vector<std::pair<std::string, T>>& out,
                     const NumberRule& rule) {
    const Node* table = Take(key, Node::Kind::kTable);
    for (std::size_t i = 0; table != nullptr && i < table->members.size(); ++i) {
      const Member& member = table->members[i];
      if (const auto value = NumberOf(member.value, key, rule)) {
        out.emplace_back(member.key, T(*value));
      }
    }
  }

  // A table of its own that becomes *out; visit(archive, value).
  template <class T, class Visit>
  void Object(std::string_view key, std::optional<T>& out, const Visit& visit) {
    if (Take(key, Node::Kind::kTable) != nullptr)
      Group(key, [&](auto& a) { visit(a, out.emplace()); });
  }
  // A table of its own that holds some of this record's fields; visit(archive).
  template <class Visit>
  void Group(std::string_view key, const Visit& visit) {
    const Node* table = Take(key, Node::Kind::kTable);
    if (table == nullptr) return;
    FieldReader inner(*table, PlaceOf(key), *file_);
    visit(inner);
    inner.Finish();
  }
  // An array of tables; visit(archive, element).
  template <class T, class Visit>
  void List(std::string_view key, std::vector<T>& out, const Visit& visit) {
    const Node* array = Take(key, Node::Kind::kArray);
    if (array == nullptr) return;
    for (std::size_t i = 0; i < array->items.size() && !file_->error; ++i) {
      const Node& item = array->items[i];
      FieldReader inner(item, PlaceOf(key, i), *file_);
      if (inner.IsTable()) visit(inner, out.emplace_back());
      inner.Finish();
    }
  }

  // Says that these keys must be there.
  void Require(std::initializer_list<std::string_view> keys);
  // Refuses a document ("light.json") of another schema than this; `otherwise`: what to do then.
  void RequireSchema(std::string_view schema, std::string_view document,
                     std::string_view otherwise);
  // Takes a key without reading it.
  void Ignore(std::string_view key) { (void)Take(key, std::nullopt); }
  // This table may hold more than is asked for.
  void IgnoreRest() { lenient_ = true; }
  [[nodiscard]] bool Has(std::string_view key) const { return table_->Find(key) != nullptr; }

  // Refuses the value of `key`, or the table itself where the key is absent.
  void Fail(std::string_view key, const std::string& message) {
    Fail(file_->bad_code, key, message);
  }
  void Fail(const std::string& code, std::string_view key, const std::string& message);
  // Refuses unknown and missing keys; called after the visitor.
  void Finish();
  [[nodiscard]] bool Failed() const { return file_->error.has_value(); }
  [[nodiscard]] const std::string& Place() const { return place_; }

 private:
  [[nodiscard]] bool IsTable();
  // The value of a known key when it is there and of this kind (a mismatch is an error).
  const Node* Take(std::string_view key, std::optional<Node::Kind> kind);
  std::optional<double> TakeNumber(std::string_view key, const NumberRule& rule);
  std::optional<double> NumberOf(const Node& node, std::string_view key, const NumberRule& rule);
  std::optional<int> IntegerOf(const Node& node, std::string_view key);
  std::optional<std::size_t> TakeWord(std::string_view key,
                                      std::span<const std::string_view> words);
  bool TakeNumbers(std::string_view key, std::span<double> out, const NumberRule& rule);
  [[nodiscard]] std::string PlaceOf(std::string_view key) const;
  [[nodiscard]] std::string PlaceOf(std::string_view key, std::size_t index) const;
  [[nodiscard]] std::string PlacePrefix() const;  // "[[reading]] 3: ", "" at the root

  const Node* table_;
  std::string place_;
  ReadingOfFile* file_;
  std::vector<std::string_view> known_;
  std::vector<std::string_view> required_;
  bool lenient_ = false;
};

// `; did you mean "distance_m"?`, or the known words where none is near.
[[nodiscard]] std::string DidYouMean(std::string_view word,
                                     std::span<const std::string_view> known);
// Foreign text as it may stand in a message: quoted, printable, at most 60 bytes.
[[nodiscard]] std::string Quoted(std::string_view text);

}  // namespace lightcal::records
