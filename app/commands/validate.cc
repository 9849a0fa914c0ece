// SPDX-License-Identifier: Apache-2.0
// lightcal validate: whether files are what they should be, by the readers every command uses.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <system_error>

#include "batch/find_sessions.h"
#include "commands.h"
#include "lightcal/presets/preset_table.h"
#include "validate/validate_file.h"

namespace lightcal::app {
namespace {

Node VerdictNode(const FileVerdict& verdict) {
  return {{"file", verdict.path},
          {"ok", !verdict.error},
          {"checked", verdict.checked ? Node() : Node(false)},
          {"format", Node::UnlessEmpty(verdict.format)},
          {"version", Node::UnlessEmpty(verdict.version)},
          {"holds", Node::UnlessEmpty(verdict.holds)},
          {"error", verdict.error ? DocumentOf(*verdict.error) : Node()}};
}

std::string Verdict(const FileVerdict& verdict) {
  if (!verdict.error) return verdict.checked ? "ok" : "not checked";
  return verdict.error->kind == ErrorKind::kRefused ? "refused" : "unreadable";
}

std::string Table(const std::vector<FileVerdict>& verdicts) {
  std::vector<std::vector<std::string>> rows;
  for (const FileVerdict& verdict : verdicts) {
    const auto or_none = [](const std::string& text) { return text.empty() ? kNone : text; };
    rows.push_back({verdict.path, or_none(verdict.format), or_none(verdict.version),
                    Verdict(verdict), or_none(verdict.holds)});
  }
  return TextTable({"file", "format", "version", "verdict", "holds"}, rows);
}

// What is wrong, below the table: one line a file.
std::string Faults(const std::vector<FileVerdict>& verdicts) {
  std::string text;
  for (const FileVerdict& verdict : verdicts) {
    if (!verdict.error) continue;
    const std::string& subject = verdict.error->subject;
    const bool repeats = subject.empty() || subject == verdict.path;
    text += verdict.path + ": " + (repeats ? "" : subject + ": ") + verdict.error->message + "\n";
  }
  return text.empty() ? "" : "\n" + text;
}

// What lies in a folder of outputs, by name; what is none of our formats is passed over.
std::vector<FileVerdict> VerdictsIn(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    std::error_code ignored;
    const bool hidden = entry.path().filename().string().starts_with('.');
    if (entry.is_regular_file(ignored) && !hidden) files.push_back(entry.path().string());
  }
  std::ranges::sort(files);
  std::vector<FileVerdict> verdicts;
  for (const std::string& file : files) {
    FileVerdict verdict = ValidateFile(file);
    const bool foreign = verdict.error && verdict.error->code == "unknown_format";
    if (!foreign) verdicts.push_back(std::move(verdict));
  }
  return verdicts;
}

Result<void> RunValidate(const std::vector<std::string>& paths, Console& console) {
  std::vector<FileVerdict> verdicts;
  for (const std::string& path : paths) {
    std::error_code error;
    const bool folder = std::filesystem::is_directory(path, error);
    const auto files =
        folder ? FindSessions({path}, true) : Result<std::vector<std::string>>{std::vector{path}};
    if (!files) return tl::unexpected(files.error());
    if (folder && *files == std::vector{path} && !IsSession(path)) {
      std::vector<FileVerdict> inside = VerdictsIn(path);
      std::ranges::move(inside, std::back_inserter(verdicts));
      if (!inside.empty()) continue;
    }
    for (const std::string& file : *files) verdicts.push_back(ValidateFile(file));
  }
  for (const FileVerdict& verdict : verdicts) {
    for (Warning warning : verdict.warnings) {
      const std::string name = std::filesystem::path(verdict.path).filename().string();
      if (warning.subject.find(name) == std::string::npos) {
        warning.subject = verdict.path + (warning.subject.empty() ? "" : ": " + warning.subject);
      }
      console.Warn(warning);
    }
  }
  if (const auto unread = std::ranges::count(verdicts, false, &FileVerdict::checked); unread > 0) {
    console.Warn({"not_checked", "validate",
                  std::to_string(unread) + " of " + std::to_string(verdicts.size()) +
                      " files are lightcal's own for engines and people: it writes them and has no "
                      "reader for them, so that what they hold was not looked at"});
  }
  const Node document = {{"files", Node::List(verdicts, VerdictNode)}};
  console.Print(Table(verdicts) + Faults(verdicts));

  const auto count = [&](const std::string& word) {
    return std::ranges::count(verdicts, word, Verdict);
  };
  const auto of_all = " of " + std::to_string(verdicts.size()) + " files";
  if (const auto n = count("unreadable"); n > 0) {
    return EndWithError(console, document,
                        {ErrorKind::kFailed, "unreadable", "validate",
                         std::to_string(n) + of_all + " cannot be read"});
  }
  if (const auto n = count("refused"); n > 0) {
    return EndWithError(console, document,
                        {ErrorKind::kRefused, "invalid", "validate",
                         std::to_string(n) + of_all + " refused; each says what to do"});
  }
  if (auto strict = console.RefuseIfStrict(); !strict) {
    return EndWithError(console, document, strict.error());
  }
  console.PrintDocument(document);
  return {};
}

}  // namespace

Run BuildValidate(CLI::App& parser) {
  auto paths = std::make_shared<std::vector<std::string>>();
  parser
      .add_option(
          "files", *paths,
          "Sessions (or a folder of them), readings.jsonl, meters.toml; light.json, presets, "
          "camera, profile, capture and run files, tapes; " +
              ReadableEndings(" ") +
              " as export writes them (what else it writes is listed as not checked); IES, "
              "EULUMDAT, camera sensitivities; "
              "spectra and readings that import reads")
      ->required();
  return [paths](Console& console) { return RunValidate(*paths, console); };
}

}  // namespace lightcal::app
