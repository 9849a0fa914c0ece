// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/field_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lightcal/core/nearest_word.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/printable.h"

namespace lightcal::records {
namespace {

constexpr std::size_t kLongestShown = 60;

std::string NumberText(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return ShortestText(value);
}

}  // namespace

std::string FaultOfNumber(std::string_view key, double value, const NumberRule& rule) {
  const bool finite = std::isfinite(value);
  if (finite && rule.holds(value)) return "";
  return std::string(key) + " = " + NumberText(value) + ": " +
         std::string(finite ? rule.demand : "must be a finite number");
}

std::string FaultOfText(std::string_view key, std::string_view value) {
  if (IsPrintable(value)) return "";
  return std::string(key) + " = " + Quoted(value) +
         " holds a control character, or one that turns the direction of writing";
}

std::string FaultOfChromaticity(std::string_view key, Xy xy) {
  if (IsPhysicalXy(xy)) return "";
  return std::string(key) + " = [" + NumberText(xy.x) + ", " + NumberText(xy.y) +
         "] is no CIE 1931 chromaticity: x >= 0, y > 0, x + y <= 1 (1.005 as a meter reads it)";
}

std::string Quoted(std::string_view text) {
  std::string shown = "\"" + Printable(text.substr(0, kLongestShown));
  if (text.size() > kLongestShown) shown += "...";
  return shown + "\"";
}

std::string DidYouMean(std::string_view word, std::span<const std::string_view> known) {
  const std::string nearest = word.size() <= kLongestShown ? NearestWord(word, known) : "";
  if (!nearest.empty()) return "; did you mean \"" + nearest + "\"?";
  if (known.empty()) return "";
  std::string text = "; known are";
  for (const std::string_view name : known) {
    text += (name == known.front() ? " " : ", ") + std::string(name);
  }
  return text;
}

FieldReader::FieldReader(const Node& table, std::string place, ReadingOfFile& file)
    : table_(&table), place_(std::move(place)), file_(&file) {}

bool FieldReader::IsTable() {
  if (table_->kind == Node::Kind::kTable) return true;
  Fail("", "must be a table, not " + std::string(KindName(table_->kind)));
  return false;
}

std::string FieldReader::PlacePrefix() const { return place_.empty() ? "" : place_ + ": "; }

std::string FieldReader::PlaceOf(std::string_view key) const {
  if (file_->style == PlaceStyle::kToml) return "[" + std::string(key) + "]";
  return place_.empty() ? std::string(key) : place_ + "." + std::string(key);
}

std::string FieldReader::PlaceOf(std::string_view key, std::size_t index) const {
  if (file_->style == PlaceStyle::kToml) {
    return "[[" + std::string(key) + "]] " + std::to_string(index + 1);
  }
  return PlaceOf(key) + "[" + std::to_string(index) + "]";
}

void FieldReader::Fail(const std::string& code, std::string_view key, const std::string& message) {
  if (file_->error) return;
  const Node* value = table_->Find(key);
  const int line = value != nullptr ? value->line : table_->line;
  const std::string subject = line > 0 ? file_->file + ":" + std::to_string(line) : file_->file;
  file_->error = Error{ErrorKind::kRefused, code, subject, PlacePrefix() + message};
}

const Node* FieldReader::Take(std::string_view key, std::optional<Node::Kind> kind) {
  known_.push_back(key);
  if (Failed()) return nullptr;
  const Node* value = table_->Find(key);
  if (value == nullptr || !kind || value->kind == *kind) return value;
  Fail(key, std::string(key) + " must be " + std::string(KindName(*kind)) + ", not " +
                std::string(KindName(value->kind)));
  return nullptr;
}

std::optional<double> FieldReader::NumberOf(const Node& node, std::string_view key,
                                            const NumberRule& rule) {
  if (!node.IsNumber()) {
    Fail(key, std::string(key) + " must be a number, not " + std::string(KindName(node.kind)));
    return std::nullopt;
  }
  const std::string fault = FaultOfNumber(key, node.number, rule);
  if (fault.empty()) return node.number;
  Fail(key, fault);
  return std::nullopt;
}

std::optional<double> FieldReader::TakeNumber(std::string_view key, const NumberRule& rule) {
  const Node* value = Take(key, std::nullopt);
  return value == nullptr ? std::nullopt : NumberOf(*value, key, rule);
}

std::optional<int> FieldReader::IntegerOf(const Node& node, std::string_view key) {
  const bool fits = node.kind == Node::Kind::kInteger &&
                    node.integer >= std::numeric_limits<int>::min() &&
                    node.integer <= std::numeric_limits<int>::max();
  if (fits) return static_cast<int>(node.integer);
  Fail(key, std::string(key) + " must be a whole number");
  return std::nullopt;
}

void FieldReader::Integer(std::string_view key, int& out) {
  const Node* value = Take(key, std::nullopt);
  if (value != nullptr) out = IntegerOf(*value, key).value_or(out);
}

void FieldReader::Count(std::string_view key, int& out) {
  Integer(key, out);
  if (out < 0) Fail(key, std::string(key) + " = " + std::to_string(out) + ": must not be negative");
}

void FieldReader::Text(std::string_view key, std::string& out) {
  const Node* value = Take(key, Node::Kind::kText);
  if (value == nullptr) return;
  const std::string fault = FaultOfText(key, value->text);
  if (!fault.empty()) return Fail(key, fault);
  out = value->text;
}

void FieldReader::Flag(std::string_view key, bool& out) {
  const Node* value = Take(key, Node::Kind::kBoolean);
  if (value != nullptr) out = value->boolean;
}

std::optional<std::size_t> FieldReader::TakeWord(std::string_view key,
                                                 std::span<const std::string_view> words) {
  const Node* value = Take(key, Node::Kind::kText);
  if (value == nullptr) return std::nullopt;
  const auto found = std::ranges::find(words, value->text);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  Fail(key, std::string(key) + " = " + Quoted(value->text) + " is unknown" +
                DidYouMean(value->text, words));
  return std::nullopt;
}

bool FieldReader::TakeNumbers(std::string_view key, std::span<double> out, const NumberRule& rule) {
  const Node* value = Take(key, Node::Kind::kArray);
  if (value == nullptr) return false;
  if (value->items.size() != out.size()) {
    Fail(key, std::string(key) + " must hold " + std::to_string(out.size()) + " numbers, not " +
                  std::to_string(value->items.size()));
    return false;
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto number = NumberOf(value->items[i], key, rule);
    if (!number) return false;
    out[i] = *number;
  }
  return true;
}

void FieldReader::Chromaticity(std::string_view key, std::optional<Xy>& out) {
  std::array<double, 2> xy{};
  if (!TakeNumbers(key, xy, kAnyNumber)) return;
  const std::string fault = FaultOfChromaticity(key, {xy[0], xy[1]});
  if (!fault.empty()) return Fail(key, fault);
  out = Xy{xy[0], xy[1]};
}

void FieldReader::Integers(std::string_view key, std::vector<int>& out) {
  const Node* value = Take(key, Node::Kind::kArray);
  if (value == nullptr) return;
  for (const Node& item : value->items) {
    if (const auto number = IntegerOf(item, key)) out.push_back(*number);
  }
}

void FieldReader::Counts(std::string_view key, std::vector<int>& out) {
  Integers(key, out);
  if (std::ranges::all_of(out, [](int number) { return number >= 0; })) return;
  Fail(key, std::string(key) + " must hold no negative number");
}

void FieldReader::Numbers(std::string_view key, std::vector<double>& out, const NumberRule& rule) {
  const Node* value = Take(key, Node::Kind::kArray);
  if (value == nullptr) return;
  for (const Node& item : value->items) {
    if (const auto number = NumberOf(item, key, rule)) out.push_back(*number);
  }
}

void FieldReader::RequireSchema(std::string_view schema, std::string_view document,
                                std::string_view otherwise) {
  std::string found;
  Text("schema", found);
  if (!Has("schema")) {
    Fail("schema", "schema is missing: this is no " + std::string(document) + " of lightcal");
  } else if (found != schema) {
    Fail("schema", "schema = " + Quoted(found) + ": this program reads " + std::string(schema) +
                       "; " + std::string(otherwise));
  }
}

void FieldReader::Texts(std::string_view key, std::vector<std::string>& out) {
  const Node* value = Take(key, Node::Kind::kArray);
  if (value == nullptr) return;
  for (const Node& item : value->items) {
    if (item.kind != Node::Kind::kText) {
      Fail(key, std::string(key) + " must hold text only");
      return;
    }
    out.push_back(item.text);
  }
}

void FieldReader::Controls(std::string_view key, FixtureState& out) {
  const Node* table = Take(key, Node::Kind::kTable);
  if (table == nullptr) return;
  FixtureState state;
  for (const Member& member : table->members) {
    const Node& value = member.value;
    const bool word = value.kind == Node::Kind::kText && !value.text.empty();
    if (!word && !value.IsNumber()) {
      return Fail(key, std::string(key) + "." + member.key + " must be a number or a word, not " +
                           std::string(KindName(value.kind)));
    }
    if (word) {
      if (const std::string fault = FaultOfText(key, value.text); !fault.empty()) {
        return Fail(key, fault);
      }
    }
    state.push_back({member.key, word ? 0.0 : value.number, word ? value.text : std::string()});
  }
  if (const std::string fault = FaultOfState(state); !fault.empty()) return Fail(key, fault);
  SortState(state);
  out = std::move(state);
}

void FieldReader::Require(std::initializer_list<std::string_view> keys) {
  required_.insert(required_.end(), keys);
}

void FieldReader::Finish() {
  for (const auto& [key, value] : table_->members) {
    if (lenient_ || std::ranges::find(known_, key) != known_.end()) continue;
    Fail("unknown_key", key, "unknown key " + Quoted(key) + DidYouMean(key, known_));
  }
  for (const std::string_view key : required_) {
    if (!Has(key)) Fail(key, std::string(key) + " is missing");
  }
}

}  // namespace lightcal::records
