// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/json_codec.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "lightcal/records/field_writer.h"

namespace lightcal::records {
namespace {

constexpr std::size_t kDeepest = 64;

// Builds the tree from the parser's events, so that hostile nesting never reaches the stack.
class TreeBuilder : public nlohmann::json_sax<nlohmann::json> {
 public:
  bool null() override { return Put(Node{}); }
  bool boolean(bool value) override { return Put(Node(value)); }
  bool number_integer(number_integer_t value) override { return Put(Node(value)); }
  bool number_unsigned(number_unsigned_t value) override {
    constexpr auto kLargest =
        static_cast<number_unsigned_t>(std::numeric_limits<std::int64_t>::max());
    if (value > kLargest) return Put(Node(static_cast<double>(value)));
    return Put(Node(static_cast<std::int64_t>(value)));
  }
  bool number_float(number_float_t value, const string_t& /*text*/) override {
    return Put(Node(value));
  }
  bool string(string_t& value) override { return Put(Node(value)); }
  bool binary(binary_t& /*value*/) override { return Stop("binary value"); }
  bool start_object(std::size_t /*size*/) override { return Open(Node::Table()); }
  bool start_array(std::size_t /*size*/) override { return Open(Node::Array()); }
  bool end_object() override { return Close(); }
  bool end_array() override { return Close(); }

  bool key(string_t& name) override {
    if (open_.back().node.Find(name) != nullptr) {
      return Stop("key \"" + name + "\" is given twice");
    }
    open_.back().key = name;
    return true;
  }

  bool parse_error(std::size_t position, const std::string& token,
                   const nlohmann::detail::exception& error) override {
    const std::string what = error.what();
    // "unexpected end of input", and strings that stop before their quote.
    error_.at_end = what.find("unexpected end of input") != std::string::npos ||
                    what.find("missing closing quote") != std::string::npos;
    constexpr std::size_t kShownToken = 40;
    const auto detail = what.find("syntax error");
    error_.message = detail == std::string::npos
                         ? "number out of range near byte " + std::to_string(position)
                         : "not JSON at byte " + std::to_string(position) +
                               (token.empty() || token.size() > kShownToken
                                    ? std::string()
                                    : ", near \"" + Printable(token) + "\"");
    return false;
  }

  [[nodiscard]] Node TakeRoot() { return std::move(root_); }
  [[nodiscard]] JsonSyntaxError TakeError() { return std::move(error_); }

 private:
  struct OpenNode {
    Node node;
    std::string key;  // where the next value goes
  };

  static std::string Printable(const std::string& token) {
    std::string shown;
    for (const char c : token) shown += c >= ' ' && c <= '~' ? c : '?';
    return shown;
  }

  bool Stop(std::string message) {
    error_.message = std::move(message);
    return false;
  }

  bool Put(Node node) {
    if (open_.empty()) {
      root_ = std::move(node);
    } else if (OpenNode& parent = open_.back(); parent.node.kind == Node::Kind::kArray) {
      parent.node.items.push_back(std::move(node));
    } else {
      parent.node.members.emplace_back(parent.key, std::move(node));
    }
    return true;
  }

  bool Open(Node node) {
    if (open_.size() >= kDeepest) return Stop("nested deeper than 64 levels");
    open_.push_back({std::move(node), {}});
    return true;
  }

  bool Close() {
    Node closed = std::move(open_.back().node);
    open_.pop_back();
    return Put(std::move(closed));
  }

  Node root_;
  std::vector<OpenNode> open_;
  JsonSyntaxError error_;
};

class Printer {
 public:
  explicit Printer(JsonLayout layout) : pretty_(layout == JsonLayout::kPretty) {}

  void Print(const Node& node) {
    switch (node.kind) {
      case Node::Kind::kNull:
        text_ += "null";
        break;
      case Node::Kind::kBoolean:
        text_ += node.boolean ? "true" : "false";
        break;
      case Node::Kind::kInteger:
        text_ += std::to_string(node.integer);
        break;
      case Node::Kind::kNumber:
        text_ += nlohmann::json(node.number).dump();
        break;
      case Node::Kind::kText:
        PrintText(node.text);
        break;
      case Node::Kind::kArray:
        PrintAll(node.items, '[', ']', [&](const Node& item) { Print(item); });
        break;
      case Node::Kind::kTable:
        PrintAll(node.members, '{', '}', [&](const Member& member) {
          PrintText(member.key);
          text_ += pretty_ ? ": " : ":";
          Print(member.value);
        });
        break;
    }
  }

  [[nodiscard]] std::string Take() { return std::move(text_); }

 private:
  template <class T, class One>
  void PrintAll(const std::vector<T>& all, char open, char close, const One& one) {
    text_ += open;
    ++depth_;
    for (const T& each : all) {
      if (&each != all.data()) text_ += ',';
      NewLine();
      one(each);
    }
    --depth_;
    if (!all.empty()) NewLine();
    text_ += close;
  }
  void NewLine() {
    if (pretty_) text_.append(1, '\n').append(2 * depth_, ' ');
  }
  void PrintText(const std::string& text) {
    const bool plain = std::ranges::all_of(
        text, [](char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; });
    text_ +=
        plain ? '"' + text + '"'
              : nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }

  bool pretty_;
  std::size_t depth_ = 0;
  std::string text_;
};

}  // namespace

tl::expected<Node, JsonSyntaxError> ParseJson(std::string_view text) {
  TreeBuilder builder;
  if (!nlohmann::json::sax_parse(text.begin(), text.end(), &builder)) {
    return tl::unexpected(builder.TakeError());
  }
  return builder.TakeRoot();
}

std::string PrintJson(const Node& node, JsonLayout layout) {
  Printer printer(layout);
  printer.Print(node);
  return printer.Take();
}

Result<std::string> FiniteJson(const Node& node) {
  if (const auto where = FindNotFinite(node)) {
    return Failed("not_finite", *where, "is not a finite number and cannot be written");
  }
  return PrintJson(node, JsonLayout::kPretty) + "\n";
}

}  // namespace lightcal::records
