// SPDX-License-Identifier: Apache-2.0
// Questions that a flag answers, or a default, or else the person at the terminal.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"

namespace lightcal::app {

struct Question {
  std::string flag;            // answers it without being asked: "--kind"
  std::string text;            // "What draws the light?"
  std::string fallback;        // what Enter means; "" = not known
  std::string explained = "";  // lines shown above it
  // Without a terminal the flag must be there: the fallback would be a guess about the lamp.
  bool needed = false;
};

class Questions {
 public:
  enum class From {
    kTerminal,  // what no flag answers is asked, until the answer can be read
    kDefaults,  // --yes: what no flag answers takes its fallback
    kFlags,     // nobody can be asked
  };
  explicit Questions(From from) : from_(from) {}
  // --yes, a terminal, or neither.
  [[nodiscard]] static Questions Choose(bool yes);

  // The answer as `parse` reads it (a Result of anything). An answer typed at the terminal that
  // cannot be read is explained and asked again; one given by a flag fails as `parse` does.
  // Wrong usage: needed, no flag, nobody to ask (names the flag). Fails: interrupted at the end of
  // input or by Ctrl-C.
  template <class Parse>
  [[nodiscard]] auto Answer(const Question& question, const std::optional<std::string>& given,
                            Parse parse) const -> decltype(parse(std::string()));

 private:
  // The text to read next: absent = nothing better will come.
  [[nodiscard]] Result<std::string> Next(const Question& question) const;
  static void Explain(const Error& error);

  From from_;
};

// One line of a menu: a word of ours and what it means to someone who never read the manual.
struct Choice {
  std::string_view word;
  std::string_view meaning;
};
// "  1  point    a bare bulb ..." a line each.
[[nodiscard]] std::string MenuText(const std::vector<Choice>& choices);
// The position of a choice named by its word or its number. Wrong usage: neither.
[[nodiscard]] Result<std::size_t> ParseChoice(const std::string& text,
                                              const std::vector<Choice>& choices);

template <class Parse>
auto Questions::Answer(const Question& question, const std::optional<std::string>& given,
                       Parse parse) const -> decltype(parse(std::string())) {
  if (given) {
    auto answer = parse(*given);
    if (answer) return answer;
    Error error = answer.error();
    error.subject = question.flag;
    return tl::unexpected(std::move(error));
  }
  while (true) {
    const Result<std::string> typed = Next(question);
    if (!typed) return tl::unexpected(typed.error());
    auto answer = parse(*typed);
    if (answer || from_ != From::kTerminal) return answer;
    Explain(answer.error());
  }
}

}  // namespace lightcal::app
