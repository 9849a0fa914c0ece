// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/distance_scatter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "lightcal/core/units_text.h"
#include "lightcal/light/effects/distance_error.h"
#include "lightcal/light/fixture.h"

namespace lightcal::fit {
namespace {

constexpr double kInch_m = kMetresPerFoot / 12.0;
constexpr double kCentimetre_m = 0.01;

// Distances written in whole steps as one reads them: three different ones or more that are not all
// on one of the marks (so many steps) at which one sets a meter up.
class StepsRead {
 public:
  StepsRead(double step_m, double near_m, std::array<long, 2> marks)
      : step_m_(step_m), near_m_(near_m), marks_(marks) {}

  void Add(double distance_m) {
    const long nearest = std::lround(distance_m / step_m_);
    whole_ = whole_ && nearest >= 1 &&
             std::abs(distance_m - static_cast<double>(nearest) * step_m_) <= near_m_;
    if (!whole_) return;
    for (std::size_t k = 0; k < marks_.size(); ++k) on_[k] = on_[k] && nearest % marks_[k] == 0;
    const auto end = seen_.begin() + static_cast<std::ptrdiff_t>(different_);
    if (different_ < seen_.size() && std::find(seen_.begin(), end, nearest) == end) {
      seen_[different_++] = nearest;
    }
  }
  [[nodiscard]] bool Told() const {
    return whole_ && different_ == seen_.size() && !on_[0] && !on_[1];
  }

 private:
  double step_m_, near_m_;
  std::array<long, 2> marks_;
  std::array<bool, 2> on_{true, true};
  std::array<long, 3> seen_{};
  std::size_t different_ = 0;
  bool whole_ = true;
};

// From the lamp's reference point to where its light starts, as far as its description says.
double OffsetOf(const LightDescription& light) {
  return light.fixture ? MatchedOffset(OffsetParts(light.fixture)).mean_m : 0.0;
}

}  // namespace

std::optional<Metres> DistanceStepOf(const Session& session) {
  constexpr double kMillimetre_m = 0.0005;  // inches are written in metres to the millimetre
  constexpr double kAsWritten_m = 1e-6;
  StepsRead inches(kInch_m, kMillimetre_m, {5, 6});
  StepsRead centimetres(kCentimetre_m, kAsWritten_m, {5, 5});
  VisitReadings(session, [&](const SessionReading& row) {
    const Reading& reading = row.reading;
    if (!reading.distance || reading.meter == kDataSheetMeter) return;
    inches.Add(reading.distance->value());
    centimetres.Add(reading.distance->value());
  });
  if (inches.Told()) return Metres(kInch_m);
  if (centimetres.Told()) return Metres(kCentimetre_m);
  return std::nullopt;
}

std::optional<double> DistanceSigmaOf(const LightDescription& light, const Reading& reading,
                                      const std::optional<Metres>& step) {
  if (!reading.distance || reading.meter == kDataSheetMeter) return std::nullopt;
  if (reading.distance_sigma) return reading.distance_sigma->value();
  if (light.distance_sigma) return light.distance_sigma->value();
  const double rounding = step ? step->value() / std::sqrt(12.0) : 0.0;
  return std::hypot(rounding, effects::kDistanceSigmaMetres);
}

bool RoundedToInches(const Session& session, const LightDescription& light) {
  const bool asks = !light.distance_sigma && HasDistanceLaw(light.kind) &&
                    std::ranges::any_of(session.readings, [&](const SessionReading& row) {
                      const Reading& reading = row.reading;
                      return reading.light == light.name && reading.distance && IsLit(reading) &&
                             !reading.distance_sigma;
                    });
  return asks && DistanceStepOf(session).value_or(Metres(0.0)).value() > kCentimetre_m;
}

void WidenByDistances(const LightDescription& light, Observations& observations) {
  if (!HasDistanceLaw(light.kind)) return;
  constexpr double kNearestSource = 0.3;  // of the distance
  // Within a centimetre the offset's prior says more, and a reading is no noise for that.
  constexpr double kMost = 0.4;
  const double offset = OffsetOf(light);
  std::vector<Observation*> rows;
  for (Observation& row : observations.rows) {
    if (row.lit && row.distance_sigma_m.value_or(0.0) > 0.0) rows.push_back(&row);
  }
  const auto place = [](const Observation* row) {
    return std::pair(row->distance_m, row->off_axis_rad);
  };
  std::ranges::sort(rows, {}, place);
  for (auto first = rows.begin(); first != rows.end();) {
    const auto last = std::find_if(
        first, rows.end(), [&](const Observation* row) { return place(row) != place(*first); });
    const double shared = std::sqrt(static_cast<double>(last - first));
    for (; first != last; ++first) {
      Observation& row = **first;
      const double r = std::max(row.distance_m + offset, kNearestSource * row.distance_m);
      row.by_distance = shared * std::min(kMost, 2.0 * *row.distance_sigma_m / r);
      row.sigma_lx = std::hypot(row.sigma_lx, row.by_distance * row.measured_lx);
    }
  }
}

}  // namespace lightcal::fit
