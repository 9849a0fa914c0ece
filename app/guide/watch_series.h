// SPDX-License-Identifier: Apache-2.0
// The readings of one place as they come, and what their series says of the lamp.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include "lightcal/records/reading.h"

namespace lightcal::app {

struct Steadiness {
  double mean_lx = 0.0, least_lx = 0.0, most_lx = 0.0;
  // Of what the straight trend leaves, where there is one; absent with fewer than three readings or
  // no light.
  std::optional<double> scatter_relative;  // 1 sigma of one reading
  // (largest - smallest)/(largest + smallest), the percent flicker (IES) of what the meter resolves
  std::optional<double> modulation;
  // Where the readings have times of their own; the drift where they span ten seconds and show one.
  std::optional<double> drift_per_minute_relative;
  std::optional<double> rate_hz;
};

class WatchSeries {
 public:
  // Readings remembered; older ones are forgotten.
  static constexpr std::size_t kWindow = 240;

  // seconds: since any moment, rising; absent on a tape, which knows no pace.
  void Add(const Reading& reading, std::optional<double> seconds);

  [[nodiscard]] const std::deque<Reading>& readings() const { return readings_; }
  [[nodiscard]] long count() const { return count_; }
  // Of those remembered. Holds for at least one.
  [[nodiscard]] Steadiness Steady() const;

 private:
  std::deque<Reading> readings_;
  std::deque<std::optional<double>> seconds_;
  long count_ = 0;
};

}  // namespace lightcal::app
