// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/observations.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units.h"
#include "lightcal/fit/model/distance_scatter.h"
#include "lightcal/fit/model/other_light_taken.h"
#include "lightcal/fit/model/reading_geometry.h"
#include "lightcal/records/display_step.h"

namespace lightcal::fit {
namespace {

// People point a meter within a degree, 1 sigma, once they mean a tilt.
constexpr double kTiltSigma = kRadiansPerDegree;
// A reading under range lies anywhere from 0 to its limit L: mean L/2, sigma L/sqrt(12).
constexpr double kUnderRangeMean = 0.5;
const double kUnderRangeSigma = 1.0 / std::sqrt(3.0);  // relative to the mean

std::string RowName(const SessionReading& row, int index) {
  return row.where.empty() ? "reading " + std::to_string(index) : row.where;
}

// Nothing else shines in a picture of the lamp itself; a meter beside the camera sees the room.
bool ShowsTheLampAlone(const Reading& reading) {
  return reading.of_luminance && ByOwnScale(reading);
}

class Collector {
 public:
  Collector(const Session& session, const LightDescription& light)
      : session_(session), light_(light), distance_step_(DistanceStepOf(session)) {}

  Result<Observations> Collect() {
    for (const SessionReading& row : session_.readings) {
      if (row.reading.light != light_.name) continue;
      if (row.reading.illuminance) (void)InstrumentIndex(row.reading);
    }
    for (const SessionReading& row : session_.readings) {
      if (row.reading.light != light_.name) continue;
      const int index = out_.readings++;
      if (auto added = Add(row, index); !added) return tl::unexpected(std::move(added).error());
    }
    auto taken = TakeOtherLight(light_, std::move(behind_), out_);
    if (!taken) return Propagate(std::move(taken));
    WidenByDistances(light_, out_);
    out_.by_camera = instruments_.size() == 1 && !out_.rows.empty() && out_.rows[0].picture;
    std::sort(out_.rejected.begin(), out_.rejected.end());
    return std::move(out_);
  }

 private:
  Result<void> Reject(const SessionReading& row, int index, const std::string& fault) {
    out_.rejected.push_back(index);
    out_.warnings.push_back({"row_rejected", RowName(row, index), fault});
    return {};
  }

  Result<void> Add(const SessionReading& row, int index) {
    const Reading& reading = row.reading;
    if (!row.fault.empty()) return Reject(row, index, row.fault);
    if (!reading.illuminance) return {};  // a colour reading
    const bool lit = reading.lamp == LampState::kOn && !reading.shadow_card;
    auto geometry = GeometryOfReading(light_, reading, RowName(row, index), lit);
    if (!geometry) return tl::unexpected(std::move(geometry).error());
    const std::string fault = FaultOfReading(light_, reading, *geometry, lit);
    if (!fault.empty()) return Reject(row, index, fault);
    if (reading.shadow_card) ++out_.shadow_readings;
    Observation observation;
    observation.index = index;
    observation.lit = lit;
    observation.behind_card = reading.shadow_card;
    observation.placed = reading.distance || reading.position_m;
    observation.measured_lx = observation.raw_lx =
        (reading.under_range ? kUnderRangeMean : 1.0) * reading.illuminance->value();
    observation.over_range = reading.over_range;
    observation.data_sheet = reading.meter == kDataSheetMeter;
    observation.picture = ByOwnScale(reading);
    observation.sees_walls = HoldsWallLight(session_, light_, reading);
    observation.of_luminance = ShowsTheLampAlone(reading);
    StandMeter(light_, reading, *geometry, observation);
    observation.distance_sigma_m = DistanceSigmaOf(light_, reading, distance_step_);
    observation.calibration = CalibrationRelative(session_, reading);
    observation.instrument = InstrumentIndex(reading);
    const double sigma = SigmaOf(reading);
    behind_.push_back({lit ? std::hypot(sigma, std::tan(geometry->tilt_rad) * kTiltSigma) : sigma,
                       LastDigitOf(observation.instrument, reading), reading.shadow_card,
                       !lit && !observation.placed, &row});
    out_.rows.push_back(observation);
    return {};
  }

  // Where several instruments speak, what sets them apart belongs to each reading's sigma.
  [[nodiscard]] double SigmaOf(const Reading& reading) const {
    if (reading.under_range) return kUnderRangeSigma;
    return std::max(kLeastSigma, instruments_.size() == 1 ? RepeatabilityRelative(session_, reading)
                                                          : SigmaRelative(session_, reading));
  }

  // 1 sigma of a display's last digit, absolute.
  double LastDigitOf(int instrument, const Reading& reading) {
    if (reading.under_range || reading.over_range) return 0.0;
    const auto [known, fresh] = display_step_lx_.try_emplace(instrument, 0.0);
    if (fresh) known->second = DisplayStepOf(session_, reading);
    const double step = known->second;
    const MeterDescription* const meter = FindMeter(session_, reading.meter);
    const bool stated = meter && (meter->step || meter->repeatability_relative);
    const bool counts = stated || reading.illuminance->value() < kStepsEnough * step;
    return counts ? SigmaOfDisplay(step) : 0.0;
  }

  int InstrumentIndex(const Reading& reading) {
    const std::string& name = InstrumentOf(reading);
    const auto known = std::find(instruments_.begin(), instruments_.end(), name);
    const auto index = static_cast<int>(known - instruments_.begin());
    if (known == instruments_.end()) instruments_.push_back(name);
    return index;
  }

  const Session& session_;
  const LightDescription& light_;
  std::optional<Metres> distance_step_;
  Observations out_;
  std::vector<ReadingBehind> behind_;      // of out_.rows
  std::map<int, double> display_step_lx_;  // of each instrument
  std::vector<std::string> instruments_;
};

}  // namespace

void StandMeter(const LightDescription& light, const Reading& reading,
                const ReadingGeometry& geometry, Observation& row) {
  row.distance_m = geometry.distance_m;
  row.tilt_rad = geometry.tilt_rad;
  row.measured_from_center = geometry.from_center;
  row.off_axis_rad = reading.off_axis.value();
  row.position_m = reading.position_m;
  if (reading.normal) row.normal = *reading.normal * (1.0 / Length(*reading.normal));
  const TablePart table = TablePartTowards(light, reading);
  row.table_part = table.of_peak;
  row.table_error = table.error;
}

bool HasDistanceLaw(LightKind kind) {
  return kind != LightKind::kDirectional && kind != LightKind::kDome;
}

bool SameDistance(double a_m, double b_m) {
  return std::abs(a_m - b_m) <= 1e-3 * std::max(std::abs(a_m), std::abs(b_m));
}

bool SamePlace(const Reading& a, const Reading& b) {
  constexpr double kSameAngle_rad = 1e-3;
  if (a.position_m && b.position_m) {
    const bool turned = a.normal && b.normal &&
                        Dot(*a.normal, *b.normal) <
                            std::cos(kSameAngle_rad) * Length(*a.normal) * Length(*b.normal);
    return !turned && Length(*a.position_m - *b.position_m) < kSamePlace_m;
  }
  if (a.distance && b.distance) {
    return SameDistance(a.distance->value(), b.distance->value()) &&
           std::abs(a.tilt.value() - b.tilt.value()) < kSameAngle_rad &&
           std::abs(a.off_axis.value() - b.off_axis.value()) < kSameAngle_rad;
  }
  return !a.distance && !b.distance && !a.position_m && !b.position_m;
}

bool IsCardOf(const SessionReading& row, const Reading& reading) {
  const Reading& card = row.reading;
  return card.shadow_card && card.illuminance && card.light == reading.light &&
         row.others_lit.empty() && SameState(card.state, reading.state) && SamePlace(card, reading);
}

int CountDistinctDistances(const std::vector<Observation>& rows) {
  std::vector<double> distances;
  for (const Observation& row : rows) {
    if (row.lit && !row.over_range) distances.push_back(row.distance_m);
  }
  std::sort(distances.begin(), distances.end());
  int count = 0;
  std::optional<double> last;
  for (const double d : distances) {
    if (last && SameDistance(*last, d)) continue;
    last = d;
    ++count;
  }
  return count;
}

bool HoldsWallLight(const Session& session, const LightDescription& light, const Reading& reading) {
  if (session.surroundings == Surroundings::kDark || reading.meter == kDataSheetMeter ||
      !HasDistanceLaw(light.kind)) {
    return false;
  }
  return !ShowsTheLampAlone(reading);
}

Result<Observations> CollectObservations(const Session& session, const LightDescription& light) {
  return Collector(session, light).Collect();
}

}  // namespace lightcal::fit
