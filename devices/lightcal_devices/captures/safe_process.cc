// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/safe_process.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

namespace lightcal::devices {
namespace {

constexpr rlim_t kMostSeconds = 120;

[[noreturn]] void Work(const std::function<void()>& work) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGSEGV, SIGBUS, SIGABRT}) {
    std::signal(signal, SIG_DFL);  // NOLINT(cert-err33-c): what cannot be reset stays
  }
  const rlimit no_core{0, 0};
  const rlimit time{kMostSeconds, kMostSeconds};
  static_cast<void>(setrlimit(RLIMIT_CORE, &no_core));
  static_cast<void>(setrlimit(RLIMIT_CPU, &time));
  work();
  _exit(0);  // no destructors, no leak checker: they belong to the process this is a copy of
}

}  // namespace

Result<ProcessEnd> RunInSafeProcess(const std::function<void()>& work) {
  const pid_t child = fork();
  if (child < 0) {
    return Failed(
        "no_process", "fork",
        std::string("cannot start a process to decode in (") + std::strerror(errno) + ")");
  }
  if (child == 0) Work(work);
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return Failed("no_process", "waitpid", std::strerror(errno));
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? ProcessEnd::kDone : ProcessEnd::kBroken;
}

}  // namespace lightcal::devices
