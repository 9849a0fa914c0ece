// SPDX-License-Identifier: Apache-2.0
// Independent pieces of work on every processor. Who uses it links Threads::Threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace lightcal {

// Calls work(i) for every i in [0, count), on `most_threads` threads, 0 = as many as the machine
// has processors; an exception of any call is thrown again here.
template <class Work>
void ParallelFor(int count, const Work& work, int most_threads = 0) {
  if (most_threads <= 0) {
    most_threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  }
  const int threads = std::min(count, most_threads);
  std::atomic<int> next{0};
  std::exception_ptr failure;
  std::mutex guard;
  const auto loop = [&] {
    try {
      for (int i = next++; i < count; i = next++) work(i);
    } catch (...) {
      const std::scoped_lock lock(guard);
      failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (int i = 1; i < threads; ++i) helpers.emplace_back(loop);
    loop();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace lightcal
