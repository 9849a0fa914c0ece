// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/reading_times.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/records/reading_time.h"

namespace lightcal::fit {
namespace {

constexpr double kLeastDrift = 0.02;
// What one steady lamp of a thousand shows, in standard errors, over degrees of freedom left: the
// 99.95th percentile of Student's t.
constexpr std::size_t kFewestLeft = 3;
constexpr std::array<double, 8> kStudent = {12.924, 8.610, 6.869, 5.959,
                                            5.408,  5.041, 4.781, 4.587};  // from kFewestLeft on
// What is left of a column is rounding where the others explain it to this.
constexpr double kLeastLeftOver = 1e-10;
// Below this share of time left, it ran as distance did and tells nothing of its own.
constexpr double kTimeLeft = 1e-3;
constexpr std::size_t kFewestForDrift = 4;
// Readings of one moment that a further one is compared with.
constexpr std::size_t kMostOfOneMoment = 8;

// One instrument cannot be at two distances, nor give the same reading twice, in one moment.
bool CannotBothBe(const Reading& a, const Reading& b) {
  const bool same_kind = a.lamp == b.lamp && a.shadow_card == b.shadow_card;
  if (a.distance && b.distance && *a.distance != *b.distance) return true;
  return same_kind && a.distance == b.distance && a.position_m == b.position_m &&
         a.tilt == b.tilt && a.off_axis == b.off_axis && a.illuminance == b.illuminance;
}

// Sees the readings of one light in their order.
class TimeWatch {
 public:
  TimeWatch(const std::string& light, Warnings& warnings) : light_(light), warnings_(warnings) {}

  void See(const SessionReading& row) {
    const Reading& reading = row.reading;
    const auto seconds = SecondsOfTime(reading.time);
    if (!seconds || !reading.illuminance || reading.quality == MeterQuality::kDerived) return;
    Moment& last = last_[InstrumentOf(reading)];
    const bool same = !last.rows.empty() && *seconds == last.seconds;
    if (same) {
      SayTwice(row, last);
    } else {
      if (!last.rows.empty() && *seconds < last.seconds) SayBackwards(row, *last.rows.back());
      last.rows.clear();
    }
    if (last.rows.size() < kMostOfOneMoment) last.rows.push_back(&row);
    last.seconds = *seconds;
  }

 private:
  struct Moment {
    double seconds = 0.0;
    std::vector<const SessionReading*> rows;
  };

  void SayBackwards(const SessionReading& row, const SessionReading& before) {
    if (std::exchange(backwards_, true)) return;
    warnings_.push_back({"clock_backwards", light_,
                         row.where + " has an earlier time than " + before.where +
                             " before it: was a clock set, or are rows out of order? Times are "
                             "not used but to look for drift"});
  }

  void SayTwice(const SessionReading& row, const Moment& moment) {
    const auto other = std::find_if(
        moment.rows.begin(), moment.rows.end(),
        [&](const SessionReading* r) { return CannotBothBe(r->reading, row.reading); });
    if (other == moment.rows.end() || std::exchange(twice_, true)) return;
    const bool one_place = row.reading.distance == (*other)->reading.distance;
    warnings_.push_back({"duplicate_time", light_,
                         row.where + " has the very time of " + (*other)->where +
                             (one_place ? " and its values: if it is one reading that stands there "
                                          "twice, delete one"
                                        : " at another distance: correct the times, or the "
                                          "distances")});
  }

  const std::string& light_;
  Warnings& warnings_;
  std::map<std::string, Moment> last_;  // by instrument
  bool backwards_ = false;
  bool twice_ = false;
};

// Columns of the linearised model, whitened; each is made square to those before it.
class Explained {
 public:
  void Add(std::vector<double> column) {
    const double before = Length2(column);
    Remove(column);
    const double after = Length2(column);
    if (!(after > kLeastLeftOver * before)) return;
    for (double& v : column) v /= std::sqrt(after);
    columns_.push_back(std::move(column));
  }
  // Leaves of `column` what these do not explain.
  void Remove(std::vector<double>& column) const {
    for (const std::vector<double>& c : columns_) {
      const double part = Dot(c, column);
      for (std::size_t i = 0; i < column.size(); ++i) column[i] -= part * c[i];
    }
  }
  [[nodiscard]] std::size_t count() const { return columns_.size(); }

  static double Dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  }
  static double Length2(const std::vector<double>& a) { return Dot(a, a); }

 private:
  std::vector<std::vector<double>> columns_;
};

struct TimedRow {
  double seconds = 0.0;
  double ln_ratio = 0.0;  // measured over predicted
  double sigma = 1.0;
  double distance_m = 1.0, predicted_lx = 1.0;
};

std::vector<TimedRow> TimedRows(const Session& session, const FittedLight& light) {
  std::vector<const Reading*> readings;
  for (const SessionReading& row : session.readings) {
    if (row.reading.light == light.name) readings.push_back(&row.reading);
  }
  std::vector<TimedRow> rows;
  for (const ResidualRow& residual : light.residuals) {
    const auto index = static_cast<std::size_t>(residual.index);
    if (!residual.used || index >= readings.size() || !(residual.measured_lx > 0.0)) continue;
    if (readings[index]->over_range || readings[index]->under_range) continue;
    const auto seconds = SecondsOfTime(readings[index]->time);
    if (!seconds || !(residual.sigma_relative > 0.0) || !(residual.predicted_lx > 0.0)) continue;
    rows.push_back({*seconds, std::log(residual.measured_lx / residual.predicted_lx),
                    residual.sigma_relative, residual.distance_m.value_or(1.0),
                    residual.predicted_lx});
  }
  return rows;
}

template <class Of>
std::vector<double> Column(const std::vector<TimedRow>& rows, const Of& of) {
  std::vector<double> out;
  out.reserve(rows.size());
  for (const TimedRow& row : rows) out.push_back(of(row) / row.sigma);
  return out;
}

// The change of ln E from the first to the last moment; absent where the rows do not tell it.
std::optional<double> DriftOf(const std::vector<TimedRow>& rows, const FittedLight& light) {
  const auto [first, last] = std::minmax_element(
      rows.begin(), rows.end(),
      [](const TimedRow& a, const TimedRow& b) { return a.seconds < b.seconds; });
  const double span = last->seconds - first->seconds;
  if (!(span > 0.0)) return std::nullopt;
  const double start = first->seconds;
  const double d0 = light.distance_offset_m ? light.distance_offset_m->value : 0.0;
  const bool ambient = light.ambient_lx && light.ambient_lx->u95 > 0.0;
  Explained model;
  model.Add(Column(rows, [](const TimedRow&) { return 1.0; }));
  model.Add(Column(rows, [d0](const TimedRow& r) { return 1.0 / (r.distance_m + d0); }));
  if (ambient) model.Add(Column(rows, [](const TimedRow& r) { return 1.0 / r.predicted_lx; }));
  const auto taken = model.count() + 1;
  if (rows.size() < taken + kFewestLeft) return std::nullopt;
  std::vector<double> left = Column(rows, [](const TimedRow& r) { return r.ln_ratio; });
  std::vector<double> time =
      Column(rows, [&](const TimedRow& r) { return (r.seconds - start) / span; });
  const double whole = Explained::Length2(time);
  model.Remove(left);
  model.Remove(time);
  const double told = Explained::Length2(time);
  if (!(told > kTimeLeft * whole)) return std::nullopt;
  const double change = Explained::Dot(left, time) / told;
  const double rest = std::max(0.0, Explained::Length2(left) - change * change * told);
  const std::size_t freedom = rows.size() - taken;
  const double error = std::sqrt(rest / static_cast<double>(freedom) / told);
  const double most = kStudent[std::min(freedom - kFewestLeft, kStudent.size() - 1)] * error;
  const bool shown = std::abs(change) > std::max(kLeastDrift, most);
  return shown ? std::optional(change) : std::nullopt;
}

}  // namespace

void CheckTimes(const Session& session, const LightDescription& light, Warnings& warnings) {
  TimeWatch watch(light.name, warnings);
  for (const SessionReading& row : session.readings) {
    if (row.reading.light == light.name) watch.See(row);
  }
}

void CheckDrift(const Session& session, const FittedLight& light, Warnings& warnings) {
  const std::vector<TimedRow> rows = TimedRows(session, light);
  if (rows.size() < kFewestForDrift) return;
  const auto change = DriftOf(rows, light);
  if (!change) return;
  warnings.push_back({"drift", light.name,
                      "its light changed by " + PercentText(std::expm1(*change)) +
                          " from the first reading to the last, beyond what distance explains: "
                          "let the lamp warm up ({ReadMeter} {meter.settle}) and measure again"});
}

}  // namespace lightcal::fit
