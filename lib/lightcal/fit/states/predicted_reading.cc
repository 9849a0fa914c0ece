// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/states/predicted_reading.h"

#include <algorithm>
#include <cmath>

#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/fit/model/off_axis.h"
#include "lightcal/fit/model/reading_geometry.h"
#include "lightcal/light/wall_prior.h"
#include "lightcal/records/stated_beam.h"

namespace lightcal::fit {
namespace {

// A reading of 1 lx at that place; absent where the lamp does not reach it.
std::optional<Observation> ObservationAt(const LightDescription& light, const Reading& reading) {
  const auto geometry = GeometryOfReading(light, reading, {}, true);
  if (!geometry || !FaultOfReading(light, reading, *geometry, true).empty()) return std::nullopt;
  Observation row;
  StandMeter(light, reading, *geometry, row);
  row.measured_lx = row.raw_lx = 1.0;
  Observations one;
  one.rows = {row};
  PlaceOnSource(light, false, one);
  if (one.rows.empty()) return std::nullopt;
  return one.rows.front();
}

// Whether the lamp shines alike from wherever nothing else tells.
bool ShinesEvenly(LightKind kind) {
  return kind == LightKind::kPoint || kind == LightKind::kSphere || !HasDistanceLaw(kind);
}

}  // namespace

std::optional<PredictedReading> PredictReading(const LightDescription& description,
                                               const FittedLight& light, const Reading& reading) {
  const bool told = reading.distance || (reading.position_m && description.position_m) ||
                    !HasDistanceLaw(light.kind);
  if (!told) return std::nullopt;
  LightDescription known = description;
  if (light.distribution && !OfStatedBeam(light)) known.distribution = light.distribution->table;
  const auto row = ObservationAt(known, reading);
  if (!row) return std::nullopt;
  const bool on_axis = row->off_axis_rad == 0.0 && !row->measured_from_center;
  if (!row->off_axis && !known.distribution && !on_axis && !ShinesEvenly(light.kind)) {
    return std::nullopt;
  }
  const Metres distance(row->distance_m);
  const auto alone = PredictIlluminance(light, distance, 0.0);
  const auto in_room = PredictInRoom(light, distance, 0.0);
  if (!alone || !in_room) return std::nullopt;
  const double ambient = light.ambient_lx ? light.ambient_lx->value : 0.0;
  const double facing = alone->model_lx.value - ambient;
  const Uncertain& whole = *in_room ? (*in_room)->whole_lx : alone->model_lx;
  const double walls = std::max(0.0, whole.value - ambient - facing);
  const double tilted = std::cos(row->tilt_rad);
  double direct = facing * row->table_part * tilted;
  if (row->off_axis && light.intensity_cd) {
    const double offset = light.distance_offset_m ? light.distance_offset_m->value : 0.0;
    direct = light.intensity_cd->value * LuxPerCandela(*row->off_axis, offset) *
             (row->normal ? 1.0 : tilted);
  }
  const double lux = direct + walls * tilted;
  if (!(lux > 0.0)) return std::nullopt;
  return PredictedReading{lux, std::hypot(whole.u95 / kZ95 / lux * tilted, row->sigma_lx)};
}

}  // namespace lightcal::fit
