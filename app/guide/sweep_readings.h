// SPDX-License-Identifier: Apache-2.0
// What a sweep has read, and what it makes of one more number: a slip, or a lamp that warms up.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/session.h"

namespace lightcal::app {

class SweepReadings {
 public:
  // full: what a sweep comes back to. What the session holds of the frame's light at its distance
  // counts from the start.
  SweepReadings(FixtureState full, const Session& session, const Reading& frame);

  // Why this light is hardly that state's, "" where it may be: of states of the dimmer alone one of
  // a lower is 5 % brighter, or it is a factor of 4 beside what the two around it span by equal
  // ratios and by powers; of the same state, half as bright again or less than two thirds.
  [[nodiscard]] std::string DoubtAbout(const FixtureState& state, double lux) const;

  // drift or return_disagrees (what to do: `undo`) of a reading back at full.
  [[nodiscard]] std::optional<Warning> AtFull(const Reading& reading,
                                              const std::string& undo) const;

  // What was doubted and kept all the same says nothing of other states.
  void Add(const Reading& reading, bool doubted) { readings_.push_back({reading, doubted}); }
  // Forgets the last one added.
  void TakeBack() { readings_.pop_back(); }

 private:
  FixtureState full_;
  struct Held {
    Reading reading;
    bool doubted = false;
  };
  std::vector<Held> readings_;  // with light, of this lamp at this place
  std::size_t held_ = 0;        // of them, those the session held before
};

}  // namespace lightcal::app
