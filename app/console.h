// SPDX-License-Identifier: Apache-2.0
// The two streams of every command: answers on stdout (a table for people or exactly one JSON
// document), notes and warnings on stderr.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/document.h"

namespace lightcal::app {

using records::Node;

class Console {
 public:
  struct Flags {
    bool json = false;
    bool quiet = false;
    bool verbose = false;
    bool strict = false;
    bool allow_outside = false;  // a session may name files outside of its folder
    bool muted = false;          // not even warnings: for work done many times over
  };
  explicit Console(Flags flags) : flags_(flags) {}

  [[nodiscard]] bool json() const { return flags_.json; }
  [[nodiscard]] bool allows_outside() const { return flags_.allow_outside; }
  [[nodiscard]] bool verbose() const { return flags_.verbose; }
  [[nodiscard]] bool quiet() const { return flags_.quiet || flags_.muted; }
  // What it was warned of so far.
  [[nodiscard]] const Warnings& warnings() const { return warnings_; }

  // Text for people on stdout; silent with --json.
  void Print(std::string_view text);
  // The command's one JSON document; silent without --json. Warnings given so far are added under
  // "warnings". Call it last and once.
  void PrintDocument(Node document);
  // A note on stderr (progress, next step); silent with --quiet.
  void Note(std::string_view text);
  // A warning on stderr and in the JSON document.
  void Warn(const Warning& warning);
  void Warn(const Warnings& warnings);

  // With --strict a command that warned must end refused, before it writes anything: call this
  // between the last warning and the first output.
  [[nodiscard]] Result<void> RefuseIfStrict() const;

 private:
  Flags flags_;
  Warnings warnings_;
};

// {"code","subject","message"}, and "others" of the same where it has several causes.
[[nodiscard]] Node DocumentOf(const Error& error);
// Prints an error as people or machines read it.
void PrintError(const Error& error, bool json);
// Ends a command whose whole answer is given though something in it went wrong: adds "error" to the
// document and prints it, or says the error on stderr. The error that it returns says no more.
[[nodiscard]] Result<void> EndWithError(Console& console, Node document, const Error& error);

inline constexpr const char* kNone = "-";  // a cell without a value

// A table with a header, columns aligned by display width (UTF-8), numbers to the right.
[[nodiscard]] std::string TextTable(const std::vector<std::string>& header,
                                    const std::vector<std::vector<std::string>>& rows);

// "5585 cd ± 3.8 %": value with the digits its uncertainty leaves, and the relative half width.
[[nodiscard]] std::string ValueWithPercent(double value, double u95, std::string_view unit);
// "0.067 ± 0.035 m": for values near zero, where a percentage says nothing.
[[nodiscard]] std::string ValueWithAbsolute(double value, double u95, std::string_view unit);

}  // namespace lightcal::app
