// SPDX-License-Identifier: Apache-2.0
// Which next reading lowers a lamp's uncertainty most, and what the uncertainty will then be.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/progress.h"
#include "lightcal/core/result.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/records/reading_plan.h"
#include "lightcal/records/session.h"

namespace lightcal {

struct ReadingPlan {
  std::optional<double> u95_relative;      // now; absent before any reading
  double u95_stops = 0.0;                  // the same in stops, as of a PlannedReading
  std::optional<double> beam_u95_deg;      // now, where readings off the axis tell a beam
  std::vector<PlannedReading> steps;       // in order, each on top of the former
  std::vector<PlannedReading> candidates;  // for the first step, best first
  std::optional<double> span;              // farthest over nearest distance so far
};

// c-optimal: of the readings a person could take next the one after which the interval of the
// intensity is shortest, found by taking each in thought (at the illuminance the present estimate
// predicts, by the meter used last; where lamp and room may be several things at three equally
// probable ones, whose median width counts) and fitting again; then the next on top of it.
// Candidates are distances in geometric steps from 0.25 m to `reach_m` (4 m; no farther than a
// stated room goes, as far as was read) within a factor sqrt(8) of those taken, places round those
// taken, across a spot's beam and on the axis of a lamp whose place and aim are known, angles off
// the axis of a lamp that was read off its axis (there what counts is the product of both
// intervals, the intensity's and the beam angle's), a shadow card where a reading stands, the lamp
// off. Before any reading the plan is that of a lamp of its data sheet, or of any: relative
// uncertainty does not depend on its strength. Refused: as FitSession (what the refusal asks for
// comes first), unknown_light.
[[nodiscard]] Result<ReadingPlan> PlanReadings(const Session& session, const std::string& light,
                                               const FitSettings& settings, int steps,
                                               std::optional<double> reach_m = std::nullopt,
                                               const Progress& progress = {});

// Whether they ask for the same: what to do, and where.
[[nodiscard]] bool SameStep(const PlannedReading& a, const PlannedReading& b);

// Half of the 95 % interval, relative, that the calibrations of a session's meters leave however
// often they read its one light; 0 where nobody says.
[[nodiscard]] double MeterU95Relative(const Session& session);

struct LadderWishes {
  MeasuringMinutes minutes{};
  double reach_m = 4.0;  // how far from the lamp a meter can stand; more where it already has
  int steps = 6;         // at most
  std::vector<PlannedReading> skip{};  // what the person cannot or will not do
  Progress progress{};
};

// The ladder of those readings that shorten the interval most for their minutes: greatest decrease
// of ln of the stops left a minute, each predicted as PlanReadings does. It ends where no reading
// would take 2 % off what is left. Before any reading the first step is the one that leaves least.
// Refused: as PlanReadings.
[[nodiscard]] Result<MinutesLadder> PlanMinutes(const Session& session, const std::string& light,
                                                const FitSettings& settings,
                                                const LadderWishes& wishes);

// Of a lamp whose beam readings told: an angle off the axis, one step as PlanReadings ranks them,
// and the ladder. What both try is tried once.
struct BeamPlan {
  ReadingPlan angle;
  MinutesLadder ladder;
};
[[nodiscard]] Result<BeamPlan> PlanBeam(const Session& session, const std::string& light,
                                        const FitSettings& settings, const LadderWishes& wishes);

// "read at 1.41 m, facing the lamp", "hold a shadow card at 0.5 m ...".
[[nodiscard]] std::string SayPlannedReading(const PlannedReading& reading);

// Half the width of the 95 % interval of intensity or illuminance, over its value.
[[nodiscard]] std::optional<double> RelativeUncertainty(const FittedLight& light);

}  // namespace lightcal
