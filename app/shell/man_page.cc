// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>
#include <vector>

#include "lightcal/core/joined.h"
#include "shell/shell_texts.h"

namespace lightcal::app {
namespace {

// Text as roff takes it: no escapes, no requests, hyphens that can be copied.
std::string Plain(const std::string& text) {
  std::string safe = Replaced(Replaced(text, "\\", "\\e"), "-", "\\-");
  if (safe.starts_with('.') || safe.starts_with('\'')) safe.insert(0, "\\&");
  return safe;
}

std::string Bold(const std::string& text) { return "\\fB" + Plain(text) + "\\fR"; }
std::string Italic(const std::string& text) { return "\\fI" + Plain(text) + "\\fR"; }

// Lines as they are, one below the other.
std::string Verbatim(const std::string& lines) {
  std::string text = ".PP\n.RS 2\n.nf\n";
  for (std::size_t start = 0; start < lines.size();) {
    const std::size_t end = std::min(lines.find('\n', start), lines.size());
    std::string line = lines.substr(start, end - start);
    line.erase(0, line.find_first_not_of(' '));
    text += Plain(line) + "\n";
    start = end + 1;
  }
  return text + ".fi\n.RE\n";
}

// "-o, --output FILE", or a nameless word's name.
std::string Heading(const TypedOption& option) {
  if (option.names.empty()) return Italic(option.placeholder) + (option.many ? " ..." : "");
  std::string text = Joined(option.names, ", ", Bold);
  if (option.values > 0) text += " " + Italic(option.placeholder);
  if (option.again) return text + " (again: more)";
  return text + (option.values > 0 && option.many ? " ..." : "");
}

std::string Paragraph(const TypedOption& option) {
  std::string text = ".TP\n" + Heading(option) + "\n" + Plain(option.summary);
  if (!option.words.empty()) {
    text += "\n.br\n" + std::string(option.commas ? "Words, joined by commas: " : "One of ") +
            Joined(option.words, ", ", Bold);
  }
  if (!option.usual.empty()) text += "\n.br\nDefault: " + Plain(option.usual);
  if (option.required) text += "\n.br\nRequired.";
  return text + "\n";
}

bool SameOption(const TypedOption& a, const TypedOption& b) {
  return a.names == b.names && a.summary == b.summary;
}

bool Has(const TypedCommand& command, const TypedOption& option) {
  return std::ranges::any_of(command.options,
                             [&](const TypedOption& own) { return SameOption(own, option); });
}

// The options that every command has.
std::vector<TypedOption> CommonOptions(const TypedCommand& lightcal) {
  std::vector<TypedOption> common;
  if (lightcal.commands.empty()) return common;
  for (const TypedOption& option : lightcal.commands.front().options) {
    const bool everywhere = std::ranges::all_of(
        lightcal.commands, [&](const TypedCommand& command) { return Has(command, option); });
    if (everywhere) common.push_back(option);
  }
  return common;
}

std::string Section(const TypedCommand& command, const std::vector<TypedOption>& common) {
  std::string text =
      ".SS lightcal " + Plain(PathText(command)) + "\n" + Plain(command.summary) + ".\n";
  for (const TypedOption& option : command.options) {
    const bool known = std::ranges::any_of(
        common, [&](const TypedOption& other) { return SameOption(option, other); });
    if (!known) text += Paragraph(option);
  }
  if (!command.examples.empty()) text += Verbatim(command.examples);
  for (const TypedCommand& below : command.commands) text += Section(below, common);
  return text;
}

// What the tree of commands does not say.
constexpr const char* kIntroduction = R"(.SH DESCRIPTION
Put a lux meter, a spectrometer or a camera in front of a lamp.
lightcal finds the lamp's luminous intensity, where its light really starts and its colour
temperature, says how sure each number is, and writes light presets that make an engine reproduce
what was measured.
.PP
Values take units (0.5m 20in, 192lx 17.8fc, 1/60, f/2.8, 3200K); bare numbers are SI.
Positions are in metres, Z up; cone angles are half angles.
)";

constexpr const char* kClosing = R"(.SH EXIT STATUS
.TP
0
Done. Warnings went to standard error, and with \fB\-\-json\fR into the document.
.TP
1
Failed: a file, a device, or lightcal itself.
.TP
2
The command line is wrong; nothing was done.
.TP
3
Refused: the data cannot support an answer. Nothing was written; the message says what to do.
.SH FILES
.TP
.I session.toml
A session: lamps, meters, room, readings and captures, written by a person.
.TP
.I readings.jsonl
Its journal beside it: readings taken later, one synced line each.
.TP
.I out/
Where \fBrun\fR writes light.json, every preset and report.html.
.TP
.I meters.toml
How meters compare to better ones; beside a session, or in \fI~/.config/lightcal\fR.
.TP
.I /usr/share/lightcal/sessions
Sessions to try; copy one before running it.
.SH ENVIRONMENT
.TP
.B SOURCE_DATE_EPOCH
Stands in for the present time, so that the same inputs give the same bytes.
.TP
.B XDG_CONFIG_HOME
Where \fIlightcal/meters.toml\fR is looked for instead of \fI~/.config\fR.
)";

}  // namespace

std::string PathText(const TypedCommand& command, const std::string& between) {
  std::string text;
  for (const std::string& word : command.path) text += (text.empty() ? "" : between) + word;
  return text;
}

std::string Replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size()) {
    text.replace(at, what.size(), by);
  }
  return text;
}

std::string ManPage(const TypedCommand& lightcal, const std::string& date,
                    const std::string& version) {
  const std::vector<TypedOption> common = CommonOptions(lightcal);
  std::string text =
      ".TH LIGHTCAL 1 \"" + date + "\" \"" + version +
      "\" \"User Commands\"\n.SH NAME\nlightcal \\- measure real lamps, bring them "
      "into renderers, and say how sure it is\n.SH SYNOPSIS\n.B lightcal\n.I command\n"
      "[\\fIoptions\\fR]\n" +
      std::string(kIntroduction) + ".SH COMMON OPTIONS\n";
  for (const TypedOption& option : common) text += Paragraph(option);
  text += ".SH COMMANDS\n";
  for (const TypedCommand& command : lightcal.commands) text += Section(command, common);
  return text + kClosing;
}

}  // namespace lightcal::app
