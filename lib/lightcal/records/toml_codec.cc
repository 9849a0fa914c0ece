// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/toml_codec.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <sstream>
#include <utility>

namespace lightcal::records {
namespace {

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// Whether the dot at `dot` is the decimal point of a number and not a joint of a dotted key. At
// most every second joint of a key such as 1.1.1 can pass for one.
bool IsDecimalPoint(std::string_view line, std::size_t dot) {
  std::size_t first = dot;
  while (first > 0 && IsDigit(line[first - 1])) --first;
  std::size_t end = dot + 1;
  while (end < line.size() && IsDigit(line[end])) ++end;
  if (first == dot || end == dot + 1) return false;
  if (first > 0 && (line[first - 1] == '-' || line[first - 1] == '+')) --first;
  constexpr std::string_view kBefore = " \t,[=";
  const bool starts = first == 0 || kBefore.find(line[first - 1]) != std::string_view::npos;
  return starts && (end == line.size() || line[end] != '.');
}

std::size_t KeyJoints(std::string_view line) {
  std::size_t joints = 0;
  for (std::size_t dot = line.find('.'); dot != std::string_view::npos;
       dot = line.find('.', dot + 1)) {
    if (!IsDecimalPoint(line, dot)) ++joints;
  }
  return joints;
}

// toml++ 3.3 frees a table by recursion and limits only nested values, so that one key with 40 000
// dots overruns an 8 MB stack. Bounds the depth before parsing: at most 8 joints on each line of a
// chain of 256 values, plus 1000 joints on longer lines. Returns the offending line, 0 when none.
int LineWithTooDeepKey(std::string_view text) {
  constexpr std::size_t kFreeJoints = 8;
  constexpr std::size_t kMostJoints = 1000;
  std::size_t spent = 0;
  int number = 0;
  while (!text.empty()) {
    ++number;
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::size_t joints = KeyJoints(text.substr(0, end));
    if (joints > kFreeJoints) spent += joints;
    if (spent > kMostJoints) return number;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return 0;
}

int LineOf(const toml::source_region& region) { return static_cast<int>(region.begin.line); }

Node NodeFromToml(const toml::node& from);

Node NodeFromTable(const toml::table& from) {
  Node node = Node::Table();
  for (const auto& [key, value] : from) {
    Node member = NodeFromToml(value);
    if (key.source().begin.line != 0) member.line = LineOf(key.source());
    node.members.emplace_back(key.str(), std::move(member));
  }
  return node;
}

Node NodeFromArray(const toml::array& from) {
  Node node = Node::Array();
  for (const toml::node& item : from) node.items.push_back(NodeFromToml(item));
  return node;
}

template <class Date>
Node NodeFromDate(const Date& date) {
  std::ostringstream text;
  text << date;
  return Node(text.str());
}

Node NodeFromValue(const toml::node& from) {
  if (const auto* text = from.as_string()) return Node(text->get());
  if (const auto* integer = from.as_integer()) return Node(integer->get());
  if (const auto* number = from.as_floating_point()) return Node(number->get());
  if (const auto* boolean = from.as_boolean()) return Node(boolean->get());
  if (const auto* date = from.as_date()) return NodeFromDate(date->get());
  if (const auto* time = from.as_time()) return NodeFromDate(time->get());
  if (const auto* both = from.as_date_time()) return NodeFromDate(both->get());
  return {};
}

Node NodeFromToml(const toml::node& from) {
  const toml::table* table = from.as_table();
  const toml::array* array = from.as_array();
  Node node = table != nullptr   ? NodeFromTable(*table)
              : array != nullptr ? NodeFromArray(*array)
                                 : NodeFromValue(from);
  node.line = LineOf(from.source());
  return node;
}

}  // namespace

tl::expected<Node, TomlSyntaxError> ParseToml(std::string_view text) {
  if (const int line = LineWithTooDeepKey(text); line != 0) {
    return tl::unexpected(TomlSyntaxError{"keys are nested too deeply", line});
  }
  try {
    return NodeFromToml(toml::parse(text, std::string_view()));
  } catch (const toml::parse_error& error) {
    return tl::unexpected(
        TomlSyntaxError{std::string(error.description()), LineOf(error.source())});
  } catch (const std::exception& error) {
    return tl::unexpected(TomlSyntaxError{error.what(), 0});
  }
}

}  // namespace lightcal::records
