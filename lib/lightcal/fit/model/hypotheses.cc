// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/hypotheses.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lightcal/fit/model/evidence.h"
#include "lightcal/fit/model/row_values.h"
#include "lightcal/fit/model/shared_scatter.h"
#include "lightcal/fit/model/starts.h"

namespace lightcal::fit {
namespace {

// The meter stands before a lamp's virtual source, however far that lies in front of its reference.
constexpr double kNearestSource = -0.7;  // of the shortest distance
constexpr double kTurned_rad = 0.2;      // from where on a meter sees other walls

WallsOfRow WallsAt(const WallPrior& prior, double distance_m, double length_m) {
  const double x = std::log(distance_m / kWallReference_m);
  return {x, prior.bend * x * x + 2.0 * std::log(length_m), prior.scatter};
}

}  // namespace

std::vector<LampHypothesis> HypothesesOf(const ForwardModel& model) {
  std::vector<LampHypothesis> offsets;
  for (const OffsetPart& part : model.offsets) offsets.push_back({part.weight, part, 0.0, 0.0, {}});
  if (offsets.empty() || !model.fit_offset) offsets = {{}};
  // Of several offsets, the one that goes with the make.
  const bool any_make = offsets.size() > 1;
  std::vector<LampHypothesis> out;
  const auto add = [&](const auto& lamp, const std::optional<WallPrior>& walls) {
    if (any_make && lamp.offset) {
      out.push_back({lamp.weight, lamp.offset, lamp.width_m, lamp.height_m, walls});
      return;
    }
    for (const LampHypothesis& one : offsets) {
      out.push_back({one.weight * lamp.weight, one.offset, lamp.width_m, lamp.height_m, walls});
    }
  };
  for (const WallHypothesis& one : model.walls) add(one, one.prior);
  if (!out.empty()) return out;
  for (const LampMake& make : model.makes) add(make, std::nullopt);
  return out.empty() ? offsets : out;
}

Estimation EstimationUnder(const LampHypothesis& hypothesis, const Prepared& prepared,
                           const Observations& observations) {
  Estimation out = prepared.estimation;
  ParameterRule& offset = out.rules[kDistanceOffset];
  if (hypothesis.offset && offset.prior_sd > 0.0) {
    const double unit = prepared.scales.length_m;
    offset.prior_mean =
        std::max(hypothesis.offset->mean_m / unit, kNearestSource * prepared.shortest);
    offset.prior_sd = hypothesis.offset->sd_m / unit;
  }
  if (!hypothesis.walls && !(hypothesis.width_m > 0.0)) return out;
  std::vector<ReadingOfWalls> seeing;
  for (std::size_t i = 0; i < out.rows.size(); ++i) {
    ReadingRow& row = out.rows[i];
    const Observation& observation =
        observations.rows[static_cast<std::size_t>(prepared.observation[i])];
    const bool lit_row = row.direct_gain > 0.0;
    // A picture of the lamp itself shows its size, and is summed over it.
    if (lit_row && hypothesis.width_m > 0.0 && !observation.of_luminance) {
      SourceSize size;
      size.width = Metres(hypothesis.width_m / prepared.scales.length_m);
      size.height = Metres(hypothesis.height_m / prepared.scales.length_m);
      row.shape = AxialShapeOf(LightKind::kRect, size);
    }
    if (!hypothesis.walls || !SeesWalls(observation, lit_row)) continue;
    const WallPrior& prior = *hypothesis.walls;
    row.walls = WallsAt(prior, observation.distance_m, prepared.scales.length_m);
    if (observation.tilt_rad > kTurned_rad && observation.normal) {
      row.walls->scatter = std::hypot(prior.scatter, kTurnedScatter);
    } else if (observation.tilt_rad > kTurned_rad) {
      row.walls->constant += std::log1p(prior.turned * (1.0 - std::cos(observation.tilt_rad)));
      row.walls->scatter = std::hypot(prior.scatter, prior.sd_turned * observation.tilt_rad);
    }
    if (!observation.over_range) seeing.push_back({lit_row, &*row.walls, &observation});
  }
  if (seeing.empty()) return out;
  ShareScatter(std::move(seeing));
  out.rules[kLnWalls] = {true, hypothesis.walls->ln_b, hypothesis.walls->sd_ln_b};
  out.rules[kWallsSlope] = {true, hypothesis.walls->slope, hypothesis.walls->sd_slope};
  return out;
}

Result<Theta> SolveSettled(Estimation& estimation) {
  return SolveSettledFrom(StartOf(estimation), estimation);
}

Result<Theta> SolveSettledFrom(const Theta& start, Estimation& estimation) {
  constexpr int kRounds = 12;
  constexpr double kSettled = 0.001;
  SettleScatter(estimation, start);
  if (!estimation.rules[kLnWalls].free) return Solve(estimation, start);
  // The last digits only where no other round follows.
  Result<Theta> theta = start;
  for (int i = 0; i < kRounds && theta; ++i) {
    theta = SolveNearly(estimation, *theta);
    if (theta && SettleScatter(estimation, *theta) <= kSettled) break;
  }
  if (theta) theta = Solve(estimation, *theta);
  if (theta) SettleScatter(estimation, *theta);
  return theta;
}

double LnEvidence(const Estimation& estimation, const Theta& theta) {
  return LnEvidenceOf(estimation, theta);
}

}  // namespace lightcal::fit
