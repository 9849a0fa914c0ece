// SPDX-License-Identifier: Apache-2.0
// A file's content as a tree, whichever syntax it was written in: what the JSON and TOML codecs
// produce and what the record codecs read and write. Internal to the records room.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

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

  [[nodiscard]] static Node Table();
  [[nodiscard]] static Node Array();
  [[nodiscard]] static Node Text(std::string_view text);
  [[nodiscard]] static Node Number(double number);
  [[nodiscard]] static Node Integer(std::int64_t integer);
  [[nodiscard]] static Node Boolean(bool boolean);

  [[nodiscard]] bool IsNumber() const { return kind == Kind::kNumber || kind == Kind::kInteger; }
  // The member of a table, or null.
  [[nodiscard]] const Node* Find(std::string_view key) const;
};

struct Member {
  std::string key;
  Node value;
};

// "a number", "a table", ... for messages.
[[nodiscard]] std::string_view KindName(Node::Kind kind);

}  // namespace lightcal::records
