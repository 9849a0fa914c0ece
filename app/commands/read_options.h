// SPDX-License-Identifier: Apache-2.0
// What `lightcal read` is asked, from its words to values.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/reading.h"
#include "measuring.h"
#include "meter_session.h"

namespace lightcal::app {

// As typed.
struct ReadArguments {
  std::string session, light, distance, tilt, off_axis, meter;
  std::string lux, duv, state;
  std::string timeout = "1s";
  std::string settle = "0.5%";
  std::string every = "0s";
  std::string until = "3%";
  std::vector<std::string> settings;  // name=value
  MeterRequest request;
  int measurements = 0;  // 0 = not said
  int repeat = 1;
  int from_memory = -1;  // -1 = not said
  bool settles = false;
  bool shadow_card = false;
  bool lamp_off = false;
  bool once = false;
  bool undo = false;  // takes back the journal's last reading
  bool with_spectrum = false;
  bool guided = false;
  bool typed = false;
  bool no_shadow_card = false;
};

struct ReadOptions {
  std::string session;  // "" = into no journal
  std::string lux;      // a typed reading, "" = from a meter
  Reading frame;        // what every reading of this run shares: light, place, state of the lamp
  MeterRequest request;
  MeasuringPlan plan;
  int repeat = 1;
  std::chrono::milliseconds every{0};
  bool with_spectrum = false;
  bool typed = false;  // numbers are typed, whatever is plugged in
  bool guided = false;
  double until_relative = 0.0;  // guided: half of the 95 % interval wanted
  bool shadow_cards = true;     // guided: ask for them
};

// Filled when the parser has run.
[[nodiscard]] std::shared_ptr<ReadArguments> AddReadOptions(CLI::App& parser);

// "name=value" each, of the driver.  Wrong usage: anything else.
[[nodiscard]] Result<std::map<std::string, std::string>> DriverSettings(
    const std::vector<std::string>& settings);

// Guided where it is asked for, or where nothing says what to read and `can_ask`.
// Wrong usage: a value that is none, no session and not --once, no light or distance for a session.
[[nodiscard]] Result<ReadOptions> ReadOptionsFrom(const ReadArguments& arguments, bool can_ask);

}  // namespace lightcal::app
