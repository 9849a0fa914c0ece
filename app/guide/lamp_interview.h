// SPDX-License-Identifier: Apache-2.0
// The questions of `lightcal new`: the lamp, the meter, the engines, the room.
#pragma once

#include <optional>
#include <string>

#include "guide/new_session.h"
#include "guide/questions.h"
#include "lightcal/core/result.h"

namespace lightcal::app {

// What flags answered, as typed.
struct LampFlags {
  std::optional<std::string> directory, lamp, kind, fixture, diameter, size, length, radius,
      distribution, box, meter, accuracy, targets, room, reflectance;
};

// Asks what no flag says.  Wrong usage: a flag that cannot be read, or a size the kind has not.
// Fails: as Questions::Answer, not_found (a photometric file).
[[nodiscard]] Result<NewSession> InterviewAboutLamp(const Questions& questions,
                                                    const LampFlags& flags);

}  // namespace lightcal::app
