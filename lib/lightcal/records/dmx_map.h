// SPDX-License-Identifier: Apache-2.0
// map.toml: which slots of a DMX universe move which control of a fixture, and how.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/fixture_state.h"

namespace lightcal {

inline constexpr int kDmxSlots = 512;          // of a universe: ANSI E1.11 (DMX512-A)
inline constexpr int kMostUniverse = 63999;    // ANSI E1.31-2018, 6.2.7
inline constexpr int kMostSacnPriority = 200;  // the same, 6.2.3

// One control: its slots, most significant first, and the number they hold at each label.
struct DmxControl {
  std::string name;
  std::vector<int> slots;                          // 1 ... 512 of the universe; one or two
  std::vector<double> labels, values;              // straight between; labels strictly one way
  std::vector<std::pair<std::string, int>> words;  // instead of labels, for modes and wheels
};

// A slot that stays where it is: an open shutter, a mode.
struct DmxHold {
  int slot = 1;
  int value = 0;
};

struct DmxMap {
  std::optional<int> universe;
  int priority = 100;
  std::vector<DmxControl> controls;
  std::vector<DmxHold> holds;
};

// The file:
//   lightcal = 1
//   universe = 1                    # may be left out
//   address = 101                   # the fixture's start address [1]; slots count from it
//   priority = 100                  # 0 ... 200 [100]
//   [[control]]
//   name = "dimmer"
//   slots = [1, 2]                  # 16 bits, coarse first; one slot is 8 bits
//   range = [0, 100]                # the labels at 0 and at the slots' largest
//   [[control]]
//   name = "cct_K"
//   slots = [3]
//   labels = [2700, 4000, 6500]     # or a curve: these labels stand at these values
//   values = [0, 110, 255]
//   [[control]]
//   name = "mode"
//   slots = [4]
//   words = { white = 0, rgb = 128 }
//   [[hold]]
//   slot = 5
//   value = 255
// Refused: bad_map, unknown_key, with file and place: a slot used twice or beyond 512, values that
// the slots cannot hold, labels that turn back.
[[nodiscard]] Result<DmxMap> DmxMapFromToml(std::string_view text, std::string_view where);

// The 512 slots at a state. Refused: map_controls (a control that the map does not have, or one of
// the map that the state does not say), map_range (a label outside of what the map covers),
// map_word.
[[nodiscard]] Result<std::vector<std::uint8_t>> SlotsAt(const DmxMap& map,
                                                        const FixtureState& state);

}  // namespace lightcal
