// SPDX-License-Identifier: Apache-2.0
// Whatever words a camera's menu holds, times are real ones and a plan uses each choice once.
#include <cmath>
#include <sstream>

#include "lightcal_devices/captures/bracket_plan.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  const std::string bytes(lightcal::fuzz::TextOf(data, size));
  std::vector<std::string> choices;
  std::istringstream lines(bytes);
  for (std::string line; std::getline(lines, line);) choices.push_back(line);
  for (const std::string& choice : choices) {
    const auto time = lightcal::devices::TimeOfChoice(choice);
    if (time) Require(time->time.value() > 0.0 && std::isfinite(time->time.value()));
    (void)lightcal::devices::FNumberOfChoice(choice);
    (void)lightcal::devices::IsoOfChoice(choice);
    (void)lightcal::devices::ParseBracket(choice);
  }
  (void)lightcal::devices::RawFormat(choices);
  const auto plan = lightcal::devices::PlanBracket(choices, lightcal::Seconds(1.0 / 64),
                                                   {4.0, 1.0, {{100.0, 0.5}}});
  if (!plan) {
    lightcal::fuzz::RequireGoodError(plan.error());
    return 0;
  }
  Require(plan->frames.size() >= 2 && plan->frames.size() <= 9);
  for (std::size_t i = 1; i < plan->frames.size(); ++i) {
    Require(plan->frames[i - 1].ev <= plan->frames[i].ev);
  }
  return 0;
}
