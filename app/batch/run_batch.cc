// SPDX-License-Identifier: Apache-2.0
#include "batch/run_batch.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>
#include <thread>

#include "batch/run_jobs.h"
#include "input_files.h"
#include "interrupt.h"
#include "lamp_words.h"
#include "light_input.h"
#include "light_summary.h"
#include "light_table.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/printable.h"
#include "lightcal/records/json_codec.h"
#include "lightcal/records/session_codec.h"
#include "output_files.h"
#include "progress_line.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;
enum class Status { kDone, kUpToDate, kRefused, kFailed, kCrashed, kNotRun };
constexpr std::array<std::string_view, 6> kStatusWords = {"done",   "up_to_date", "refused",
                                                          "failed", "crashed",    "not_run"};
// As people read them.
constexpr std::array<std::string_view, 6> kStatusNames = {"done",   "up to date", "refused",
                                                          "failed", "crashed",    "not run"};

struct Outcome {
  Status status = Status::kNotRun;
  std::optional<Error> error;
  Warnings warnings;
};

std::size_t Count(const std::vector<Outcome>& outcomes, Status status) {
  return static_cast<std::size_t>(std::ranges::count(outcomes, status, &Outcome::status));
}

std::string LastLine(std::string_view text) {
  text = TrimBlanks(text);
  return std::string(text.substr(text.rfind('\n') + 1));
}

Error ErrorOf(ErrorKind kind, const Node& told) {
  Error error{kind, told.TextAt("code"), told.TextAt("subject"), told.TextAt("message")};
  if (const Node* others = told.Find("others")) {
    for (const Node& other : others->items) error.others.push_back(ErrorOf(kind, other));
  }
  return error;
}

Outcome OutcomeOf(const JobResult& result) {
  Outcome outcome;
  if (result.signal != 0) {
    outcome.status = Status::kCrashed;
    const std::string said = LastLine(result.err);
    outcome.error =
        Error{ErrorKind::kFailed, "crashed", "",
              "ended by signal " + std::to_string(result.signal) +
                  (said.empty() ? "" : " (" + said + ")") + "; run it alone to see more"};
    return outcome;
  }
  const Node document = records::ParseJson(result.out).value_or(Node());
  if (const Node* warnings = document.Find("warnings")) {
    for (const Node& w : warnings->items) {
      outcome.warnings.push_back({w.TextAt("code"), w.TextAt("subject"), w.TextAt("message")});
    }
  }
  if (result.exit_code == 0) {
    const bool nothing_to_do = document.Find("up_to_date") != nullptr;
    outcome.status = nothing_to_do ? Status::kUpToDate : Status::kDone;
    return outcome;
  }
  const auto kind = static_cast<ErrorKind>(result.exit_code);
  outcome.status = kind == ErrorKind::kRefused ? Status::kRefused : Status::kFailed;
  if (const Node* e = document.Find("error")) {
    outcome.error = ErrorOf(kind, *e);
  } else {
    outcome.error = Error{ErrorKind::kFailed, "failed", "", LastLine(result.err)};
  }
  return outcome;
}

// One line that is written over; nothing where nobody looks.
class BatchProgress {
 public:
  BatchProgress(bool wanted, std::size_t count)
      : shown_(wanted && ::isatty(STDERR_FILENO) == 1), count_(count) {}

  void Show(const std::vector<Outcome>& outcomes) const {
    if (!shown_) return;
    const std::size_t ended = count_ - Count(outcomes, Status::kNotRun);
    std::string line = "\r\x1b[K" + std::to_string(ended) + " of " + std::to_string(count_);
    for (const Status status :
         {Status::kUpToDate, Status::kRefused, Status::kFailed, Status::kCrashed}) {
      const std::size_t n = Count(outcomes, status);
      if (n == 0) continue;
      line += ", " + std::to_string(n) + " " +
              std::string(kStatusNames[static_cast<std::size_t>(status)]);
    }
    const double elapsed_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
    const std::string left =
        TimeLeftText(static_cast<double>(ended) / static_cast<double>(count_), elapsed_s);
    if (!left.empty()) line += ", " + left;
    std::fputs(line.c_str(), stderr);
  }
  void Clear() const {
    if (shown_) std::fputs("\r\x1b[K", stderr);
  }

 private:
  bool shown_;
  std::size_t count_;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

// What the session's light.json says now; nothing where it has none.
std::vector<FittedLight> LightsOf(const BatchItem& item) {
  auto file = LightsIn((fs::path(item.directory) / "light.json").string());
  return file ? std::move(file->lights) : std::vector<FittedLight>{};
}

bool HasOutputs(const Outcome& outcome) {
  return outcome.status == Status::kDone || outcome.status == Status::kUpToDate;
}

Node SessionNode(const BatchItem& item, const Outcome& outcome) {
  const bool done = HasOutputs(outcome);
  return {{"session", item.session},
          {"output", item.directory},
          {"status", kStatusWords[static_cast<std::size_t>(outcome.status)]},
          {"error", outcome.error ? DocumentOf(*outcome.error) : Node()},
          {"lights", done ? Node::List(LightsOf(item), LightSummary) : Node()}};
}

Node Summary(const std::vector<BatchItem>& items, const std::vector<Outcome>& outcomes) {
  Node sessions = Node::Array();
  for (std::size_t i = 0; i < items.size(); ++i) {
    sessions.items.push_back(SessionNode(items[i], outcomes[i]));
  }
  Node counts = Node::Table();
  for (std::size_t s = 0; s < kStatusWords.size(); ++s) {
    counts.Put(kStatusWords[s], Count(outcomes, static_cast<Status>(s)));
  }
  return {{"schema", "lightcal.batch/1"},
          {"generator", GeneratorName()},
          {"sessions", sessions},
          {"counts", counts}};
}

Result<void> WriteSummary(const BatchRequest& request, const std::vector<Outcome>& outcomes) {
  if (request.summary.empty()) return {};
  const Node summary = Summary(request.items, outcomes);
  const std::string text = PrintJson(summary, records::JsonLayout::kPretty) + "\n";
  return WriteOutputs({{request.summary, text}}, false);
}

// Of more than a cell holds the first, and how many there are beside.
std::string FirstOf(std::vector<std::string> texts, const std::string& between) {
  constexpr std::size_t kShown = 3;
  const std::size_t more = texts.size() - std::min(texts.size(), kShown);
  texts.resize(texts.size() - more);
  return Joined(texts, between) + (more > 0 ? " and " + std::to_string(more) + " more" : "");
}

std::string OutcomeText(const BatchItem& item, const Outcome& outcome) {
  std::vector<std::string> texts;
  if (outcome.error) {
    const auto add = [&](const Error& error) {
      texts.push_back((error.subject.empty() ? "" : error.subject + ": ") + error.message);
    };
    add(*outcome.error);
    for (const Error& other : outcome.error->others) add(other);
    return FirstOf(std::move(texts), "; ");
  }
  for (const FittedLight& light :
       HasOutputs(outcome) ? LightsOf(item) : std::vector<FittedLight>{}) {
    const Strength strength = StrengthOf(light);
    const std::string stops = strength.value == nullptr ? "" : StopsText(*strength.value);
    texts.push_back(light.name + " " +
                    (stops.empty() ? Headline(light)
                                   : ValueText(*strength.value) + " " + std::string(strength.unit) +
                                         " " + stops));
  }
  return FirstOf(std::move(texts), ", ");
}

std::string Table(const std::vector<BatchItem>& items, const std::vector<Outcome>& outcomes) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < items.size(); ++i) {
    rows.push_back({items[i].session,
                    std::string(kStatusNames[static_cast<std::size_t>(outcomes[i].status)]),
                    OutcomeText(items[i], outcomes[i])});
  }
  return TextTable({"session", "status", "lights"}, rows);
}

// "100 sessions: 97 done, 2 refused, 1 crashed"
std::string Counted(const std::vector<Outcome>& outcomes) {
  std::string text;
  for (std::size_t s = 0; s < kStatusNames.size(); ++s) {
    const std::size_t n = Count(outcomes, static_cast<Status>(s));
    if (n > 0) {
      text += (text.empty() ? "" : ", ") + std::to_string(n) + " " + std::string(kStatusNames[s]);
    }
  }
  const std::string sessions = outcomes.size() == 1 ? " session: " : " sessions: ";
  return std::to_string(outcomes.size()) + sessions + text;
}

// "lamps/a: 3 warnings: row_rejected 2, prior_conflict"
std::string WarningCounts(const std::string& session, const Warnings& warnings) {
  std::map<std::string, int> counts;
  for (const Warning& warning : warnings) ++counts[warning.code];
  std::string codes;
  for (const auto& [code, count] : counts) {
    codes += (codes.empty() ? "" : ", ") + code + (count > 1 ? " " + std::to_string(count) : "");
  }
  return session + ": " + std::to_string(warnings.size()) +
         (warnings.size() == 1 ? " warning: " : " warnings: ") + codes;
}

// On stderr a line a session, or with --verbose, or one session alone, every warning in full. Of
// all of them the console that gives the answer: in JSON they stand in full always.
Console Warned(const BatchRequest& request, const std::vector<Outcome>& outcomes,
               const Console& console) {
  const bool in_full = console.verbose() || outcomes.size() == 1;
  Console answer({.json = console.json(),
                  .quiet = false,
                  .verbose = false,
                  .strict = false,
                  .allow_outside = false,
                  .muted = !in_full});
  bool shortened = false;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const std::string& session = request.items[i].session;
    for (Warning warning : outcomes[i].warnings) {
      warning.subject = session + (warning.subject.empty() ? "" : ": " + warning.subject);
      answer.Warn(warning);
    }
    if (in_full || outcomes[i].warnings.empty()) continue;
    shortened = true;
    std::fputs(
        Printable("lightcal: " + WarningCounts(session, outcomes[i].warnings) + "\n").c_str(),
        stderr);
  }
  if (shortened) std::fputs("lightcal: --verbose says the warnings in full\n", stderr);
  return answer;
}

std::optional<Error> WorstOf(const std::vector<Outcome>& outcomes) {
  const std::string counted = Counted(outcomes);
  if (Count(outcomes, Status::kNotRun) > 0) {
    return Error{ErrorKind::kFailed, "interrupted", "run",
                 counted + "; the same line with --resume goes on"};
  }
  if (Count(outcomes, Status::kFailed) + Count(outcomes, Status::kCrashed) > 0) {
    return Error{ErrorKind::kFailed, "sessions_failed", "run",
                 counted + "; mend them, the same line with --resume runs only those"};
  }
  if (Count(outcomes, Status::kRefused) > 0) {
    return Error{ErrorKind::kRefused, "sessions_refused", "run",
                 counted + "; the table says what their data lack"};
  }
  return std::nullopt;
}

std::vector<Outcome> RunAll(const BatchRequest& request) {
  std::vector<Outcome> outcomes(request.items.size());
  const BatchProgress progress(request.progress, outcomes.size());
  bool misused = false;
  const InterruptGuard guard;
  JobPlan plan;
  plan.count = static_cast<int>(request.items.size());
  plan.at_once =
      request.jobs > 0 ? request.jobs : static_cast<int>(std::thread::hardware_concurrency());
  plan.work = [&](int i) {
    Console console({.json = true,
                     .quiet = true,
                     .verbose = false,
                     .strict = request.strict,
                     .allow_outside = request.allow_outside,
                     .muted = true});
    const Result<void> done = request.run(request.items[static_cast<std::size_t>(i)], console);
    if (done) return 0;
    PrintError(done.error(), true);
    return static_cast<int>(done.error().kind);
  };
  plan.finished = [&](int i, const JobResult& result) {
    Outcome& outcome = outcomes[static_cast<std::size_t>(i)];
    outcome = OutcomeOf(result);
    misused = misused || (outcome.error && outcome.error->kind == ErrorKind::kUsage);
    progress.Show(outcomes);
  };
  plan.stop = [&] { return misused || InterruptGuard::StopRequest().Requested(); };
  RunJobs(plan);
  progress.Clear();
  return outcomes;
}

std::string StemOf(const fs::path& session) {
  std::error_code error;
  const bool named_toml = session.extension() == ".toml" && session.filename() != "session.toml" &&
                          fs::is_regular_file(session, error);
  if (named_toml) return session.stem().string();
  const fs::path directory = fs::path(JournalPath(session.string())).parent_path();
  return fs::path(WholePath(directory.empty() ? "." : directory.string())).filename().string();
}

}  // namespace

Result<std::vector<BatchItem>> BatchItems(const std::vector<std::string>& sessions,
                                          const std::string& output, bool apart) {
  std::vector<BatchItem> items;
  std::map<std::string, std::string> taken;
  for (const std::string& session : sessions) {
    fs::path directory = fs::path(JournalPath(session)).parent_path() / "out";
    if (!output.empty()) directory = apart ? fs::path(output) / StemOf(session) : fs::path(output);
    const auto [earlier, added] = taken.emplace(WholePath(directory.string()), session);
    if (!added) {
      return WrongUsage(session, "would write to " + directory.string() + ", as " +
                                     earlier->second + " does; run them apart, each with its -o");
    }
    items.push_back({session, directory.string()});
  }
  return items;
}

Result<void> RunBatch(const BatchRequest& request, const Console& console) {
  for (const BatchItem& item : request.items) {  // each is read by a process of its own
    NoteInput(item.session);
    NoteInput((fs::path(item.session) / "session.toml").string());
    NoteInput(JournalPath(item.session));
  }
  // Before the work: the place can be written, and who looks meanwhile is told the truth.
  if (auto written = WriteSummary(request, std::vector<Outcome>(request.items.size())); !written) {
    return written;
  }
  const std::vector<Outcome> outcomes = RunAll(request);
  for (const Outcome& outcome : outcomes) {
    if (outcome.error && outcome.error->kind == ErrorKind::kUsage) {
      return tl::unexpected(*outcome.error);
    }
  }
  Console answer = Warned(request, outcomes, console);
  if (auto written = WriteSummary(request, outcomes); !written) return written;
  const Node document = Summary(request.items, outcomes);
  answer.Print(Table(request.items, outcomes) + "\n");
  if (const auto worst = WorstOf(outcomes)) return EndWithError(answer, document, *worst);
  answer.Print(Counted(outcomes) + "\n");
  answer.PrintDocument(document);
  return {};
}

}  // namespace lightcal::app
