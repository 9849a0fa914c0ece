// SPDX-License-Identifier: Apache-2.0
#include "progress_line.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "lightcal/core/printable.h"

namespace lightcal::app {
namespace {

constexpr double kBetween_s = 0.2;
constexpr double kTooEarly = 0.05;
constexpr double kLongMinute_s = 90.0;

double SecondsSince(std::chrono::steady_clock::time_point from,
                    std::chrono::steady_clock::time_point now) {
  return std::chrono::duration<double>(now - from).count();
}

}  // namespace

std::string TimeLeftText(double share, double elapsed_s) {
  if (share < kTooEarly) return {};
  const double left_s = elapsed_s * (1.0 - share) / share;
  if (left_s < 1.0) return {};
  const bool minutes = left_s > kLongMinute_s;
  const long count = std::lround(std::ceil(minutes ? left_s / 60.0 : left_s));
  return "about " + std::to_string(count) + (minutes ? " min left" : " s left");
}

std::string ProgressText(std::string_view what, double share, double elapsed_s) {
  const double done = std::clamp(share, 0.0, 1.0);
  const std::string left = TimeLeftText(done, elapsed_s);
  return std::string(what) + " " + std::to_string(static_cast<int>(100.0 * done)) + " %" +
         (left.empty() ? left : ", " + left);
}

ProgressLine::ProgressLine(std::string what, bool wanted, double silent_s)
    : what_(std::move(what)),
      wanted_(wanted && ::isatty(STDERR_FILENO) == 1),
      silent_s_(silent_s) {}

ProgressLine::~ProgressLine() { Wipe(); }

void ProgressLine::At(double share) {
  if (!wanted_) return;
  const Clock::time_point now = Clock::now();
  if (SecondsSince(begun_, now) < silent_s_) return;
  if (shown_ && SecondsSince(last_shown_, now) < kBetween_s) return;
  shown_ = true;
  last_shown_ = now;
  const std::string line =
      "\r\x1b[K" + Printable(ProgressText(what_, share, SecondsSince(part_begun_, now)));
  std::fputs(line.c_str(), stderr);
}

void ProgressLine::Begin(std::string what) {
  what_ = std::move(what);
  part_begun_ = Clock::now();
}

void ProgressLine::Wipe() {
  if (shown_) std::fputs("\r\x1b[K", stderr);
  shown_ = false;
}

Progress ProgressLine::Watcher() {
  if (!wanted_) return {};
  return [this](double share) { At(share); };
}

}  // namespace lightcal::app
