// SPDX-License-Identifier: Apache-2.0
// Pieces of work that go on at the same time, each from 0 to 1, told as one.
#pragma once

#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

#include "lightcal/core/progress.h"

namespace lightcal::app {

class JointProgress {
 public:
  JointProgress(Progress whole, std::size_t count) : whole_(std::move(whole)), shares_(count) {}

  // Of one piece, on any thread; points to this, which must outlive it.
  [[nodiscard]] Progress Of(std::size_t piece) {
    if (!whole_) return {};
    return [this, piece](double share) {
      const std::scoped_lock lock(guard_);
      sum_ += share - shares_[piece];
      shares_[piece] = share;
      whole_(sum_ / static_cast<double>(shares_.size()));
    };
  }
  void Done(std::size_t piece) {
    if (whole_) Of(piece)(1.0);
  }

 private:
  Progress whole_;
  std::vector<double> shares_;
  double sum_ = 0.0;
  std::mutex guard_;
};

}  // namespace lightcal::app
