// SPDX-License-Identifier: Apache-2.0
#include "console.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/printable.h"
#include "lightcal/records/json_codec.h"
#include "option_words.h"

namespace lightcal::app {
namespace {

void Write(std::FILE* stream, std::string_view text) {
  const std::string words = Printable(InOptionWords(text));
  std::fwrite(words.data(), 1, words.size(), stream);
}

void WriteDocument(const Node& document) {
  Write(stdout, PrintJson(document, records::JsonLayout::kPretty) + "\n");
}

std::string Sentence(std::string_view kind, const std::string& subject,
                     const std::string& message) {
  std::string line = "lightcal: " + std::string(kind);
  if (!subject.empty()) line += subject + ": ";
  return line + message + "\n";
}

// "143 times (a, b, c and 140 more)"
std::string TimesOf(const std::vector<const Warning*>& alike) {
  constexpr std::size_t kShown = 3;
  std::vector<std::string_view> subjects;
  for (const Warning* warning : alike) {
    if (std::ranges::find(subjects, warning->subject) == subjects.end()) {
      subjects.push_back(warning->subject);
    }
  }
  std::string text = std::to_string(alike.size()) + " times (";
  for (std::size_t i = 0; i < std::min(kShown, subjects.size()); ++i) {
    text += (i == 0 ? "" : ", ") + std::string(subjects[i]);
  }
  if (subjects.size() > kShown)
    text += " and " + std::to_string(subjects.size() - kShown) + " more";
  return text + ")";
}

// One line for one message; of more messages than a person reads one line for all, which says
// whose the message is.
std::vector<std::string> OfMany(const Warnings& warnings, const std::string& code) {
  constexpr std::size_t kRead = 6;
  std::vector<std::vector<const Warning*>> groups;
  std::vector<const Warning*> all;
  for (const Warning& warning : warnings) {
    if (warning.code != code) continue;
    all.push_back(&warning);
    const auto same = std::ranges::find_if(
        groups, [&](const auto& group) { return group.front()->message == warning.message; });
    if (same == groups.end()) {
      groups.push_back({&warning});
    } else {
      same->push_back(&warning);
    }
  }
  if (groups.size() > kRead) {
    const Warning& first = *all.front();
    return {TimesOf(all) + ", of " + first.subject + ": " + first.message +
            " (the others by --verbose)"};
  }
  std::vector<std::string> lines;
  for (const auto& group : groups) {
    const Warning& first = *group.front();
    const bool once = group.size() == 1;
    lines.push_back((once ? first.subject : TimesOf(group)) +
                    (once && first.subject.empty() ? "" : ": ") + first.message);
  }
  return lines;
}

std::size_t DisplayWidth(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

bool LooksNumeric(std::string_view text) {
  return !text.empty() && (text[0] == '-' || text[0] == '+' || (text[0] >= '0' && text[0] <= '9'));
}

void AppendCell(std::string& line, const std::string& cell, std::size_t width, bool right) {
  const std::string padding(width - std::min(width, DisplayWidth(cell)), ' ');
  line += right ? padding + cell : cell + padding;
}

int DigitsFor(double value, double u95) {
  if (value == 0.0 || u95 <= 0.0) return 4;
  const double digits = std::ceil(std::log10(std::abs(value) / u95)) + 1.0;
  return static_cast<int>(std::clamp(digits, 2.0, 6.0));
}

}  // namespace

void Console::Print(std::string_view text) {
  if (!flags_.json) Write(stdout, text);
}

void Console::PrintDocument(Node document) {
  if (!flags_.json) return;
  document.Put("warnings", Node::UnlessEmpty(Node::List(warnings_, [](const Warning& w) {
                 return DocumentOf(Error{{}, w.code, w.subject, w.message});
               })));
  WriteDocument(document);
}

void Console::Note(std::string_view text) {
  if (!flags_.quiet) Write(stderr, std::string(text) + "\n");
}

void Console::Warn(const Warning& warning) {
  warnings_.push_back(warning);
  if (flags_.muted) return;
  Write(stderr, Sentence("warning: ", warning.subject, warning.message));
}

void Console::Warn(const Warnings& warnings) {
  constexpr std::ptrdiff_t kMostAlike = 3;
  std::vector<std::string_view> said;
  for (const Warning& warning : warnings) {
    const auto alike = std::ranges::count(warnings, warning.code, &Warning::code);
    if (alike <= kMostAlike || flags_.verbose) {
      Warn(warning);
      continue;
    }
    warnings_.push_back(warning);
    if (flags_.muted || std::ranges::find(said, warning.code) != said.end()) continue;
    said.push_back(warning.code);
    for (const std::string& line : OfMany(warnings, warning.code)) {
      Write(stderr, "lightcal: warning: " + line + "\n");
    }
  }
}

Result<void> Console::RefuseIfStrict() const {
  if (!flags_.strict || warnings_.empty()) return {};
  const Warning& first = warnings_.front();
  return Refused(first.code, first.subject, first.message + " (refused because of --strict)");
}

Node DocumentOf(const Error& error) {
  return {{"code", error.code},
          {"subject", error.subject},
          {"message", error.message},
          {"others", Node::UnlessEmpty(Node::List(
                         error.others, [](const Error& other) { return DocumentOf(other); }))}};
}

void PrintError(const Error& error, bool json) {
  if (error.code.empty()) return;  // said by EndWithError
  if (json) {
    WriteDocument({{"error", DocumentOf(error)}});
  }
  Write(stderr, Sentence("", error.subject, error.message));
  for (const Error& other : error.others) {
    Write(stderr, Sentence("", other.subject, other.message));
  }
}

Result<void> EndWithError(Console& console, Node document, const Error& error) {
  document.Put("error", DocumentOf(error));
  console.PrintDocument(std::move(document));
  PrintError(error, false);
  return tl::unexpected(Error{error.kind, "", "", ""});
}

std::string TextTable(const std::vector<std::string>& header,
                      const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> width(header.size());
  std::vector<bool> right(header.size(), !rows.empty());
  for (std::size_t c = 0; c < header.size(); ++c) {
    width[c] = DisplayWidth(header[c]);
    for (const auto& row : rows) {
      width[c] = std::max(width[c], DisplayWidth(row[c]));
      if (!row[c].empty() && !LooksNumeric(row[c])) right[c] = false;
    }
  }
  std::string table;
  const auto add = [&](const std::vector<std::string>& row) {
    std::string line;
    for (std::size_t c = 0; c < header.size(); ++c) {
      if (c > 0) line += "  ";
      AppendCell(line, row[c], width[c], right[c]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    table += line + "\n";
  };
  add(header);
  for (const auto& row : rows) add(row);
  return table;
}

std::string ValueWithPercent(double value, double u95, std::string_view unit) {
  const double percent = value == 0.0 ? 0.0 : std::abs(u95 / value) * 100.0;
  return RoundedText(value, DigitsFor(value, u95)) + " " + std::string(unit) + " ± " +
         RoundedText(percent, 2) + " %";
}

std::string ValueWithAbsolute(double value, double u95, std::string_view unit) {
  const std::string u = RoundedText(u95, 2);
  const auto point = u.find('.');
  const int decimals = point == std::string::npos ? 0 : static_cast<int>(u.size() - point - 1);
  std::string number(64, '\0');
  number.resize(static_cast<std::size_t>(
      std::snprintf(number.data(), number.size(), "%.*f", decimals, value)));
  if (number.find_first_of("123456789") == std::string::npos && number.starts_with('-')) {
    number.erase(0, 1);  // what rounds to zero has no sign
  }
  return number + " ± " + u + (unit.empty() ? "" : " " + std::string(unit));
}

}  // namespace lightcal::app
