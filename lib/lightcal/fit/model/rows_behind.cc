// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/rows_behind.h"

#include <limits>
#include <utility>

#include "lightcal/core/student.h"
#include "lightcal/records/reading_time.h"

namespace lightcal::fit {

RowsBehind::RowsBehind(const LightDescription& light, Observations& out,
                       std::vector<ReadingBehind> behind)
    : light_(light), out_(out), behind_(std::move(behind)) {
  for (ReadingBehind& one : behind_) one.seconds = SecondsOfTime(one.source->reading.time);
}

void RowsBehind::Keep(const std::vector<bool>& gone) {
  std::vector<Observation> kept;
  std::vector<ReadingBehind> kept_extra;
  for (std::size_t i = 0; i < out_.rows.size(); ++i) {
    if (gone[i]) continue;
    kept.push_back(out_.rows[i]);
    kept_extra.push_back(behind_[i]);
  }
  out_.rows = std::move(kept);
  behind_ = std::move(kept_extra);
}

std::vector<std::size_t> RowsBehind::RowsOff() const {
  return RowsWhere([&](std::size_t j) {
    return !out_.rows[j].lit && !behind_[j].shadow && !behind_[j].no_place;
  });
}

bool RowsBehind::SamePlace(const Observation& row, std::size_t j) const {
  if (!HasDistanceLaw(light_.kind)) return true;
  const std::optional<Vec3>& there = out_.rows[j].position_m;
  if (row.position_m && there) return Length(*row.position_m - *there) < kSamePlace_m;
  return !behind_[j].no_place && SameDistance(row.distance_m, out_.rows[j].distance_m) &&
         row.off_axis_rad == out_.rows[j].off_axis_rad;
}

void RowsBehind::TakeFrom(std::size_t i, const MeanLux& other) {
  Observation& row = out_.rows[i];
  row.measured_lx = row.raw_lx - other.lux;
  row.card_lx = other.lux;
  row.card_sigma_lx = other.sigma_lx;
  row.sigma_lx = std::hypot(SigmaLx(i), other.sigma_lx);
}

bool RowsBehind::Differ(const std::vector<std::size_t>& off) const {
  constexpr double kDiffer = 3.0;
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (const std::size_t j : off) {
    const double lux = out_.rows[j].raw_lx;
    least = std::min(least, lux + kDiffer * SigmaLx(j));
    most = std::max(most, lux - kDiffer * SigmaLx(j));
  }
  return most > least;
}

MeanLux RowsBehind::Elsewhere(const std::vector<std::size_t>& off) const {
  MeanLux out;
  for (const std::size_t j : off) out.lux += out_.rows[j].raw_lx;
  const auto n = static_cast<double>(off.size());
  out.lux /= n;
  if (off.size() < 2) return out;
  double squares = 0.0;
  for (const std::size_t j : off) squares += std::pow(out_.rows[j].raw_lx - out.lux, 2.0);
  const double sd = std::sqrt(squares / (n - 1.0) * (1.0 + 1.0 / n));
  out.sigma_lx = StudentOverNormal(n - 1.0) * sd;
  return out;
}

double RowsBehind::Drift(std::size_t i, std::size_t j) const {
  return DriftBetween(behind_[i].seconds, behind_[j].seconds,
                      behind_[i].shadow || behind_[j].shadow);
}

}  // namespace lightcal::fit
