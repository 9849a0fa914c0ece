// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/document.h"

#include <algorithm>
#include <array>

namespace lightcal::records {

Node Node::Table() {
  Node node;
  node.kind = Kind::kTable;
  return node;
}

Node Node::Array() {
  Node node;
  node.kind = Kind::kArray;
  return node;
}

Node Node::Text(std::string_view text) {
  Node node;
  node.kind = Kind::kText;
  node.text = text;
  return node;
}

Node Node::Number(double number) {
  Node node;
  node.kind = Kind::kNumber;
  node.number = number;
  return node;
}

Node Node::Integer(std::int64_t integer) {
  Node node;
  node.kind = Kind::kInteger;
  node.integer = integer;
  node.number = static_cast<double>(integer);
  return node;
}

Node Node::Boolean(bool boolean) {
  Node node;
  node.kind = Kind::kBoolean;
  node.boolean = boolean;
  return node;
}

const Node* Node::Find(std::string_view key) const {
  const auto found = std::ranges::find(members, key, &Member::key);
  return found == members.end() ? nullptr : &found->value;
}

std::string_view KindName(Node::Kind kind) {
  constexpr std::array<std::string_view, 7> kNames = {
      "null", "true or false", "a whole number", "a number", "text", "an array", "a table"};
  return kNames[static_cast<std::size_t>(kind)];
}

}  // namespace lightcal::records
