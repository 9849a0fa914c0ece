// SPDX-License-Identifier: Apache-2.0
// lightcal sweep: a fixture's states, one after another, into the journal.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>

#include "commands.h"
#include "sweep_run.h"

namespace lightcal::app {

Run BuildSweep(CLI::App& parser) {
  auto options = std::make_shared<SweepOptions>();
  SweepOptions& o = *options;
  parser.add_option("-s,--session", o.session, "Session the readings are appended to")->required();
  parser.add_option("--light", o.light, "Name of the lamp [the only one]");
  parser
      .add_option("--over", o.over,
                  "A control and its values: dimmer=100,50,25,12; repeated, every combination")
      ->allow_extra_args(false)
      ->required();
  parser.add_option("--distance", o.distance, "From the lamp to the meter, which stays there: 1m");
  parser.add_option("--meter", o.meter, "The session's [[meter]] that takes the readings");
  parser.add_option("--until", o.until,
                    "Read only until every state is known within this: 3% [all of them]");
  auto* in_order = parser.add_flag("--in-order", o.in_order, "As written, not shuffled");
  parser.add_option("--seed", o.seed, "Of the order, which a sweep that goes on must keep [1]")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 53))
      ->excludes(in_order);
  auto* sacn = parser.add_option(
      "--sacn", o.sacn, "Set the states by sACN: UNIVERSE@HOST, or UNIVERSE to multicast it");
  auto* map = parser.add_option("--map", o.map, "Which slots move which control: map.toml");
  sacn->needs(map);
  map->needs(sacn);
  parser.add_option("--settle", o.settle, "Of what --sacn sets: wait at most this long [15s]")
      ->needs(sacn);
  parser.add_option("-n", o.measurements, "Measurements to take the median of")
      ->check(CLI::Range(1, 1000));
  auto* device = parser.add_option("--device", o.request.device, "A meter's id or driver's name");
  auto* replay =
      parser.add_option("--replay", o.request.replay_file, "Play a tape instead of a meter");
  replay->excludes(device);
  parser.add_option("--set", o.settings, "Of the meter's driver: name=value; repeatable")
      ->allow_extra_args(false);
  parser.add_option("--record", o.request.record_file, "Write what the meter said to a tape")
      ->excludes(replay);
  parser.add_flag("--typed", o.typed, "You type what the meter shows, whatever is plugged in")
      ->excludes(device)
      ->excludes(replay);
  return [options](Console& console) { return RunSweep(*options, console); };
}

}  // namespace lightcal::app
