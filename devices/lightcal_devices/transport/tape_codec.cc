// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/transport/tape_codec.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <initializer_list>
#include <optional>
#include <utility>

#include "lightcal/records/json_codec.h"

namespace lightcal::devices {
namespace {

using records::Node;

constexpr std::string_view kSchema = "lightcal.tape/1";
constexpr std::array<std::string_view, 3> kOperations = {"write", "read", "control"};

struct HeaderField {
  const char* key;
  std::string Tape::*member;
};
constexpr std::array<HeaderField, 5> kHeader = {{{"driver", &Tape::driver},
                                                 {"device", &Tape::device},
                                                 {"recorded", &Tape::recorded},
                                                 {"settings", &Tape::settings},
                                                 {"note", &Tape::note}}};

bool IsText(const Bytes& bytes) {
  return std::ranges::all_of(bytes, [](std::byte b) { return b < std::byte{0x7f}; });
}

std::string HexText(const Bytes& bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const std::byte b : bytes) {
    text += kDigits[std::to_integer<unsigned>(b) >> 4U];
    text += kDigits[std::to_integer<unsigned>(b) & 0xFU];
  }
  return text;
}

std::optional<Bytes> BytesFromHex(std::string_view text) {
  if (text.size() % 2 != 0) return std::nullopt;
  Bytes bytes;
  for (std::size_t i = 0; i < text.size(); i += 2) {
    unsigned value = 0;
    const char* const digits = text.data() + i;
    const auto [end, error] = std::from_chars(digits, digits + 2, value, 16);
    if (error != std::errc() || end != digits + 2) return std::nullopt;
    bytes.push_back(static_cast<std::byte>(value));
  }
  return bytes;
}

void PutBytes(Node& line, const std::string& key, const Bytes& bytes) {
  if (bytes.empty()) return;
  if (IsText(bytes)) {
    std::string text(bytes.size(), ' ');
    std::ranges::transform(bytes, text.begin(), [](std::byte b) { return static_cast<char>(b); });
    line.Put(key, text);
  } else {
    line.Put(key + "_hex", HexText(bytes));
  }
}

std::string LineText(const Node& line) {
  return PrintJson(line, records::JsonLayout::kOneLine) + "\n";
}

// One line's keys, taken one after the other; the first problem stays.
class LineReader {
 public:
  explicit LineReader(std::string_view text) {
    line_ = records::ParseJson(text).value_or(Node());
    if (line_.kind != Node::Kind::kTable) problem_ = "a line is one JSON object";
  }

  void CheckKeys(std::initializer_list<std::string_view> known) {
    if (!problem_.empty()) return;
    const bool all_known = std::ranges::all_of(line_.members, [&](const records::Member& member) {
      return std::ranges::find(known, member.key) != known.end();
    });
    if (all_known) return;
    problem_ = "has a key that is none of";
    for (const std::string_view key : known) problem_ += " " + std::string(key);
  }
  std::optional<std::string> Text(const char* key) {
    const Node* value = Find(key);
    if (value == nullptr) return std::nullopt;
    if (value->kind == Node::Kind::kText) return value->text;
    problem_ = std::string(key) + " must be a text";
    return std::nullopt;
  }
  double Milliseconds() {
    const Node* value = Find("t_ms");
    if (value != nullptr && value->IsNumber() && value->number >= 0.0) return value->number;
    Fail("t_ms must be milliseconds, 0 or more");
    return 0.0;
  }
  Bytes TakeBytes(const std::string& key) {
    if (const auto hex = Text((key + "_hex").c_str())) {
      auto bytes = BytesFromHex(*hex);
      if (!bytes) Fail(key + "_hex must be pairs of hexadecimal digits");
      return std::move(bytes).value_or(Bytes());
    }
    const std::string text = Text(key.c_str()).value_or("");
    const auto span = AsBytes(text);
    Bytes bytes(span.begin(), span.end());
    if (!IsText(bytes)) Fail(key + " holds a character beyond ~; write " + key + "_hex");
    return bytes;
  }
  void Fail(const std::string& problem) {
    if (problem_.empty()) problem_ = problem;
  }
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  const Node* Find(const char* key) { return problem_.empty() ? line_.Find(key) : nullptr; }

  Node line_;
  std::string problem_;
};

std::string ReadHeader(std::string_view text, Tape& tape) {
  LineReader line(text);
  if (line.problem().empty() && line.Text("schema") != kSchema) {
    return "a tape begins with {\"schema\":\"" + std::string(kSchema) + "\",\"driver\":...}";
  }
  line.CheckKeys({"schema", "driver", "device", "recorded", "settings", "note"});
  for (const HeaderField& field : kHeader) {
    tape.*field.member = line.Text(field.key).value_or("");
  }
  if (tape.driver.empty()) line.Fail("the first line names no driver");
  return line.problem();
}

std::string ReadExchange(std::string_view text, Tape& tape) {
  LineReader line(text);
  line.CheckKeys({"t_ms", "op", "verb", "sent", "sent_hex", "got", "got_hex", "fault"});
  TapeExchange exchange;
  exchange.elapsed_ms = line.Milliseconds();
  const auto* const word = std::ranges::find(kOperations, line.Text("op").value_or(""));
  if (word == kOperations.end()) {
    line.Fail("op must be write, read or control");
    return line.problem();
  }
  exchange.operation = static_cast<TapeOperation>(word - kOperations.begin());
  exchange.verb = line.Text("verb").value_or("");
  exchange.sent = line.TakeBytes("sent");
  exchange.received = line.TakeBytes("got");
  exchange.fault = line.Text("fault").value_or("");
  const bool controls = exchange.operation == TapeOperation::kControl;
  if (controls == exchange.verb.empty()) line.Fail("a control has a verb, and only a control");
  if (exchange.operation == TapeOperation::kRead && !exchange.sent.empty()) {
    line.Fail("a read sends nothing");
  }
  if ((exchange.operation == TapeOperation::kWrite || !exchange.fault.empty()) &&
      !exchange.received.empty()) {
    line.Fail("a write, and what failed, gets nothing");
  }
  tape.exchanges.push_back(std::move(exchange));
  return line.problem();
}

}  // namespace

std::string TapeToText(const Tape& tape) {
  Node header = {{"schema", kSchema}};
  for (const HeaderField& field : kHeader) {
    header.Put(field.key, Node::UnlessEmpty(tape.*field.member));
  }
  std::string text = LineText(header);
  for (const TapeExchange& exchange : tape.exchanges) {
    Node line = {{"t_ms", exchange.elapsed_ms},
                 {"op", kOperations[static_cast<std::size_t>(exchange.operation)]}};
    line.Put("verb", Node::UnlessEmpty(exchange.verb));
    PutBytes(line, "sent", exchange.sent);
    PutBytes(line, "got", exchange.received);
    line.Put("fault", Node::UnlessEmpty(exchange.fault));
    text += LineText(line);
  }
  return text;
}

Result<Tape> TapeFromText(std::string_view text, std::string_view where) {
  Tape tape;
  int number = 0;
  while (!text.empty()) {
    const auto newline = text.find('\n');
    const std::string_view line = text.substr(0, newline);
    text.remove_prefix(newline == std::string_view::npos ? text.size() : newline + 1);
    ++number;
    if (number > 1 && line.empty()) continue;
    const std::string problem = number == 1 ? ReadHeader(line, tape) : ReadExchange(line, tape);
    if (!problem.empty()) {
      return Refused("bad_tape", std::string(where) + ":" + std::to_string(number), problem);
    }
  }
  if (tape.exchanges.empty()) {
    return Refused("bad_tape", std::string(where), "holds no exchange with a meter");
  }
  return tape;
}

}  // namespace lightcal::devices
