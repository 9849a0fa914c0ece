// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/prepare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "lightcal/fit/model/row_values.h"
#include "lightcal/light/effects/detector_size.h"
#include "lightcal/light/effects/haze.h"

namespace lightcal::fit {
namespace {

constexpr int kDistancesForAmbient = 4;

Scales ScalesOf(const Observations& observations) {
  double ln_length = 0.0;
  double ln_illuminance = 0.0;
  int count = 0;
  for (const Observation& row : observations.rows) {
    if (!row.lit || !(row.measured_lx > 0.0)) continue;
    ln_length += std::log(row.distance_m);
    ln_illuminance += std::log(row.measured_lx);
    ++count;
  }
  if (count == 0) return {};
  return {std::exp(ln_length / count), std::exp(ln_illuminance / count)};
}

// What a relative error of the reading is counted in, as its sigma is.
double UnitOf(const ReadingRow& row) { return row.form == RowForm::kLinear ? row.measured : 1.0; }

AxialShape Scaled(AxialShape shape, double length_m) {
  shape.first /= length_m;
  shape.second /= length_m;
  return shape;
}

OffAxisPose Scaled(OffAxisPose pose, double length_m) {
  std::visit(
      [length_m](auto& source) {
        using Source = std::decay_t<decltype(source)>;
        if constexpr (std::is_same_v<Source, SphereSource> || std::is_same_v<Source, DiskSource>) {
          source.radius /= length_m;
        } else if constexpr (std::is_same_v<Source, RectSource>) {
          source.half_width /= length_m;
          source.half_height /= length_m;
        } else if constexpr (std::is_same_v<Source, TubeSource>) {
          source.half_length /= length_m;
          source.radius /= length_m;
        }
      },
      pose.source);
  pose.at.position = pose.at.position * (1.0 / length_m);
  return pose;
}

ReadingRow RowOf(const Observation& observation, std::size_t i, const ForwardModel& model,
                 const Scales& scales) {
  ReadingRow row;
  FillRowValues(observation, i, model, scales.length_m, scales.illuminance_lx, row);
  row.own_sigma = row.sigma;
  row.calibration = observation.calibration;
  row.instrument = observation.instrument;
  row.data_sheet = observation.data_sheet;
  row.picture = observation.picture;
  if (!observation.lit) {
    row.direct_gain = 0.0;
    return row;
  }
  if (i < model.uneven.size()) row.uneven = model.uneven[i];
  row.shape = Scaled(model.shape, scales.length_m);
  const double surface = observation.measured_from_center ? 0.0 : model.surface_radius_m;
  row.distance = (observation.distance_m + surface) / scales.length_m;
  row.by_aim = observation.by_aim;
  if (observation.off_axis) row.off_axis = Scaled(*observation.off_axis, scales.length_m);
  // A pose off the axis holds its normal; without one the tilt is all that is known.
  if (model.tilt && !(observation.off_axis && observation.normal)) {
    row.direct_gain = std::cos(observation.tilt_rad);
  }
  row.direct_gain *= observation.table_part;
  if (model.head_radius_m > 0.0) {
    row.direct_gain *= effects::DetectorFactor(model.head_radius_m, observation.distance_m);
  }
  if (!observation.data_sheet) {
    row.direct_gain *= effects::HazeFactor(model.haze_per_m, observation.distance_m);
  }
  return row;
}

// Behind the card, without the direct light.
ReadingRow CardRowOf(const Observation& observation, const Scales& scales) {
  ReadingRow row;
  FillRowValues(BehindCard(observation), 0, ForwardModel{}, scales.length_m, scales.illuminance_lx,
                row);
  row.own_sigma = row.sigma;
  row.calibration = observation.calibration;
  row.instrument = observation.instrument;
  row.direct_gain = 0.0;
  return row;
}

void AddCardRows(const Observations& observations, Prepared& out) {
  for (std::size_t i = 0; i < observations.rows.size(); ++i) {
    const Observation& observation = observations.rows[i];
    if (!observation.lit || !observation.differenced) continue;
    const auto own = std::ranges::find(out.observation, static_cast<int>(i));
    if (own == out.observation.end()) continue;
    WidenByCard(observation, kCardHides, out.scales.illuminance_lx,
                out.estimation.rows[static_cast<std::size_t>(own - out.observation.begin())]);
    if (!(observation.card_sigma_lx > 0.0)) continue;
    out.estimation.rows.push_back(CardRowOf(observation, out.scales));
    out.observation.push_back(static_cast<int>(i));
  }
}

// Beside figures of a data sheet, which have none of it, what is in a person's readings alone
// counts in their weight: a reading more never widens.
void WidenBesideDataSheet(const Observations& observations, const ForwardModel& model,
                          Prepared& out) {
  const auto printed = [](const Observation& o) { return o.lit && o.data_sheet; };
  if (std::ranges::none_of(observations.rows, printed)) return;
  for (std::size_t n = 0; n < out.estimation.rows.size(); ++n) {
    ReadingRow& row = out.estimation.rows[n];
    if (row.data_sheet || row.form == RowForm::kCensored) continue;
    const Observation& observation =
        observations.rows[static_cast<std::size_t>(out.observation[n])];
    double variance = 0.0;
    for (const Consider& one : model.considered) {
      if (!one.own_lamp || !observation.lit) continue;
      const double sd = one.relative * std::pow(observation.distance_m, one.distance_power);
      variance += sd * sd;
    }
    const double unit = UnitOf(row);
    row.sigma = row.own_sigma = std::hypot(row.sigma, std::sqrt(variance) * unit);
  }
}

// What each of the instruments that saw the lamp lit is off by in all it read, and how often it
// did.
struct OneInstrument {
  int readings = 0;
  double calibration = 0.0;
};

std::vector<OneInstrument> InstrumentsOf(const Observations& observations) {
  std::vector<OneInstrument> out;
  for (const Observation& o : observations.rows) {
    const auto at = static_cast<std::size_t>(o.instrument);
    if (at >= out.size()) out.resize(at + 1);
    if (!o.lit) continue;
    ++out[at].readings;
    out[at].calibration = std::max(out[at].calibration, o.calibration);
  }
  return out;
}

// Of several instruments, the one that read most finds its scale beside the others: its readings
// keep what they say of one another. m readings of another carry sqrt(m) times its calibration
// each, so that their mean is no surer than that.
void FreeScale(const Observations& observations, Prepared& out) {
  const std::vector<OneInstrument> instruments = InstrumentsOf(observations);
  const auto read = [](const OneInstrument& one) { return one.readings > 0; };
  if (std::ranges::count_if(instruments, read) < 2) return;
  const auto most = std::ranges::max_element(instruments, {}, [](const OneInstrument& one) {
    return std::pair(one.calibration > 0.0 ? one.readings : 0, one.calibration);
  });
  const bool scaled = most->calibration > 0.0 && most->readings > 1;
  if (scaled) out.estimation.rules[kLnScale] = {true, 0.0, most->calibration};
  for (ReadingRow& row : out.estimation.rows) {
    if (!(row.calibration > 0.0)) continue;
    const OneInstrument& own = instruments[static_cast<std::size_t>(row.instrument)];
    const double unit = std::abs(UnitOf(row));
    const double beside = unit > 0.0
                              ? unit * RepeatabilityBeside(row.own_sigma / unit, row.calibration)
                              : row.own_sigma;
    const bool finds = scaled && &own == &*most;
    if (finds) row.scale = row.calibration / most->calibration;
    const double carried = finds ? 0.0 : std::sqrt(std::max(1, own.readings)) * row.calibration;
    row.sigma = row.own_sigma = std::hypot(beside, carried * unit);
    row.calibration = 0.0;
  }
}

}  // namespace

Prepared Prepare(const Observations& observations, const ForwardModel& model) {
  Prepared out;
  out.estimation.choice = model.choice;
  out.estimation.uneven_part = model.uneven_part;
  out.scales = ScalesOf(observations);
  out.shortest = std::numeric_limits<double>::infinity();
  double dimmest = std::numeric_limits<double>::infinity();
  bool offset_possible = model.distance_law && model.fit_offset;
  for (std::size_t i = 0; i < observations.rows.size(); ++i) {
    const Observation& observation = observations.rows[i];
    if (!observation.lit && !model.fit_ambient) continue;
    out.estimation.rows.push_back(RowOf(observation, i, model, out.scales));
    out.observation.push_back(static_cast<int>(i));
    const ReadingRow& row = out.estimation.rows.back();
    if (!observation.lit) {
      out.ambient_told = true;
      continue;
    }
    ++out.lit_rows;
    out.shortest = std::min(out.shortest, row.distance);
    if (row.form == ReadingRow::Form::kLog && row.ambient_gain > 0.0) {
      dimmest = std::min(dimmest, row.measured);
    }
  }
  out.distances = model.distance_law ? CountDistinctDistances(observations.rows) : 1;
  offset_possible = offset_possible && out.lit_rows > 0;
  auto& rules = out.estimation.rules;
  rules[kLnIntensity].free = true;
  if (offset_possible) {
    rules[kDistanceOffset].prior_sd = kOffsetPriorRelative * out.shortest;
    rules[kDistanceOffset].free = out.distances >= 2;
  }
  std::ranges::copy(observations.aim, rules.begin() + kAimX);
  out.estimation.least_distance_offset = kLeastOffset * out.shortest;
  if (out.ambient_told) {
    rules[kAmbient].free = true;
  } else if (model.fit_ambient && model.distance_law &&
             (model.walls.empty() || model.over_ground) && out.distances >= kDistancesForAmbient &&
             std::isfinite(dimmest)) {
    // Ambient light cannot exceed the dimmest reading.
    rules[kAmbient] = {true, 0.0, dimmest};
  }
  WidenBesideDataSheet(observations, model, out);
  out.own_rows = static_cast<int>(out.estimation.rows.size());
  if (!model.walls.empty()) AddCardRows(observations, out);
  FreeScale(observations, out);
  // Beside walls the lamp's share counts (SettleScatter).
  for (ReadingRow& row : out.estimation.rows) {
    const double unit = UnitOf(row);
    row.sigma = std::hypot(row.sigma, row.uneven * unit);
  }
  return out;
}

}  // namespace lightcal::fit
