// SPDX-License-Identifier: Apache-2.0
// A lamp's rows with what stands behind each, and what is asked of them where other light is taken
// away. Internal to this room.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "lightcal/fit/model/drift_between.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/fit/model/other_light_taken.h"

namespace lightcal::fit {

struct MeanLux {
  double lux = 0.0;
  double sigma_lx = 0.0;  // 1 sigma
};

class RowsBehind {
 public:
  RowsBehind(const LightDescription& light, Observations& out, std::vector<ReadingBehind> behind);

 protected:
  // Of what row i shows.
  [[nodiscard]] double SigmaLx(std::size_t i) const {
    return std::hypot(out_.rows[i].raw_lx * behind_[i].sigma, behind_[i].last_digit_lx);
  }

  void Keep(const std::vector<bool>& gone);

  [[nodiscard]] static bool SeesOtherLight(const Observation& row) {
    return !row.data_sheet && !row.of_luminance;
  }

  template <class Where>
  [[nodiscard]] std::vector<std::size_t> RowsWhere(const Where& where) const {
    std::vector<std::size_t> rows;
    for (std::size_t j = 0; j < out_.rows.size(); ++j) {
      if (where(j)) rows.push_back(j);
    }
    return rows;
  }

  [[nodiscard]] std::vector<std::size_t> RowsOff() const;

  [[nodiscard]] bool SamePlace(const Observation& row, std::size_t j) const;

  // The mean of those readings among `candidates` that are `of` row i, weighted by their sigmas;
  // none: there is none.
  template <class Of>
  [[nodiscard]] std::optional<MeanLux> MeanOf(std::size_t i,
                                              const std::vector<std::size_t>& candidates,
                                              const Of& of) const {
    const Observation& row = out_.rows[i];
    double weights = 0.0;
    double sum = 0.0;
    for (const std::size_t j : candidates) {
      if (!of(j)) continue;
      const Observation& other = out_.rows[j];
      const double scales =
          other.instrument != row.instrument ? other.raw_lx * other.calibration : 0.0;
      constexpr double kSquarable_lx = 1e-150;
      const double sigma = std::max(
          {std::hypot(SigmaLx(j), scales), kLeastSigma * std::abs(row.raw_lx), kSquarable_lx});
      weights += 1.0 / (sigma * sigma);
      sum += other.raw_lx / (sigma * sigma);
    }
    if (!(weights > 0.0)) return std::nullopt;
    return MeanLux{sum / weights, 1.0 / std::sqrt(weights)};
  }

  void TakeFrom(std::size_t i, const MeanLux& other);

  // Takes that mean from row i. False: there is none.
  template <class Of>
  bool Subtract(std::size_t i, const std::vector<std::size_t>& candidates, const Of& of) {
    const std::optional<MeanLux> other = MeanOf(i, candidates, of);
    if (other) TakeFrom(i, *other);
    return other.has_value();
  }

  // Whether what was read with the lamp off differs from place to place, beyond three standard
  // deviations of each reading.
  [[nodiscard]] bool Differ(const std::vector<std::size_t>& off) const;

  // What was read with the lamp off, over all places: its mean, and how far from it another place
  // may lie, by as few as were read.
  [[nodiscard]] MeanLux Elsewhere(const std::vector<std::size_t>& off) const;

  // Between two readings; relative, 1 sigma.
  [[nodiscard]] double Drift(std::size_t i, std::size_t j) const;

  // Of reading i, since the nearest in time of the candidates that are `of` it; relative, 1 sigma.
  template <class Of>
  [[nodiscard]] double DriftOf(std::size_t i, const std::vector<std::size_t>& candidates,
                               const Of& of) const {
    double least = kSigmaElsewhere;
    for (const std::size_t j : candidates) {
      if (of(j)) least = std::min(least, Drift(i, j));
    }
    return least;
  }

  const LightDescription& light_;
  Observations& out_;
  std::vector<ReadingBehind> behind_;
};

}  // namespace lightcal::fit
