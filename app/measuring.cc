// SPDX-License-Identifier: Apache-2.0
#include "measuring.h"

#include <string>
#include <utility>
#include <vector>

#include "lightcal/core/numbers_text.h"

namespace lightcal::app {
namespace {

Result<void> WaitUntilSettled(double tolerance_relative, MeterSession& meter, Console& console) {
  console.Note("Waiting until the light changes by less than " + PercentText(tolerance_relative) +
               " in half a minute (Ctrl-C stops).");
  std::vector<double> values;
  for (int i = 0; i < kSettleMeasurements && meter.HasMore(); ++i) {
    if (i > 0) meter.Pause(kSettlePause);
    const auto one = meter.Measure();
    if (!one) return tl::unexpected(one.error());
    console.Note("  settling: " + LuxText(one->reading));
    values.push_back(one->reading.illuminance->value());
    if (devices::HasSettled(values, tolerance_relative)) return {};
  }
  console.Warn({"not_settled", "",
                "the light still changes after " + std::to_string(values.size()) +
                    " measurements; it may be dimmed, or daylight comes in"});
  return {};
}

}  // namespace

std::string LuxText(const Reading& reading) {
  const std::string beyond = reading.over_range ? "> " : reading.under_range ? "< " : "";
  return beyond + RoundedText(reading.illuminance->value(), 5) + " lx";
}

Result<devices::Summary> TakeSummary(const MeasuringPlan& plan, MeterSession& meter,
                                     Console& console) {
  if (plan.settle_relative) {
    if (auto settled = WaitUntilSettled(*plan.settle_relative, meter, console); !settled) {
      return tl::unexpected(settled.error());
    }
  }
  const int asked = plan.from_memory ? 1 : plan.measurements;
  const bool until_tape_ends = meter.IsReplay() && asked == 0;
  const int wanted = asked > 0 ? asked : kDefaultMeasurements;
  std::vector<devices::MeterReading> measured;
  const auto more = [&] {
    if (until_tape_ends) return measured.empty() || meter.HasMore();
    return static_cast<int>(measured.size()) < wanted;
  };
  const auto measure = [&] {
    return plan.from_memory ? meter.ReadMemory(*plan.from_memory) : meter.Measure();
  };
  while (more()) {
    auto one = measure();
    if (!one) return Propagate(std::move(one));
    measured.push_back(*std::move(one));
    if (wanted == 1) continue;
    console.Note("  " + std::to_string(measured.size()) + ": " + LuxText(measured.back().reading));
  }
  auto summary = devices::Summarise(measured);
  if (!summary) return Failed("internal", "read", "a measurement came without illuminance");
  return *std::move(summary);
}

}  // namespace lightcal::app
