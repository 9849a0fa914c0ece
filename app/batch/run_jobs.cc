// SPDX-License-Identifier: Apache-2.0
#include "batch/run_jobs.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <vector>

namespace lightcal::app {
namespace {

constexpr int kFailed = 1;

// What one child prints on one of its streams.
struct Stream {
  int fd = -1;
  std::string text;

  void Take() {
    std::array<char, 1 << 16> buffer{};
    const ssize_t n = ::read(fd, buffer.data(), buffer.size());
    if (n > 0) {
      text.append(buffer.data(), static_cast<std::size_t>(n));
    } else if (n == 0 || errno != EINTR) {
      ::close(fd);
      fd = -1;
    }
  }
};

struct Child {
  int job = 0;
  pid_t process = -1;
  std::array<Stream, 2> streams{};  // its stdout and stderr

  [[nodiscard]] bool Open() const { return streams[0].fd >= 0 || streams[1].fd >= 0; }
};

using Pipe = std::array<int, 2>;  // read end, write end

[[noreturn]] void BeChild(const JobPlan& plan, int job, pid_t parent, const Pipe& out,
                          const Pipe& err) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(kFailed);
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_DFL);
  ::dup2(out[1], STDOUT_FILENO);
  ::dup2(err[1], STDERR_FILENO);
  int code = kFailed;
  try {
    code = plan.work(job);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "internal error: %s\n", error.what());
  } catch (...) {
    std::fputs("internal error\n", stderr);
  }
  std::fflush(nullptr);
  ::_exit(code);
}

// A child that cannot be made ends its job as a failure that says why.
void Start(const JobPlan& plan, int job, std::vector<Child>& running) {
  Pipe out{-1, -1};
  Pipe err{-1, -1};
  const bool piped = ::pipe2(out.data(), O_CLOEXEC) == 0 && ::pipe2(err.data(), O_CLOEXEC) == 0;
  std::fflush(nullptr);  // or the child would print it again
  const pid_t parent = ::getpid();
  const pid_t process = piped ? ::fork() : -1;
  if (process == 0) BeChild(plan, job, parent, out, err);
  const std::string reason = std::strerror(errno);
  for (const int end : {out[1], err[1]}) {
    if (end >= 0) ::close(end);
  }
  if (process > 0) {
    running.push_back({job, process, {Stream{out[0], ""}, Stream{err[0], ""}}});
    return;
  }
  for (const int end : {out[0], err[0]}) {
    if (end >= 0) ::close(end);
  }
  plan.finished(job, {kFailed, 0, "", "no process could be started: " + reason});
}

void TakeWhatTheyPrint(std::vector<Child>& running) {
  std::vector<pollfd> waits;
  std::vector<Stream*> streams;
  for (Child& child : running) {
    for (Stream& stream : child.streams) {
      if (stream.fd < 0) continue;
      waits.push_back({stream.fd, POLLIN, 0});
      streams.push_back(&stream);
    }
  }
  if (::poll(waits.data(), waits.size(), -1) <= 0) return;
  for (std::size_t i = 0; i < waits.size(); ++i) {
    if (waits[i].revents != 0) streams[i]->Take();
  }
}

void Reap(const JobPlan& plan, Child& child) {
  int status = 0;
  while (::waitpid(child.process, &status, 0) < 0 && errno == EINTR) {
  }
  JobResult result{WIFEXITED(status) ? WEXITSTATUS(status) : kFailed,
                   WIFSIGNALED(status) ? WTERMSIG(status) : 0, std::move(child.streams[0].text),
                   std::move(child.streams[1].text)};
  plan.finished(child.job, result);
}

}  // namespace

void RunJobs(const JobPlan& plan) {
  const auto most = static_cast<std::size_t>(std::max(1, plan.at_once));
  std::vector<Child> running;
  int next = 0;
  while (true) {
    while (next < plan.count && running.size() < most && !plan.stop()) {
      Start(plan, next++, running);
    }
    if (running.empty()) return;
    TakeWhatTheyPrint(running);
    const auto ended =
        std::ranges::partition(running, [](const Child& child) { return child.Open(); });
    for (Child& child : ended) Reap(plan, child);
    running.erase(ended.begin(), ended.end());
  }
}

}  // namespace lightcal::app
