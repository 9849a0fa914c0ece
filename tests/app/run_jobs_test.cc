// SPDX-License-Identifier: Apache-2.0
#include "batch/run_jobs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

namespace lightcal::app {
namespace {

std::map<int, JobResult> ResultsOf(
    int count, int at_once, const std::function<int(int)>& work,
    const std::function<bool()>& stop = [] { return false; }) {
  std::map<int, JobResult> results;
  RunJobs({count, at_once, work, [&](int job, const JobResult& result) { results[job] = result; },
           stop});
  return results;
}

TEST(RunJobs, GivesBackWhatEachPrintsAndItsExitCode) {
  const auto results = ResultsOf(20, 3, [](int job) {
    std::printf("job %d", job);
    std::fprintf(stderr, "note %d", job);
    return job % 4;
  });
  ASSERT_EQ(results.size(), 20U);
  for (const auto& [job, result] : results) {
    EXPECT_EQ(result.out, "job " + std::to_string(job));
    EXPECT_EQ(result.err, "note " + std::to_string(job));
    EXPECT_EQ(result.exit_code, job % 4);
    EXPECT_EQ(result.signal, 0);
  }
}

TEST(RunJobs, ACrashTakesNoOtherJobWithIt) {
  const auto results = ResultsOf(8, 2, [](int job) {
    const rlimit no_core{};
    ::setrlimit(RLIMIT_CORE, &no_core);
    if (job == 3) std::abort();
    if (job == 5) throw 7;
    return 0;
  });
  ASSERT_EQ(results.size(), 8U);
  for (const auto& [job, result] : results) {
    EXPECT_EQ(result.signal, job == 3 ? SIGABRT : 0) << job;
    EXPECT_EQ(result.exit_code != 0, job == 3 || job == 5) << job;
  }
}

TEST(RunJobs, MoreThanAPipeHoldsIsTakenWhileItIsPrinted) {
  const auto results = ResultsOf(2, 2, [](int) {
    const std::string line(1 << 20, 'x');
    std::fwrite(line.data(), 1, line.size(), stdout);
    std::fwrite(line.data(), 1, line.size(), stderr);
    return 0;
  });
  for (const auto& [job, result] : results) {
    EXPECT_EQ(result.out.size(), 1U << 20U) << job;
    EXPECT_EQ(result.err.size(), 1U << 20U) << job;
  }
}

TEST(RunJobs, AWishToStopLetsThoseThatRunEnd) {
  int ended = 0;
  std::map<int, JobResult> results;
  RunJobs({50, 2,
           [](int) {
             ::usleep(1000);
             return 0;
           },
           [&](int job, const JobResult& result) {
             results[job] = result;
             ++ended;
           },
           [&] { return ended >= 10; }});
  EXPECT_GE(results.size(), 10U);
  EXPECT_LE(results.size(), 12U);
  for (const auto& [job, result] : results) EXPECT_EQ(result.exit_code, 0) << job;
}

}  // namespace
}  // namespace lightcal::app
