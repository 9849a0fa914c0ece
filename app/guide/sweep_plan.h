// SPDX-License-Identifier: Apache-2.0
// Which states of a fixture a sweep reads, in which order, and which of them it holds already.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/session.h"

namespace lightcal::app {

// So many others are read before full again.
inline constexpr std::size_t kBackToFull = 8;

// Every state of "dimmer=100,50,25" and "cct_K=3200,5600" together, 6 of these two.
// Wrong usage: no value, a control twice, a value that no control can have, over 10000 states.
[[nodiscard]] Result<std::vector<FixtureState>> StatesOver(const std::vector<std::string>& over);

// The state of the highest dimmer, of these the first: what a sweep begins with, comes back to
// after every eight others and ends with, so that a lamp which warms up or tires is seen.
[[nodiscard]] FixtureState FullOf(const std::vector<FixtureState>& states);

// Full, then the others (shuffled by the seed and by what they are, so that warming up is no slope
// along a control; without a seed in order), and full again as above.
[[nodiscard]] std::vector<FixtureState> SweepOrder(const std::vector<FixtureState>& states,
                                                   std::optional<std::uint64_t> seed);

// What is left of `order` when each lit reading that the session holds of this light, at this
// distance where one is given, has done one of it.
[[nodiscard]] std::vector<FixtureState> NotYetRead(const std::vector<FixtureState>& order,
                                                   const Session& session, const Reading& frame);

// The ends of every control, the others where full has them: what must be read before anything lies
// between.
[[nodiscard]] std::vector<FixtureState> EndsOf(const std::vector<FixtureState>& states);

}  // namespace lightcal::app
