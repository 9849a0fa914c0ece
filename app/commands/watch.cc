// SPDX-License-Identifier: Apache-2.0
// lightcal watch: a meter's readings as they come. Writes nothing.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <thread>

#include "calibration_options.h"
#include "commands.h"
#include "guide/watch_series.h"
#include "guide/watch_view.h"
#include "interrupt.h"
#include "light_summary.h"
#include "light_table.h"
#include "lightcal/calibrate/reading_guide.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "read_options.h"
#include "reading_source.h"
#include "session_names.h"

namespace lightcal::app {
namespace {

using Clock = std::chrono::steady_clock;

// Sensors that answer at once are not asked more often.
constexpr std::chrono::milliseconds kShortestPeriod{20};
constexpr std::chrono::milliseconds kRedraw{200};

struct WatchOptions {
  MeterRequest request;
  std::vector<std::string> settings;
  std::string session, light, distance, lasting;
  long count = 0;  // 0 = without end
};

// The lamp that stands before the meter, where a session says.
struct Watched {
  std::optional<ReadingGuide> guide;
  Reading frame;
};

Result<Watched> WatchedLamp(const WatchOptions& options, Console& console) {
  Watched watched;
  if (options.session.empty()) {
    if (options.light.empty() && options.distance.empty()) return watched;
    return WrongUsage("-s", "--light and --distance belong to a session; name it");
  }
  if (options.distance.empty()) {
    return WrongUsage("--distance", "give the distance from the lamp, for example 0.5m");
  }
  const auto distance = ParseLength(options.distance);
  if (!distance) return tl::unexpected(distance.error());
  auto measured = MeasureAloud(options.session, {}, console);
  if (!measured) return Propagate(std::move(measured));
  auto light = LightMeant(measured->session, options.light);
  if (!light) return Propagate(std::move(light));
  watched.frame.light = *std::move(light);
  watched.frame.distance = *distance;
  watched.guide.emplace(measured->session, watched.frame.light, 1.0, false);
  return watched;
}

class Watching {
 public:
  Watching(const WatchOptions& options, Console& console) : options_(options), console_(console) {}

  Result<void> Run() {
    if (auto begun = Begin(); !begun) return begun;
    auto watched = Watch();
    const auto finished = source_.Finish(console_);
    if (!watched) return watched;
    if (!finished) return finished;
    if (auto strict = console_.RefuseIfStrict(); !strict) return strict;
    Conclude();
    return {};
  }

 private:
  Result<void> Begin() {
    auto settings = DriverSettings(options_.settings);
    if (!settings) return Propagate(std::move(settings));
    if (!options_.lasting.empty()) {
      const auto lasting = ParseDuration(options_.lasting);
      if (!lasting) return tl::unexpected(lasting.error());
      if (!(lasting->value() > 0.0)) return WrongUsage("--for", "must be above zero");
      lasting_s_ = lasting->value();
    }
    auto lamp = WatchedLamp(options_, console_);
    if (!lamp) return Propagate(std::move(lamp));
    lamp_ = *std::move(lamp);
    MeterRequest request = options_.request;
    request.settings = *std::move(settings);
    auto source = ReadingSource::Open({options_.session, false, request}, false, console_);
    if (!source) return Propagate(std::move(source));
    source_ = *std::move(source);
    live_ = !source_.meter()->IsReplay();
    drawn_over_ = !console_.json() && DrawnOver::Possible();
    return {};
  }

  // Until enough was seen, the tape ends, or Ctrl-C: all of them are an end, not a failure.
  Result<void> Watch() {
    const InterruptGuard guard;
    MeasuringPlan one;
    one.measurements = 1;
    const auto began = Clock::now();
    while (!Enough(began) && !InterruptGuard::StopRequest().Requested()) {
      const auto asked = Clock::now();
      const auto taken = source_.Take(lamp_.frame, one, console_);
      if (!taken) {
        if (InterruptGuard::StopRequest().Requested() && series_.count() > 0) break;
        return tl::unexpected(taken.error());
      }
      const std::chrono::duration<double> since = Clock::now() - began;
      series_.Add(taken->reading, live_ ? std::optional(since.count()) : std::nullopt);
      Show();
      if (live_) std::this_thread::sleep_until(asked + kShortestPeriod);
    }
    if (drawn_over_ && series_.count() > 0) Draw();
    return {};
  }

  [[nodiscard]] bool Enough(Clock::time_point began) const {
    if (options_.count > 0 && series_.count() >= options_.count) return true;
    if (series_.count() > 0 && !source_.HasMore()) return true;
    const std::chrono::duration<double> lasted = Clock::now() - began;
    return lasting_s_ && series_.count() > 0 && lasted.count() >= *lasting_s_;
  }

  // With the mean of what was seen as one more reading at this place.
  [[nodiscard]] std::optional<FittedLight> Lamp() const {
    if (!lamp_.guide) return std::nullopt;
    Reading mean = series_.readings().back();
    if (!mean.over_range && !mean.under_range) mean.illuminance = Lux(series_.Steady().mean_lx);
    auto fitted = lamp_.guide->FitWith(mean);
    return fitted ? std::optional(*std::move(fitted)) : std::nullopt;
  }

  void Draw() { block_.Draw(WatchBlock(series_, Lamp(), DrawnOver::Columns())); }

  void Show() {
    if (console_.json()) return;
    if (!drawn_over_) {
      console_.Print(std::to_string(series_.count()) + ": " +
                     ReadingText(series_.readings().back()) + "\n");
      std::fflush(stdout);
      return;
    }
    if (Clock::now() < redraw_) return;
    Draw();
    redraw_ = Clock::now() + kRedraw;
  }

  void Conclude() const {
    const Steadiness steady = series_.Steady();
    const auto light = Lamp();
    if (!drawn_over_) {
      auto lines = WatchBlock(series_, light, std::string::npos);
      lines.erase(lines.begin());  // the last reading has its line already
      for (const std::string& line : lines) console_.Print(line + "\n");
    }
    const Reading& last = series_.readings().back();
    const bool known = light && light->intensity_cd;
    console_.PrintDocument({{"readings", series_.count()},
                            {"illuminance_lx",
                             {{"mean", steady.mean_lx},
                              {"min", steady.least_lx},
                              {"max", steady.most_lx},
                              {"last", *last.illuminance}}},
                            {"scatter_relative", steady.scatter_relative},
                            {"modulation", steady.modulation},
                            {"drift_per_minute_relative", steady.drift_per_minute_relative},
                            {"rate_hz", steady.rate_hz},
                            {"cct_K", last.cct},
                            {"duv", last.duv},
                            {"light", known ? Node(light->name) : Node()},
                            {"intensity_cd", known ? ValueAndU95(*light->intensity_cd) : Node()}});
  }

  const WatchOptions& options_;
  Console& console_;
  std::optional<double> lasting_s_;
  Watched lamp_;
  ReadingSource source_;
  WatchSeries series_;
  DrawnOver block_;
  bool live_ = true;
  bool drawn_over_ = false;
  Clock::time_point redraw_{};
};

}  // namespace

Run BuildWatch(CLI::App& parser) {
  auto options = std::make_shared<WatchOptions>();
  auto* device =
      parser.add_option("--device", options->request.device, "A meter's id or driver's name");
  parser.add_option("--replay", options->request.replay_file, "Play a tape instead of a meter")
      ->excludes(device);
  parser.add_option("--record", options->request.record_file, "Write the dialogue as a tape");
  parser.add_option("--set", options->settings, "An option of the driver: name=value")
      ->allow_extra_args(false);
  parser.add_option("-s,--session", options->session, "Session of the lamp; nothing is written");
  parser.add_option("--light", options->light,
                    "The lamp's name [the only one], for its intensity so far");
  parser.add_option("--distance", options->distance, "From the lamp to the meter: 0.5m");
  parser.add_option("--count", options->count, "End after so many readings")
      ->check(CLI::Range(1L, 1000000000L));
  parser.add_option("--for", options->lasting, "End after this time: 10s");
  return [options](Console& console) { return Watching(*options, console).Run(); };
}

}  // namespace lightcal::app
