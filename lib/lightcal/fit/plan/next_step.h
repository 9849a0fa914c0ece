// SPDX-License-Identifier: Apache-2.0
// What to do next about one light: the one step that quick, run, plan and guided reading name.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/progress.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/reading_plan.h"
#include "lightcal/records/session.h"

namespace lightcal {

struct NextStepAdvice {
  enum class Kind : std::uint8_t {
    kReading,  // `reading`, tried in thought
    kSay,      // what only words tell: a reading that contradicts the others, a data sheet
    kMeter,    // the meter's own calibration is most of what is left
    kNothing,  // no reading within reach takes 2 % off what is left
  };
  Kind kind = Kind::kSay;
  std::string say;                        // a sentence, what it leaves within
  std::optional<PlannedReading> reading;  // kReading, or the one that kSay asks for
  double minutes = 0.0;                   // that it takes, the meter standing where it read last
};

// The first step of PlanMinutes within the room: half of its longest side away, or 4 m where no
// walls are, 2 m in a room nobody described, or as far as readings already stand. Before it comes
// what no plan holds: a light that only its data sheet speaks of, a reading thrown out. `skip`:
// steps that the person cannot or will not do.
[[nodiscard]] NextStepAdvice AdviseNext(const Session& session, const FittedLight& light,
                                        const std::vector<PlannedReading>& skip = {},
                                        const Progress& progress = {});

// How far from a lamp a meter can stand, in metres.
[[nodiscard]] double ReachIn(const Session& session);

}  // namespace lightcal
