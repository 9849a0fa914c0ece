// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/transport/tape.h"

#include <array>
#include <charconv>
#include <optional>
#include <utility>

#include "lightcal/core/numbers_text.h"

namespace lightcal {
namespace {

constexpr std::string_view kFirstLine = "lightcal-tape 1";

struct HeaderField {
  std::string_view key;
  std::string Tape::* member;
};
constexpr std::array<HeaderField, 4> kHeader = {{{"driver", &Tape::driver},
                                                 {"device", &Tape::device},
                                                 {"recorded", &Tape::recorded},
                                                 {"note", &Tape::note}}};

struct Mark {
  std::string_view sign;
  TapeDirection direction;
};
constexpr std::array<Mark, 4> kMarks = {{{">", TapeDirection::kWrite},
                                         {"<", TapeDirection::kRead},
                                         {"!>", TapeDirection::kWriteFault},
                                         {"!<", TapeDirection::kReadFault}}};

bool IsFault(TapeDirection direction) {
  return direction == TapeDirection::kWriteFault || direction == TapeDirection::kReadFault;
}

std::string_view SignOf(TapeDirection direction) {
  for (const Mark& mark : kMarks) {
    if (mark.direction == direction) return mark.sign;
  }
  return "";
}

std::optional<Bytes> UnescapedBytes(std::string_view text) {
  Bytes bytes;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\') {
      if (text[i] <= ' ' || text[i] > '~') return std::nullopt;
      bytes.push_back(static_cast<std::byte>(text[i]));
      continue;
    }
    if (i + 4 > text.size() || text[i + 1] != 'x') return std::nullopt;
    unsigned value = 0;
    const char* const digits = text.data() + i + 2;
    const auto [end, error] = std::from_chars(digits, digits + 2, value, 16);
    if (error != std::errc() || end != digits + 2) return std::nullopt;
    bytes.push_back(static_cast<std::byte>(value));
    i += 3;
  }
  return bytes;
}

// The text before the first blank, and what follows it.
std::pair<std::string_view, std::string_view> SplitWord(std::string_view text) {
  const auto blank = text.find(' ');
  if (blank == std::string_view::npos) return {text, {}};
  return {text.substr(0, blank), text.substr(blank + 1)};
}

// Empty when the line is an exchange or a header field, otherwise what is wrong with it.
std::string ReadLine(std::string_view line, Tape& tape) {
  const auto [word, rest] = SplitWord(line);
  for (const HeaderField& field : kHeader) {
    if (field.key != word) continue;
    tape.*field.member = rest;
    return "";
  }
  for (const Mark& mark : kMarks) {
    if (mark.sign != word) continue;
    const auto [elapsed, payload] = SplitWord(rest);
    const auto milliseconds = ParseNumber(elapsed);
    if (!milliseconds || *milliseconds < 0.0) return "the time must be milliseconds, 0 or more";
    TapeLine exchange{mark.direction, *milliseconds, {}, ""};
    if (IsFault(mark.direction)) {
      exchange.code = payload;
      if (payload.empty()) return "a fault needs its word, such as timeout";
    } else {
      auto bytes = UnescapedBytes(payload);
      if (!bytes) return "bytes are printable ASCII or \\xHH";
      exchange.bytes = *std::move(bytes);
    }
    tape.lines.push_back(std::move(exchange));
    return "";
  }
  return "a line begins with > < !> !< driver device recorded or note";
}

}  // namespace

std::string EscapedBytes(std::span<const std::byte> bytes) {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string text;
  for (const std::byte b : bytes) {
    const auto value = std::to_integer<unsigned>(b);
    if (value > ' ' && value <= '~' && value != '\\') {
      text += static_cast<char>(value);
    } else {
      text += "\\x";
      text += kHex[value >> 4U];
      text += kHex[value & 0xFU];
    }
  }
  return text;
}

std::string TapeToText(const Tape& tape) {
  std::string text = std::string(kFirstLine) + "\n";
  for (const HeaderField& field : kHeader) {
    const std::string& value = tape.*field.member;
    if (!value.empty()) text += std::string(field.key) + " " + value + "\n";
  }
  for (const TapeLine& line : tape.lines) {
    text += std::string(SignOf(line.direction)) + " " + ShortestText(line.elapsed_ms) + " " +
            (IsFault(line.direction) ? line.code : EscapedBytes(line.bytes)) + "\n";
  }
  return text;
}

Result<Tape> TapeFromText(std::string_view text, std::string_view where) {
  Tape tape;
  int number = 0;
  while (!text.empty()) {
    const auto newline = text.find('\n');
    std::string_view line = text.substr(0, newline);
    text.remove_prefix(newline == std::string_view::npos ? text.size() : newline + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    ++number;
    std::string problem;
    if (number == 1) {
      if (line != kFirstLine) problem = "a tape begins with the line " + std::string(kFirstLine);
    } else if (!line.empty()) {
      problem = ReadLine(line, tape);
    }
    if (!problem.empty()) {
      return Refused("bad_tape", std::string(where) + ":" + std::to_string(number), problem);
    }
  }
  if (tape.driver.empty() || tape.lines.empty()) {
    return Refused("bad_tape", std::string(where), "holds no driver line or no exchange");
  }
  return tape;
}

}  // namespace lightcal
