// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/document.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace lightcal::records {

Node::Node(std::string_view value) : kind(Kind::kText), text(value) {}
Node::Node(const std::string& value) : kind(Kind::kText), text(value) {}
Node::Node(const char* value) : kind(Kind::kText), text(value) {}
Node::Node(std::initializer_list<double> values) : Node(List(values)) {}
Node::Node(std::initializer_list<int> values) : Node(List(values)) {}
Node::Node(std::initializer_list<Member> all) : kind(Kind::kTable) {
  members.reserve(all.size());
  for (const Member& member : all) {
    if (member.value.kind != Kind::kNull) members.push_back(member);
  }
}

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

Node Node::OfInteger(std::int64_t value) {
  Node node;
  node.kind = Kind::kInteger;
  node.integer = value;
  node.number = static_cast<double>(value);
  return node;
}

Node Node::OfNumber(double value) {
  Node node;
  node.kind = Kind::kNumber;
  node.number = value;
  return node;
}

Node Node::UnlessEmpty(Node value) {
  const bool empty = value.text.empty() && value.items.empty() && value.members.empty();
  return empty ? Node() : value;
}

const Node* Node::Find(std::string_view key) const {
  const auto found = std::ranges::find(members, key, &Member::key);
  return found == members.end() ? nullptr : &found->value;
}

std::string Node::TextAt(std::string_view key) const {
  const Node* member = Find(key);
  return member != nullptr ? member->text : std::string();
}

void Node::Put(std::string_view key, Node value) {
  if (kind == Kind::kNull) kind = Kind::kTable;
  if (value.kind != Kind::kNull) members.emplace_back(key, std::move(value));
}

void Node::Put(Node table) { std::ranges::move(table.members, std::back_inserter(members)); }

Member::Member(std::string_view name, Node held) : key(name), value(std::move(held)) {}

std::string_view KindName(Node::Kind kind) {
  constexpr std::array<std::string_view, 7> kNames = {
      "null", "true or false", "a whole number", "a number", "text", "an array", "a table"};
  return kNames[static_cast<std::size_t>(kind)];
}

}  // namespace lightcal::records
