// SPDX-License-Identifier: Apache-2.0
// Time that processors spent, which leaves out what else a machine does.
#pragma once

#include <sys/resource.h>

#include <ctime>

namespace lightcal {

// Seconds on all cores since this process began, of it and of the children it has waited for.
[[nodiscard]] inline double ProcessorSeconds() {
  timespec own{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &own);
  rusage children{};
  ::getrusage(RUSAGE_CHILDREN, &children);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return static_cast<double>(own.tv_sec) + 1e-9 * static_cast<double>(own.tv_nsec) +
         seconds(children.ru_utime) + seconds(children.ru_stime);
}

}  // namespace lightcal
