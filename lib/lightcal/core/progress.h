// SPDX-License-Identifier: Apache-2.0
// How far long work is, told to whoever waits for it.
#pragma once

#include <functional>
#include <mutex>

namespace lightcal {

// The share that is done, 0 to 1, never falling; empty where nobody wants to know.
using Progress = std::function<void(double share)>;

// A part of longer work: what it tells as 0 to 1 is told on as `from` to `to`.
[[nodiscard]] inline Progress PartOf(const Progress& whole, double from, double to) {
  if (!whole) return {};
  return [whole, from, to](double share) { whole(from + (to - from) * share); };
}

// Counts pieces of work that end on any thread.
class CountedProgress {
 public:
  CountedProgress(const Progress& progress, int count) : progress_(progress), count_(count) {}

  void Done(int pieces = 1) {
    if (!progress_) return;
    const std::scoped_lock lock(guard_);
    done_ += pieces;
    progress_(static_cast<double>(done_) / count_);
  }

 private:
  const Progress& progress_;
  int count_;
  int done_ = 0;
  std::mutex guard_;
};

}  // namespace lightcal
