// SPDX-License-Identifier: Apache-2.0
// One line on a terminal that says how far a command is and how long it will still take.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "lightcal/core/progress.h"

namespace lightcal::app {

// "about 12 s left"; "" before a twentieth is done and in the last second.
[[nodiscard]] std::string TimeLeftText(double share, double elapsed_s);
// "merging 34 %, about 12 s left"
[[nodiscard]] std::string ProgressText(std::string_view what, double share, double elapsed_s);

// Silent during the first seconds, where stderr is no terminal, and where it is not wanted;
// wiped at its end. For one thread at a time.
class ProgressLine {
 public:
  static constexpr double kSilent_s = 2.0;
  ProgressLine(std::string what, bool wanted, double silent_s = kSilent_s);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void At(double share);
  // Of work of several parts, each of which counts from 0: the time left is of this one.
  void Begin(std::string what);
  void Wipe();
  // Points to this line, which must outlive it.
  [[nodiscard]] Progress Watcher();

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  bool wanted_, shown_ = false;
  double silent_s_;
  Clock::time_point begun_ = Clock::now(), part_begun_ = begun_, last_shown_{};
};

}  // namespace lightcal::app
