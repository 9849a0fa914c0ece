// SPDX-License-Identifier: Apache-2.0
// A document as a tree, whichever syntax it is written in: what the JSON and TOML codecs read and
// print, what the record codecs visit, and what commands answer. A tree is written as it will look:
//   Node light = {{"name", lamp.name}, {"cct_K", lamp.cct}, {"xy", {xy.x, xy.y}}};
// A member whose value is absent (an empty optional) is left out.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/units.h"

namespace lightcal::records {

struct Member;

struct Node {
  enum class Kind { kNull, kBoolean, kInteger, kNumber, kText, kArray, kTable };

  Kind kind = Kind::kNull;
  bool boolean = false;
  std::int64_t integer = 0;  // kInteger
  double number = 0.0;       // kNumber, and kInteger as the nearest double; may be NaN from TOML
  std::string text;
  std::vector<Node> items;      // kArray
  std::vector<Member> members;  // kTable, in file order
  int line = 0;                 // 1-based; 0 = the syntax does not say

  Node();  // null
  Node(const Node& other);
  Node(Node&& other) noexcept;
  Node& operator=(const Node& other);
  Node& operator=(Node&& other) noexcept;
  ~Node();
  template <std::same_as<bool> T>
  Node(T value) : kind(Kind::kBoolean), boolean(value) {}
  template <std::integral T>
  requires(!std::same_as<T, bool>) Node(T value)
      : Node(OfInteger(static_cast<std::int64_t>(value))) {}
  template <std::floating_point T>
  Node(T value) : Node(OfNumber(static_cast<double>(value))) {}
  template <class Unit>
  Node(const Quantity<Unit>& value) : Node(value.value()) {}
  Node(std::string_view value);
  Node(const std::string& value);
  Node(const char* value);
  template <class T>
  Node(const std::optional<T>& value) {
    if (value) *this = Node(*value);
  }
  template <class T>
  Node(const std::vector<T>& values) : Node(List(values)) {}
  template <class T, std::size_t N>
  Node(const std::array<T, N>& values) : Node(List(values)) {}
  Node(std::initializer_list<double> values);
  Node(std::initializer_list<int> values);
  Node(std::initializer_list<Member> all);  // a table

  [[nodiscard]] static Node Table();
  [[nodiscard]] static Node Array();
  // [value, ...]
  template <class Range>
  [[nodiscard]] static Node List(const Range& values) {
    return List(values, [](const auto& value) { return Node(value); });
  }
  // [of(value), ...]
  template <class Range, class Of>
  [[nodiscard]] static Node List(const Range& values, const Of& of) {
    Node array = Array();
    for (const auto& value : values) array.items.push_back(of(value));
    return array;
  }
  // Absent where a text, list or table holds nothing.
  [[nodiscard]] static Node UnlessEmpty(Node value);

  [[nodiscard]] bool IsNumber() const { return kind == Kind::kNumber || kind == Kind::kInteger; }
  // The member of a table, or null.
  [[nodiscard]] const Node* Find(std::string_view key) const;
  // The text of a member; empty where there is none.
  [[nodiscard]] std::string TextAt(std::string_view key) const;
  // One more member, unless its value is absent.
  void Put(std::string_view key, Node value);
  // The members of another table behind one's own.
  void Put(Node table);

 private:
  static Node OfInteger(std::int64_t value);
  static Node OfNumber(double value);
};

struct Member {
  Member(std::string_view name, Node held);

  std::string key;
  Node value;
};

// Where a member is whole: a vector of what is not yet whole can be named, not made.
inline Node::Node() = default;
inline Node::Node(const Node& other) = default;
inline Node::Node(Node&& other) noexcept = default;
inline Node& Node::operator=(const Node& other) = default;
inline Node& Node::operator=(Node&& other) noexcept = default;
inline Node::~Node() = default;

// "a number", "a table", ... for messages.
[[nodiscard]] std::string_view KindName(Node::Kind kind);

}  // namespace lightcal::records
