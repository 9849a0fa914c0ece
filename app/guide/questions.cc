// SPDX-License-Identifier: Apache-2.0
#include "guide/questions.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "lightcal/core/joined.h"
#include "lightcal/core/nearest_word.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/printable.h"
#include "option_words.h"
#include "terminal.h"

namespace lightcal::app {

Questions Questions::Choose(bool yes) {
  if (yes) return Questions(From::kDefaults);
  return Questions(CanAsk() ? From::kTerminal : From::kFlags);
}

Result<std::string> Questions::Next(const Question& question) const {
  if (from_ == From::kFlags && question.needed) {
    return WrongUsage(question.flag,
                      "is needed, for nobody can be asked here: standard input is no terminal. "
                      "Give it, or --yes for the defaults");
  }
  if (from_ == From::kDefaults && question.needed && question.fallback.empty()) {
    return WrongUsage(question.flag, "is needed: it has no default");
  }
  if (from_ != From::kTerminal) return question.fallback;
  const std::string shown = question.fallback.empty() ? "Enter = not known" : question.fallback;
  auto typed = Ask("\n" + question.explained + question.text + " [" + shown + "] ");
  if (!typed) {
    std::fputc('\n', stderr);
    return Failed("interrupted", "", "stopped by you; nothing was written");
  }
  if (typed->empty()) return question.fallback;
  return *std::move(typed);
}

void Questions::Explain(const Error& error) {
  const std::string subject = error.subject.empty() ? "" : error.subject + ": ";
  std::fprintf(stderr, "  %s\n", Printable(subject + InOptionWords(error.message)).c_str());
}

std::string MenuText(const std::vector<Choice>& choices) {
  std::size_t widest = 0;
  for (const Choice& choice : choices) widest = std::max(widest, choice.word.size());
  std::string menu;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    menu += std::string(number.size() < 2 ? "   " : "  ") + number + "  " +
            std::string(choices[i].word) + std::string(widest - choices[i].word.size(), ' ') +
            "  " + std::string(choices[i].meaning) + "\n";
  }
  return menu;
}

Result<std::size_t> ParseChoice(const std::string& text, const std::vector<Choice>& choices) {
  const std::string word = LowerAscii(TrimBlanks(text));
  std::vector<std::string_view> words;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (word == choices[i].word || word == std::to_string(i + 1)) return i;
    words.push_back(choices[i].word);
  }
  const std::string nearest = NearestWord(word, words);
  const std::string all = Joined(words);
  return WrongUsage("\"" + text + "\"",
                    nearest.empty() ? "is none of these: " + all + "; type a number or a word"
                                    : "is none of these; did you mean " + nearest + "?");
}

}  // namespace lightcal::app
