// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/beam/beam_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "lightcal/core/units.h"
#include "lightcal/fit/beam/spot_beam.h"
#include "lightcal/fit/model/off_axis.h"
#include "lightcal/fit/model/row_values.h"
#include "lightcal/light/effects/haze.h"

namespace lightcal::fit {
namespace {

constexpr double kDarkOfPeak = 2e-4;     // what a meter still sees in the dark, of the beam's peak
constexpr double kOffAxisScatter = 0.5;  // of ln of the walls' light, in and around a beam
constexpr double kPlaceSigma_m = 0.01;   // 1 sigma of where a meter stood
constexpr double kAnyAim = 0.4;          // 1 sigma of the tilts of an aim that nobody stated

// Whether it may shine alike in all directions: by places; by angles where it was read over a span
// of them, or is said to be a bulb.
bool MayBeEven(const LightDescription& light, bool placed, double angles_read_rad) {
  if (light.kind != LightKind::kPoint || light.beam || light.field) return false;
  if (placed) return true;
  if (!light.fixture) return angles_read_rad >= kEvenSpan_rad;
  switch (*light.fixture) {
    case Fixture::kBulb:
      return true;
    case Fixture::kSoftbox:
    case Fixture::kLuminaire:
      return angles_read_rad >= kEvenSpan_rad;
    default:
      return false;
  }
}

// The aim as stated, or towards the brightest.
Vec3 FirstAim(const Observations& observations, const LightDescription& light) {
  if (light.aim) return *light.aim;
  Vec3 middle{};
  if (light.position_m) {
    for (const Observation& row : observations.rows) {
      if (!LitAndPlaced(row)) continue;
      const Vec3 from = *row.position_m - *light.position_m;
      middle = middle + from * (std::max(0.0, row.measured_lx) * Length(from));
    }
  }
  const double length = Length(middle);
  return length > 0.0 ? middle * (1.0 / length) : Vec3{0.0, 0.0, -1.0};
}

BeamRow RowOfObservation(const Observation& o, const LightDescription& light,
                         const SourceFrame& frame, double ambient) {
  BeamRow row;
  if (LitAndPlaced(o) && light.position_m) {
    row.from_lamp = frame.Of(*o.position_m - *light.position_m);
    if (o.normal) row.normal = frame.Of(*o.normal);
    row.angle_sd = kPlaceSigma_m / Length(row.from_lamp);
  } else {
    row.from_lamp = {o.distance_m * std::sin(o.off_axis_rad), 0.0,
                     o.distance_m * std::cos(o.off_axis_rad)};
    row.angle_sd = AngleSigma(light).value();
  }
  if (!row.normal) row.gain = std::cos(o.tilt_rad);
  row.measured = o.measured_lx - (o.differenced || o.ambient_subtracted ? 0.0 : ambient);
  row.sigma = o.sigma_lx;
  return row;
}

void SetForm(bool over_range, double dark, BeamRow& row) {
  const double sigma = std::hypot(row.sigma, dark / Dot(row.from_lamp, row.from_lamp));
  const bool log = row.measured > 0.0 && sigma < kLinearBeyondSigma * row.measured;
  row.form = log ? (over_range ? RowForm::kCensored : RowForm::kLog) : RowForm::kLinear;
  row.sigma = row.own_sigma = log ? sigma / row.measured : sigma;
}

void AddWalls(const Observations& observations, const WallPrior& prior, BeamRows& out) {
  for (std::size_t i = 0; i < out.readings.rows.size(); ++i) {
    BeamRow& row = out.readings.rows[i];
    const Observation& o = observations.rows[out.observation[i]];
    if (!o.sees_walls || (row.lit && o.differenced)) continue;
    const double x = std::log(Length(row.from_lamp) / kWallReference_m);
    row.walls = WallsOfRow{x, prior.bend * x * x, std::hypot(prior.scatter, kOffAxisScatter)};
  }
}

void AddSheet(const LightDescription& light, std::vector<SheetRow>& sheet) {
  // Where a beam falls through half of its peak it loses about .7 of it in an angle as large as
  // its half angle; at a tenth, about .25.
  if (light.beam) {
    sheet.push_back({0.5 * light.beam->value(), 0.5, 0.7 * kSheetAngle});
  }
  if (light.field) {
    sheet.push_back({0.5 * light.field->value(), 0.1, 0.25 * kSheetAngle});
  }
}

}  // namespace

double AmbientOfOff(const Observations& observations) {
  double sum = 0.0;
  int count = 0;
  for (const Observation& row : observations.rows) {
    if (row.lit || row.behind_card) continue;
    sum += row.measured_lx;
    ++count;
  }
  return count > 0 ? sum / count : 0.0;
}

BeamRows RowsOfBeam(const Observations& observations, const LightDescription& light,
                    const ForwardModel* model) {
  BeamRows out;
  out.frame = SourceFrame::Facing(FirstAim(observations, light));
  const double ambient = AmbientOfOff(observations);
  double peak = 0.0;
  double shortest = std::numeric_limits<double>::infinity();
  double widest = 0.0;
  double nearest = std::numeric_limits<double>::infinity();  // to the axis
  bool left = false;
  bool right = false;
  for (std::size_t i = 0; i < observations.rows.size(); ++i) {
    const Observation& o = observations.rows[i];
    if (!o.lit || !o.placed) continue;
    out.readings.rows.push_back(RowOfObservation(o, light, out.frame, ambient));
    out.observation.push_back(i);
    const BeamRow& row = out.readings.rows.back();
    const double r2 = Dot(row.from_lamp, row.from_lamp);
    peak = std::max(peak, row.measured * r2);
    shortest = std::min(shortest, std::sqrt(r2));
    out.placed = out.placed || LitAndPlaced(o);
    widest = std::max(widest, std::abs(o.off_axis_rad));
    nearest = std::min(nearest, std::abs(o.off_axis_rad));
    left = left || o.off_axis_rad < 0.0;
    right = right || o.off_axis_rad > 0.0;
  }
  const std::size_t lit = out.readings.rows.size();
  for (std::size_t i = 0; i < lit; ++i) {
    SetForm(observations.rows[out.observation[i]].over_range, kDarkOfPeak * peak,
            out.readings.rows[i]);
  }
  if (out.placed) {
    const double sd = light.aim ? std::tan(kAimSigmaDegrees * kRadiansPerDegree) : kAnyAim;
    out.readings.aim = {ParameterRule{true, 0.0, sd}, ParameterRule{true, 0.0, sd}};
  } else if (const double sd = std::tan(AngleSigma(light).value()); sd > 0.0 && (left || right)) {
    out.readings.aim[0] = {true, 0.0, sd};
  }
  AddSheet(light, out.readings.sheet);
  out.readings.may_be_even = MayBeEven(light, out.placed, widest - nearest);
  if (model == nullptr) return out;
  for (BeamRow& row : out.readings.rows) {
    row.gain *= effects::HazeFactor(model->haze_per_m, Length(row.from_lamp));
  }
  if (model->fit_offset && model->distance_law) {
    out.readings.offsets = model->offsets;
    if (out.readings.offsets.empty()) {
      out.readings.offsets = {{1.0, 0.0, kOffsetPriorRelative * shortest}};
    }
  }
  // What a card hid the lamp from measures the walls for those without a card.
  for (std::size_t i = 0; i < lit && !model->walls.empty(); ++i) {
    const Observation& o = observations.rows[out.observation[i]];
    if (!o.differenced || !(o.card_sigma_lx > 0.0) || !(o.card_lx > 0.0)) continue;
    BeamRow row = out.readings.rows[i];
    row.lit = false;
    const Observation card = BehindCard(o);
    row.measured = card.measured_lx - (card.ambient_subtracted ? 0.0 : ambient);
    row.sigma = card.sigma_lx;
    SetForm(false, 0.0, row);
    out.readings.rows.push_back(row);
    out.observation.push_back(out.observation[i]);
  }
  out.readings.walls = OneNormalOf(model->walls);
  if (out.readings.walls) AddWalls(observations, *out.readings.walls, out);
  return out;
}

}  // namespace lightcal::fit
