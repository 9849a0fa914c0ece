// SPDX-License-Identifier: Apache-2.0
// Independent jobs, several at once, each in a process of its own: one that crashes takes no other
// with it.
#pragma once

#include <functional>
#include <string>

namespace lightcal::app {

struct JobResult {
  int exit_code = 0;
  int signal = 0;        // that ended it; 0 = it ended by itself
  std::string out, err;  // what it printed
};

struct JobPlan {
  int count = 0;
  int at_once = 1;
  // In the child: does job i, prints its answer on stdout, returns its exit code.
  std::function<int(int)> work;
  // In the parent, in the order the jobs end.
  std::function<void(int, const JobResult&)> finished;
  // Asked before each start: true starts no more and waits for those that run.
  std::function<bool()> stop;
};

// The children are forked as they are needed, so the caller must be of one thread. They die with
// their parent, whatever ends it, and leave Ctrl-C to it.
void RunJobs(const JobPlan& plan);

}  // namespace lightcal::app
