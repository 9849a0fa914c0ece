// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/whole_text.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include "lightcal/presets/check/reader_parts.h"
#include "lightcal/presets/scripts.h"

namespace lightcal {
namespace {

// Walks over strings and comments; what it stops at is the format's own.
class TextWalker {
 public:
  TextWalker(std::string_view text, const TextSyntax& syntax) : text_(text), syntax_(syntax) {}

  // The next bracket, '\0' at the end.
  char NextBracket() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (SkipComment() || SkipString(c)) continue;
      ++at_;
      if (c > ' ') before_ = c;
      if (std::string_view("()[]{}").find(c) != std::string_view::npos) return c;
    }
    return '\0';
  }

 private:
  [[nodiscard]] bool Here(std::string_view word) const {
    return !word.empty() && text_.substr(at_).starts_with(word);
  }

  // To behind the next `end`.
  void SkipTo(std::string_view end, const char* what) {
    const std::size_t found = text_.find(end, at_);
    if (found == std::string_view::npos) ThrowCutOff(what);
    at_ = found + end.size();
  }

  bool SkipComment() {
    if (Here(syntax_.line_comment)) {
      at_ = std::min(text_.find('\n', at_), text_.size());
      return true;
    }
    if (!Here(syntax_.block_comment)) return false;
    at_ += syntax_.block_comment.size();
    SkipTo(syntax_.block_end, "the end of its last comment");
    return true;
  }

  bool SkipString(char c) {
    constexpr const char* kEnd = "the end of its last string";
    if (Here(syntax_.plain_quote)) {
      ++at_;
      SkipTo(syntax_.plain_quote, kEnd);
      return true;
    }
    const bool regex = syntax_.regexes && c == '/' &&
                       std::string_view("(,=:[!&|?{};").find(before_) != std::string_view::npos;
    if (!regex && syntax_.quotes.find(c) == std::string_view::npos) return false;
    const std::string tripled(3, c);
    const bool tall = syntax_.long_quotes.find(c) != std::string_view::npos && Here(tripled);
    const std::string_view end = tall ? std::string_view(tripled) : text_.substr(at_, 1);
    at_ += end.size();
    bool in_class = false;  // a regex's [/] does not end it
    while (at_ < text_.size() && (in_class || !Here(end))) {
      if (regex && text_[at_] == '[') in_class = true;
      if (regex && text_[at_] == ']') in_class = false;
      at_ += text_[at_] == '\\' ? 2 : 1;
    }
    if (at_ >= text_.size()) ThrowCutOff(kEnd);
    at_ += end.size();
    before_ = c;
    return true;
  }

  std::string_view text_;
  const TextSyntax& syntax_;
  std::size_t at_ = 0;
  char before_ = ';';  // the last that was neither blank nor comment
};

}  // namespace

void ThrowCutOff(const std::string& what) {
  throw std::runtime_error("it is cut off: " + what + " is missing; copy or export it again");
}

void RequireClosed(std::string_view text, const TextSyntax& syntax) {
  TextWalker walker(text, syntax);
  std::string open;  // what closes them, the innermost last
  while (const char c = walker.NextBracket()) {
    if (c == '(') open += ')';
    if (c == '[') open += ']';
    if (c == '{') open += '}';
    if (c != ')' && c != ']' && c != '}') continue;
    if (open.empty() || open.back() != c) {
      throw std::runtime_error(std::string("a ") + c + " in it closes nothing");
    }
    open.pop_back();
  }
  if (!open.empty()) ThrowCutOff("the " + open.substr(open.size() - 1) + " of its last part");
}

bool IsOwnScript(std::string_view text, std::string_view script) {
  constexpr std::string_view kMark = "@DATA@";
  const std::string_view own = Script(script);
  const std::size_t mark = own.find(kMark);
  const std::string_view head = own.substr(0, mark), tail = own.substr(mark + kMark.size());
  if (text.size() < head.size() + tail.size() || !text.starts_with(head) || !text.ends_with(tail)) {
    return false;
  }
  const std::string data(text.substr(head.size(), text.size() - head.size() - tail.size()));
  const std::size_t end = data.find_last_not_of(" \r\n") + 1;
  const bool quoted = head.find("json.loads(") != std::string_view::npos;
  if (quoted && data.find(39) != std::string::npos) return false;  // an apostrophe
  return ObjectFrom(data, 0) == data.substr(0, end);
}

}  // namespace lightcal
