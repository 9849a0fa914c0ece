// SPDX-License-Identifier: Apache-2.0
// Many sessions, several at once, with one summary: what `run` does with more than one session.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "console.h"
#include "lightcal/core/result.h"

namespace lightcal::app {

// One session and where its outputs go.
struct BatchItem {
  std::string session;
  std::string directory;
};

// The sessions with their directories: SESSION/out, or where `output` is given that directory, in
// which each session has one of its own by its stem when `apart`. Wrong usage: two sessions that
// would write to one directory.
[[nodiscard]] Result<std::vector<BatchItem>> BatchItems(const std::vector<std::string>& sessions,
                                                        const std::string& output, bool apart);

struct BatchRequest {
  std::vector<BatchItem> items;
  int jobs = 0;                // at once; 0 = as many as the machine has processors
  std::string summary;         // a file for the summary, "" = none
  bool progress = true;        // on stderr, where that is a terminal
  bool strict = false;         // warnings refuse a session
  bool allow_outside = false;  // sessions may name files outside of their folders
  // Runs one session in a process of its own and prints its JSON document, which holds
  // "up_to_date": true where nothing was to be done.
  std::function<Result<void>(const BatchItem&, Console&)> run;
};

// Runs them all, whatever becomes of the others, and prints one table or document
// (lightcal.batch/1). Of several sessions stderr has how many warnings each gave, of which codes;
// with --verbose, of one session, and in the document each in full. The first Ctrl-C starts no more
// sessions and waits for those that run. Ends as the worst of them: 1 where a session failed,
// crashed or was not run, else 3 where one was refused. Wrong usage that a session's run finds is
// the whole batch's.
[[nodiscard]] Result<void> RunBatch(const BatchRequest& request, const Console& console);

}  // namespace lightcal::app
