// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/locate/locate_search.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lightcal/fit/locate/placed_starts.h"
#include "lightcal/fit/model/row_values.h"
#include "lightcal/fit/model/shared_scatter.h"
#include "lightcal/light/effects/detector_size.h"
#include "lightcal/light/effects/haze.h"

namespace lightcal::fit {
namespace {

constexpr int kReadingsForAmbient = 6;
// 1 sigma of what a card hides at one place beside what it hides at the lamp's others, of all that
// it leaves (tests/tools/traced_rooms: .018 facing, .009 flat).
constexpr double kCardHidesHere = 0.02;
constexpr double kUsualShare = 0.5;  // of the walls' light in a reading, before a place is known

PlacedFrame FrameOf(const Observations& observations) {
  std::vector<PlacedRow> rows;
  double ln_lux = 0.0;
  int count = 0;
  for (const Observation& o : observations.rows) {
    if (!o.lit) continue;
    PlacedRow row;
    if (IsPlaced(o)) row.position = o.position_m;
    rows.push_back(row);
    if (!(o.measured_lx > 0.0)) continue;
    ln_lux += std::log(o.measured_lx);
    ++count;
  }
  const Layout layout = LayoutOf(rows);
  return {layout.middle, layout.extent, count > 0 ? std::exp(ln_lux / count) : 1.0};
}

PlacedRow RowOf(const Observations& observations, std::size_t i, const ForwardModel& model,
                const PlacedFrame& frame) {
  const Observation& o = observations.rows[i];
  PlacedRow row;
  FillRowValues(o, i, model, frame.length_m, frame.lux, row);
  row.own_sigma = row.sigma;
  row.direct_gain = o.lit ? 1.0 : 0.0;
  row.instrument = o.instrument;
  row.distance = o.distance_m / frame.length_m;
  if (o.measured_from_center && o.position_m) {
    row.position = (*o.position_m - frame.origin) * (1.0 / frame.length_m);
  }
  if (!o.lit) return row;
  row.normal = o.normal;
  if (!o.normal) row.direct_gain = row.tilt_cosine = std::cos(o.tilt_rad);
  if (model.head_radius_m > 0.0) {
    row.direct_gain *= effects::DetectorFactor(model.head_radius_m, o.distance_m);
  }
  row.direct_gain *= effects::HazeFactor(model.haze_per_m, o.distance_m);
  return row;
}

// The walls alone, behind the card whose reading was subtracted.
PlacedRow CardRowOf(const Observation& o, const PlacedFrame& frame) {
  PlacedRow row;
  FillRowValues(BehindCard(o), 0, ForwardModel{}, frame.length_m, frame.lux, row);
  row.own_sigma = row.sigma;
  row.direct_gain = 0.0;
  if (IsPlaced(o)) row.position = (*o.position_m - frame.origin) * (1.0 / frame.length_m);
  row.distance = o.distance_m / frame.length_m;
  return row;
}

// Where the lamp's size counts. Turned about its aim as a lamp of stated place is.
std::optional<PlacedFace> FaceOf(const LightDescription& light, const ForwardModel& model,
                                 double unit_m) {
  if (!light.aim || model.shape.outline == AxialShape::Outline::kPoint) return std::nullopt;
  const SourceFrame frame = SourceFrame::Facing(*light.aim, light.axis.value_or(Vec3{}));
  const auto half = [&](Metres length) { return 0.5 * length.value() / unit_m; };
  if (light.kind == LightKind::kDisk && light.diameter) {
    return PlacedFace{DiskSource{half(*light.diameter)}, frame};
  }
  if (light.kind == LightKind::kRect && light.width && light.height) {
    return PlacedFace{RectSource{half(*light.width), half(*light.height)}, frame};
  }
  return std::nullopt;
}

// One normal of all that the lamp may be.
void AddWalls(const Observations& observations, const WallPrior& prior, PlacedProblem& problem) {
  std::vector<PlacedRow>& rows = problem.estimation.rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Observation& o = observations.rows[static_cast<std::size_t>(problem.observation[i])];
    if (o.lit && o.differenced) WidenByCard(o, kCardHidesHere, problem.frame.lux, rows[i]);
  }
  const bool some_open = std::ranges::any_of(
      observations.rows, [](const Observation& o) { return o.lit && !o.differenced; });
  for (std::size_t i = 0; some_open && i < observations.rows.size(); ++i) {
    const Observation& o = observations.rows[i];
    if (!o.lit || !o.differenced || !(o.card_sigma_lx > 0.0)) continue;
    rows.push_back(CardRowOf(o, problem.frame));
    problem.observation.push_back(static_cast<int>(i));
    ++problem.card_rows;
  }
  const double unit = problem.frame.length_m;
  std::vector<ReadingOfWalls> seeing;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    PlacedRow& row = rows[i];
    const Observation& o = observations.rows[static_cast<std::size_t>(problem.observation[i])];
    const bool lit_row = row.direct_gain > 0.0;
    if (!SeesWalls(o, lit_row) || !(lit_row || o.placed)) continue;
    PlacedWalls walls;
    walls.x = std::log(o.distance_m / kWallReference_m);
    walls.constant = 2.0 * std::log(unit);
    walls.ln_unit = std::log(unit / kWallReference_m);
    row.walls = walls;
    if (!o.over_range) seeing.push_back({lit_row, &*row.walls, &o});
  }
  if (seeing.empty()) return;
  ShareScatter(std::move(seeing));
  SetWalls(prior, problem.estimation);
  for (PlacedRow& row : rows) {
    if (row.walls) row.sigma = std::hypot(row.own_sigma, kUsualShare * row.walls->scatter);
  }
}

void SetRules(const ForwardModel& model, PlacedProblem& problem) {
  double dimmest = std::numeric_limits<double>::infinity();
  double shortest = std::numeric_limits<double>::infinity();
  double off = 0.0;
  int offs = 0;
  for (const PlacedRow& row : problem.estimation.rows) {
    if (row.direct_gain > 0.0) {
      if (!row.position) shortest = std::min(shortest, row.distance);
      if (row.form == RowForm::kLog && row.ambient_gain > 0.0) {
        dimmest = std::min(dimmest, row.measured);
      }
      continue;
    }
    if (row.walls) continue;
    off += row.measured;
    ++offs;
  }
  problem.ambient_told = offs > 0;
  if (problem.ambient_told) {
    problem.estimation.rules[kPlacedAmbient].free = true;
    problem.ambient_start = std::max(0.0, off / offs);
  } else if (model.fit_ambient && (model.walls.empty() || model.over_ground) &&
             problem.lit >= kReadingsForAmbient && std::isfinite(dimmest)) {
    problem.estimation.rules[kPlacedAmbient] = {true, 0.0, dimmest};
  }
  if (model.fit_offset && std::isfinite(shortest)) {
    problem.estimation.rules[kPlacedOffset] = {true, 0.0, kOffsetPriorRelative * shortest};
  }
}

std::vector<PlacedTheta> StartsOf(const PlacedProblem& problem) {
  std::vector<PlacedTheta> starts;
  if (problem.near) {
    if (auto start = PlacedStartAt(problem.estimation, *problem.near, problem.ambient_start)) {
      starts.push_back(*start);
    }
    return starts;
  }
  if (auto linear = LinearPlacedStart(problem.estimation, problem.ambient_start)) {
    starts.push_back(*linear);
  }
  for (const PlacedTheta& start : ScanPlacedStarts(problem.estimation, problem.ambient_start)) {
    starts.push_back(start);
  }
  return starts;
}

}  // namespace

void SetWalls(const WallPrior& prior, PlacedEstimation& estimation) {
  estimation.rules[kPlacedLnWalls] = {true, prior.ln_b, prior.sd_ln_b};
  estimation.rules[kPlacedWallsSlope] = {true, prior.slope, prior.sd_slope};
  for (PlacedRow& row : estimation.rows) {
    if (!row.walls) continue;
    const double own = row.normal ? std::hypot(prior.scatter, kTurnedScatter) : prior.scatter;
    row.walls->scatter = own * std::sqrt(static_cast<double>(row.walls->rows));
    row.walls->bend = prior.bend;
  }
}

bool AtOnePlace(const PlacedTheta& a, const PlacedTheta& b) {
  return Length(LampOf(a) - LampOf(b)) < 0.05 * Length(LampOf(a));
}

PlacedProblem PlacedProblemOf(const Observations& observations, const LightDescription& light,
                              const ForwardModel& model, const Vec3* near_m) {
  PlacedProblem out;
  out.frame = FrameOf(observations);
  if (light.kind == LightKind::kDisk || light.kind == LightKind::kRect) {
    out.estimation.aim = light.aim;
  }
  const std::optional<PlacedFace> face = FaceOf(light, model, out.frame.length_m);
  for (std::size_t i = 0; i < observations.rows.size(); ++i) {
    if (!observations.rows[i].lit && !model.fit_ambient) continue;
    out.estimation.rows.push_back(RowOf(observations, i, model, out.frame));
    if (observations.rows[i].lit) out.estimation.rows.back().face = face;
    out.observation.push_back(static_cast<int>(i));
    if (observations.rows[i].lit) ++out.lit;
  }
  if (const auto walls = OneNormalOf(model.walls)) AddWalls(observations, *walls, out);
  if (near_m != nullptr) out.near = (*near_m - out.frame.origin) * (1.0 / out.frame.length_m);
  if (model.gradient_sd) AddGradient(*model.gradient_sd, out);
  SetRules(model, out);
  if (model.sheet) {
    const double ln_unit = std::log(out.frame.lux * out.frame.length_m * out.frame.length_m);
    out.estimation.rules[kPlacedLnIntensity] = {true, model.sheet->ln_cd - ln_unit,
                                                model.sheet->sd};
  }
  return out;
}

void AddGradient(const Vec3& sd, PlacedProblem& problem) {
  Vec3 middle{};
  int count = 0;
  const auto seen = [](const PlacedRow& row) { return row.direct_gain > 0.0 && row.position; };
  for (const PlacedRow& row : problem.estimation.rows) {
    if (!seen(row) || !problem.near) continue;
    const Vec3 way = *row.position - *problem.near;
    middle = middle + way * (1.0 / Length(way));
    ++count;
  }
  if (count > 0) middle = middle * (1.0 / count);
  for (PlacedRow& row : problem.estimation.rows) {
    if (seen(row)) row.middle = middle;
  }
  for (int k = 0; k < 3; ++k) {
    problem.estimation.rules[kPlacedGradientX + k] = {true, 0.0, sd[k]};
  }
}

std::vector<PlacedSolution> SolveFrom(const PlacedEstimation& estimation,
                                      const std::vector<PlacedTheta>& starts) {
  std::vector<PlacedSolution> out;
  for (const PlacedTheta& start : starts) {
    const auto theta = SolvePlaced(estimation, start);
    if (!theta) continue;
    const double chi_squared = PlacedChiSquared(estimation, *theta);
    if (std::isfinite(chi_squared)) out.push_back({*theta, chi_squared});
  }
  std::ranges::sort(out, [](const PlacedSolution& a, const PlacedSolution& b) {
    return a.chi_squared < b.chi_squared;
  });
  return out;
}

std::vector<PlacedSolution> SearchPlace(const PlacedProblem& problem) {
  PlacedEstimation held = problem.estimation;
  held.rules[kPlacedAmbient].free = false;
  const std::vector<PlacedSolution> first = SolveFrom(held, StartsOf(problem));
  if (!problem.estimation.rules[kPlacedAmbient].free || first.empty()) return first;
  const double hopeless = 10.0 * first.front().chi_squared + 100.0;
  std::vector<PlacedTheta> places;
  for (const PlacedSolution& s : first) {
    if (s.chi_squared > hopeless) break;
    const bool known = std::ranges::any_of(
        places, [&](const PlacedTheta& other) { return AtOnePlace(s.theta, other); });
    if (!known) places.push_back(s.theta);
  }
  return SolveFrom(problem.estimation, places);
}

std::vector<PlacedSolution> OpenPlaces(const PlacedProblem& problem, double least) {
  // People read within about as far of a lamp's foot as it hangs high, in extents of the layout.
  constexpr std::array<double, 5> kUsual = {0.7, 1.0, 1.5, 2.0, 3.0};
  constexpr double kAbout = 0.3;  // of that distance: the readings say which way to go
  std::vector<PlacedSolution> out;
  for (const double extents : kUsual) {
    const auto start = BestStartAt(problem.estimation, extents, problem.ambient_start);
    if (!start) continue;
    PlacedEstimation about = problem.estimation;
    for (int k = kPlacedX; k <= kPlacedZ; ++k) {
      about.rules[k] = {true, (*start)[k], kAbout * extents};
    }
    const auto theta = SolvePlaced(about, *start);
    if (!theta) continue;
    const double chi_squared = PlacedChiSquared(problem.estimation, *theta);
    if (chi_squared <= least + ChiSquared95(1)) out.push_back({*theta, chi_squared});
  }
  return out;
}

}  // namespace lightcal::fit
