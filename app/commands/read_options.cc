// SPDX-License-Identifier: Apache-2.0
#include "read_options.h"

#include <cstdint>
#include <utility>

#include "calibration_options.h"
#include "lightcal/core/units_text.h"
#include "typed_reading.h"

namespace lightcal::app {
namespace {

Result<Reading> FrameOf(const ReadArguments& arguments) {
  Reading reading;
  reading.light = arguments.light;
  reading.meter = arguments.meter;
  reading.shadow_card = arguments.shadow_card;
  reading.lamp = arguments.lamp_off ? LampState::kOff : LampState::kOn;
  if (!arguments.distance.empty()) {
    const auto distance = ParseLength(arguments.distance);
    if (!distance) return tl::unexpected(distance.error());
    reading.distance = *distance;
  }
  if (!arguments.duv.empty()) {
    const auto duv = ParseDuv(arguments.duv);
    if (!duv) return tl::unexpected(duv.error());
    reading.duv = *duv;
  }
  if (!arguments.tilt.empty()) {
    const auto tilt = ParseAngle(arguments.tilt);
    if (!tilt) return tl::unexpected(tilt.error());
    reading.tilt = *tilt;
  }
  if (!arguments.off_axis.empty()) {
    const auto off_axis = ParseAngle(arguments.off_axis);
    if (!off_axis) return tl::unexpected(off_axis.error());
    reading.off_axis = *off_axis;
  }
  if (!arguments.state.empty()) {
    auto state = ParseFixtureState(arguments.state);
    if (!state) return Propagate(std::move(state));
    reading.state = *std::move(state);
  }
  return reading;
}

// Nothing says which one reading is meant.
bool NamesNoReading(const ReadArguments& a) {
  return a.distance.empty() && a.lux.empty() && !a.shadow_card && !a.lamp_off && !a.once &&
         a.from_memory < 0 && a.repeat == 1;
}

Result<void> CheckComplete(const ReadArguments& arguments) {
  if (!arguments.once && arguments.session.empty()) {
    return WrongUsage("-s", "name the session the reading goes into, or pass --once");
  }
  return {};
}

Result<std::chrono::milliseconds> ParseMilliseconds(const std::string& option,
                                                    const std::string& text, double least_s,
                                                    double most_s) {
  const auto duration = ParseDuration(text);
  if (!duration) return tl::unexpected(duration.error());
  if (duration->value() < least_s || duration->value() > most_s) {
    return WrongUsage(option + " " + text,
                      "give between " + std::to_string(std::int64_t(least_s * 1e3)) + "ms and " +
                          std::to_string(std::int64_t(most_s)) + "s");
  }
  return std::chrono::milliseconds(static_cast<std::int64_t>(duration->value() * 1e3));
}

Result<MeasuringPlan> PlanOf(const ReadArguments& arguments) {
  MeasuringPlan plan;
  plan.measurements = arguments.once ? 1 : arguments.measurements;
  if (arguments.from_memory >= 0) plan.from_memory = arguments.from_memory;
  if (arguments.settles) {
    const auto tolerance = ParseTolerance(arguments.settle);
    if (!tolerance) return tl::unexpected(tolerance.error());
    plan.settle_relative = *tolerance;
  }
  return plan;
}

}  // namespace

std::shared_ptr<ReadArguments> AddReadOptions(CLI::App& parser) {
  auto arguments = std::make_shared<ReadArguments>();
  ReadArguments& a = *arguments;
  parser.add_option("-s,--session", a.session, "Session the readings are appended to");
  parser.add_option("--light", a.light, "Name of the lamp, as in session.toml [the only one]");
  parser.add_option("--distance", a.distance, "From the lamp to the meter: 0.5m, 50cm, 2ft");
  parser.add_option("--tilt", a.tilt, "Between the meter's normal and the lamp, degrees");
  parser.add_option("--off-axis", a.off_axis,
                    "Between the lamp's axis and the meter, seen from the lamp, degrees: tells "
                    "its beam");
  parser.add_option("--state", a.state,
                    "What the fixture's controls say: dimmer=50,cct_K=4000 (any names)");
  parser.add_option("--meter", a.meter, "The session's [[meter]] that took the reading");
  auto* count = parser.add_option("-n", a.measurements, "Measurements to take the median of");
  count->check(CLI::Range(1, 1000))->default_str(std::to_string(kDefaultMeasurements));
  auto* settle = parser.add_option_function<std::string>(
      "--settle",
      [&a](const std::string& tolerance) {
        a.settles = true;
        if (!tolerance.empty()) a.settle = tolerance;
      },
      "First wait until the light is steady, within 0.5% or this");
  settle->expected(0, 1);
  auto* repeat = parser.add_option("--repeat", a.repeat, "So many readings, one after another");
  repeat->check(CLI::Range(1, 10000000));
  parser.add_option("--every", a.every, "Pause between repeated readings: 10s");
  parser.add_option("--set", a.settings, "An option of the driver: name=value")
      ->allow_extra_args(false);
  auto* memory = parser.add_option("--from-memory", a.from_memory,
                                   "A reading the meter keeps, numbered from 0 (experimental)");
  memory->check(CLI::Range(0, 9999))->excludes(count)->excludes(settle)->excludes(repeat);
  auto* shadow =
      parser.add_flag("--shadow-card", a.shadow_card, "A card blocks the direct beam only");
  parser.add_flag("--lamp-off", a.lamp_off, "The lamp is switched off")->excludes(shadow);
  auto* lux =
      parser.add_option("--lux", a.lux, "A typed reading: 192, 17.8fc, or with its CCT 192,2900K");
  parser.add_option("--duv", a.duv, "Typed with a CCT: Duv, above zero greener")->needs(lux);
  auto* device = parser.add_option("--device", a.request.device, "A meter's id or driver's name");
  auto* record =
      parser.add_option("--record", a.request.record_file, "Write the dialogue as a tape");
  auto* replay =
      parser.add_option("--replay", a.request.replay_file, "Play a tape instead of a meter");
  lux->excludes(device)->excludes(record)->excludes(replay)->excludes(count);
  lux->excludes(settle)->excludes(repeat)->excludes(memory);
  replay->excludes(device);
  parser.add_flag("--undo", a.undo,
                  "Take back the journal's last reading (of --light), typed or read wrong")
      ->needs(parser.get_option("--session"));
  parser.add_flag("--guided", a.guided,
                  "Be told where to put the meter [in a terminal, without --distance]");
  parser.add_option("--until", a.until, "Guided: the interval (95 %) to reach")
      ->capture_default_str();
  parser.add_flag("--no-shadow-card", a.no_shadow_card, "Guided: ask for no shadow-card readings")
      ->excludes(shadow);
  parser.add_flag("--typed", a.typed, "You type what the meter shows, whatever is plugged in")
      ->excludes(device)
      ->excludes(replay)
      ->excludes(record)
      ->excludes(count);
  parser.add_flag("--once", a.once, "One measurement; -s, --light and --distance optional")
      ->excludes(count);
  parser.add_flag("--with-spectrum", a.with_spectrum, "With --json: the spectrum too");
  parser.add_option("--timeout", a.timeout, "Longest wait for one answer of the meter")
      ->capture_default_str();
  return arguments;
}

Result<std::map<std::string, std::string>> DriverSettings(
    const std::vector<std::string>& settings) {
  std::map<std::string, std::string> out;
  for (const std::string& setting : settings) {
    const auto equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) {
      return WrongUsage("--set " + setting, "write name=value");
    }
    out[setting.substr(0, equals)] = setting.substr(equals + 1);
  }
  return out;
}

Result<ReadOptions> ReadOptionsFrom(const ReadArguments& arguments, bool can_ask) {
  const bool guided =
      !arguments.session.empty() && NamesNoReading(arguments) && (arguments.guided || can_ask);
  if (arguments.guided && !guided) {
    return WrongUsage("--guided",
                      "needs a session (-s) and chooses the readings by itself: leave "
                      "out --distance, --lux, --once and the like");
  }
  if (!guided) {
    if (auto complete = CheckComplete(arguments); !complete) return Propagate(std::move(complete));
  }
  auto frame = FrameOf(arguments);
  if (!frame) return Propagate(std::move(frame));
  auto plan = PlanOf(arguments);
  if (!plan) return Propagate(std::move(plan));
  const auto timeout = ParseMilliseconds("--timeout", arguments.timeout, 1e-3, 3600.0);
  if (!timeout) return tl::unexpected(timeout.error());
  const auto until = ParseTolerance(arguments.until);
  if (!until) return tl::unexpected(until.error());
  const auto every = ParseMilliseconds("--every", arguments.every, 0.0, 86400.0);
  if (!every) return tl::unexpected(every.error());
  ReadOptions options{arguments.session,
                      arguments.lux,
                      *std::move(frame),
                      arguments.request,
                      *plan,
                      arguments.repeat,
                      *every,
                      arguments.with_spectrum,
                      arguments.typed,
                      guided,
                      *until,
                      !arguments.no_shadow_card};
  options.request.reply_timeout = *timeout;
  auto settings = DriverSettings(arguments.settings);
  if (!settings) return Propagate(std::move(settings));
  options.request.settings = *std::move(settings);
  return options;
}

}  // namespace lightcal::app
