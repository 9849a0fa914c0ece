// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/json_codec.h"

#include <limits>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace lightcal::records {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kDeepest = 64;

// Builds the tree from the parser's events, so that hostile nesting never reaches the stack.
class TreeBuilder : public nlohmann::json_sax<nlohmann::json> {
 public:
  bool null() override { return Put(Node{}); }
  bool boolean(bool value) override { return Put(Node::Boolean(value)); }
  bool number_integer(number_integer_t value) override { return Put(Node::Integer(value)); }
  bool number_unsigned(number_unsigned_t value) override {
    constexpr auto kLargest =
        static_cast<number_unsigned_t>(std::numeric_limits<std::int64_t>::max());
    if (value > kLargest) return Put(Node::Number(static_cast<double>(value)));
    return Put(Node::Integer(static_cast<std::int64_t>(value)));
  }
  bool number_float(number_float_t value, const string_t& /*text*/) override {
    return Put(Node::Number(value));
  }
  bool string(string_t& value) override { return Put(Node::Text(value)); }
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
      parent.node.members.push_back({std::move(parent.key), std::move(node)});
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

Json JsonFromNode(const Node& node) {
  switch (node.kind) {
    case Node::Kind::kNull:
      return nullptr;
    case Node::Kind::kBoolean:
      return node.boolean;
    case Node::Kind::kInteger:
      return node.integer;
    case Node::Kind::kNumber:
      return node.number == 0.0 ? Json(0.0) : Json(node.number);
    case Node::Kind::kText:
      return node.text;
    case Node::Kind::kArray: {
      Json array = Json::array();
      for (const Node& item : node.items) array.push_back(JsonFromNode(item));
      return array;
    }
    case Node::Kind::kTable: {
      Json table = Json::object();
      for (const auto& [key, value] : node.members) table[key] = JsonFromNode(value);
      return table;
    }
  }
  return nullptr;
}

}  // namespace

tl::expected<Node, JsonSyntaxError> ParseJson(std::string_view text) {
  TreeBuilder builder;
  if (!nlohmann::json::sax_parse(text.begin(), text.end(), &builder)) {
    return tl::unexpected(builder.TakeError());
  }
  return builder.TakeRoot();
}

std::string PrintJson(const Node& node, JsonLayout layout) {
  const int indent = layout == JsonLayout::kPretty ? 2 : -1;
  return JsonFromNode(node).dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace lightcal::records
