// SPDX-License-Identifier: Apache-2.0
// The numbers behind an IES file's header. Internal to the records room.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/records/photometric_text.h"

namespace lightcal::records {

class Numbers {
 public:
  // Commas part numbers, or stand in them as decimal points.
  enum class Commas : std::uint8_t { kPart, kDecimal };
  // first_line: of the file, where the text begins.
  Numbers(std::string_view text, std::string_view where, Commas commas = Commas::kPart,
          int first_line = 1)
      : all_(text),
        text_(text),
        where_(where),
        decimal_(commas == Commas::kDecimal),
        first_line_(first_line) {}

  // The next number; what it is goes into the message. Once one fails, all fail.
  double Take(std::string_view what) {
    SkipBlanks();
    if (error_) return 0.0;
    if (text_.empty()) {
      Fail(std::string(what) + " is missing: the file ends too early");
      return 0.0;
    }
    const std::size_t end = std::min(text_.find_first_of(Blanks()), text_.size());
    const std::string_view token = text_.substr(0, end);
    text_.remove_prefix(end);
    constexpr std::size_t kLongestNumber = 64;
    const auto value =
        token.size() <= kLongestNumber ? ParseNumber(token, Decimal(token)) : std::nullopt;
    if (!value) {
      Fail(std::string(what) + " is \"" + HeaderText(token.substr(0, 40)) + "\", no number");
    }
    return value.value_or(0.0);
  }
  int Whole(std::string_view what, double least, double most) {
    const double value = Take(what);
    if (!error_ && (value < least || value > most || value != std::floor(value))) {
      Fail(std::string(what) + " is " + ShortestText(value) + "; a whole number from " +
           ShortestText(least) + " to " + ShortestText(most) + " is needed");
    }
    return error_ ? 0 : static_cast<int>(value);
  }
  double Positive(std::string_view what) {
    const double value = Take(what);
    if (!error_ && !(value > 0.0)) Fail(std::string(what) + " must be above 0");
    return value;
  }
  std::vector<double> List(std::size_t count, std::string_view what) {
    return Listed(count, what, [](double, double) {});
  }
  // Angles, each of which exceeds the one before.
  std::vector<double> Angles(std::size_t count, const std::string& what) {
    return Listed(count, "a " + what + " angle", [&](double before, double angle) {
      if (!error_ && !(angle > before)) {
        error_ = AnglesMustIncrease(where_, what, before, angle, Line()).value();
      }
    });
  }

  void SkipBlanks() {
    text_.remove_prefix(std::min(text_.find_first_not_of(Blanks()), text_.size()));
  }
  [[nodiscard]] bool AtEnd() {
    SkipBlanks();
    return text_.empty();
  }
  void Fail(const std::string& why) {
    if (!error_) error_ = BadPhotometric(where_, why).value();
  }
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }
  // Whether a number comes next.
  [[nodiscard]] bool NumberFollows() {
    SkipBlanks();
    Numbers ahead = *this;
    (void)ahead.Take("");
    return !text_.empty() && !ahead.error_;
  }

 private:
  [[nodiscard]] std::string_view Blanks() const {
    return decimal_ ? " \t\r\n\x1a" : " \t\r\n\x1a,";
  }
  [[nodiscard]] bool Decimal(std::string_view token) const {
    return decimal_ && token.find(',') != std::string_view::npos;
  }
  // Each number takes two characters at least, so that a count cannot claim memory.
  template <typename Check>
  std::vector<double> Listed(std::size_t count, std::string_view what, const Check& in_order) {
    std::vector<double> out;
    if (!error_ && count > text_.size() / 2 + 1) {
      Fail(std::to_string(count) + " numbers (" + std::string(what) +
           ") are announced, the file is too short for them");
    }
    if (error_) return out;
    out.reserve(count);
    for (std::size_t i = 0; i < count && !error_; ++i) {
      out.push_back(Take(what));
      if (i > 0) in_order(out[i - 1], out[i]);
    }
    return out;
  }
  // Of the number last taken, in the file.
  [[nodiscard]] int Line() const {
    Lines lines(all_.substr(0, all_.size() - text_.size()));
    while (lines.Next()) {
    }
    return first_line_ + std::max(0, lines.number() - 1);
  }

  std::string_view all_, text_;
  std::string_view where_;
  std::optional<Error> error_;
  bool decimal_ = false;
  int first_line_ = 1;
};

}  // namespace lightcal::records
