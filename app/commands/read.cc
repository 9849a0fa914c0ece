// SPDX-License-Identifier: Apache-2.0
// lightcal read: live readings, or typed ones, into a session's journal.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <thread>

#include "clock.h"
#include "commands.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/core/units_text.h"
#include "lightcal/records/journal.h"
#include "lightcal/records/session_codec.h"
#include "lightcal_devices/meters/summary.h"
#include "measuring.h"
#include "meter_calibrations.h"
#include "meter_session.h"
#include "session_input.h"
#include "session_names.h"
#include "terminal.h"

namespace lightcal::app {
namespace {

struct Options {
  std::string session, light, distance, tilt, meter;
  std::string lux;
  std::string timeout = "1s";
  std::string settle;  // "" = do not wait
  std::string every = "0s";
  std::vector<std::string> settings;  // name=value
  MeterRequest request;
  int measurements = 0;  // 0 = not said
  int repeat = 1;
  bool shadow_card = false;
  bool lamp_off = false;
  bool once = false;
  bool with_spectrum = false;
};

// What every reading of this run shares: light, place, and the state of the lamp.
Result<Reading> ReadingTemplate(const Options& options) {
  Reading reading;
  reading.light = options.light;
  reading.meter = options.meter;
  reading.shadow_card = options.shadow_card;
  reading.lamp = options.lamp_off ? LampState::kOff : LampState::kOn;
  if (!options.distance.empty()) {
    const auto distance = ParseLength(options.distance);
    if (!distance) return tl::unexpected(distance.error());
    reading.distance = *distance;
  }
  if (!options.tilt.empty()) {
    const auto tilt = ParseAngle(options.tilt);
    if (!tilt) return tl::unexpected(tilt.error());
    reading.tilt = *tilt;
  }
  return reading;
}

Result<void> CheckOptions(const Options& options) {
  const bool into_journal = !options.session.empty();
  if (!options.once && !into_journal) {
    return WrongUsage("-s", "name the session the reading goes into, or pass --once");
  }
  if (into_journal && options.light.empty()) {
    return WrongUsage("--light", "name the lamp the reading is of");
  }
  if (into_journal && options.distance.empty()) {
    return WrongUsage("--distance", "give the distance from the lamp, for example 0.5m");
  }
  return {};
}

// Everything but the lamp was measured once: shadow card in the beam, or the lamp off.
bool HasBackground(const Session& session, const std::string& light) {
  return std::ranges::any_of(session.readings, [&](const SessionReading& row) {
    return row.reading.light == light &&
           (row.reading.shadow_card || row.reading.lamp == LampState::kOff);
  });
}

Result<Summary> TypedSummary(const std::string& text) {
  const auto illuminance = ParseIlluminance(text);
  if (!illuminance) return tl::unexpected(illuminance.error());
  Summary summary;
  summary.count = 1;
  summary.kept.reading.illuminance = *illuminance;
  summary.kept.reading.time = NowIso8601();
  return summary;
}

Result<Summary> AskedSummary() {
  const auto typed = Ask("What does the meter show? (for example 192 or 17.8fc) ");
  if (!typed || typed->empty()) {
    return Failed("no_device", "meter", "no meter is plugged in and no number was typed");
  }
  return TypedSummary(*typed);
}

// The measured values in the frame of this run's light and place.
Reading Placed(const Reading& measured, const Reading& frame) {
  Reading reading = measured;
  reading.light = frame.light;
  reading.meter = frame.meter;
  reading.distance = frame.distance;
  reading.tilt = frame.tilt;
  reading.lamp = frame.lamp;
  reading.shadow_card = frame.shadow_card;
  return reading;
}

// A limit is worth keeping, and worth better than a limit.
void WarnOutOfRange(const Reading& reading, Warnings& warnings) {
  if (reading.over_range) {
    warnings.push_back({"over_range", reading.device,
                        "the light is above the meter's range and is kept as \"at least " +
                            RoundedText(reading.illuminance->value(), 4) +
                            " lx\"; move back, or put a neutral-density filter of known density "
                            "before it and divide"});
  }
  if (reading.under_range) {
    warnings.push_back({"under_range", reading.device,
                        "the light is below the meter's range and is kept as \"at most " +
                            RoundedText(reading.illuminance->value(), 4) + " lx\"; move closer"});
  }
}

// A reading the journal would not take back is refused before anything is written.
Result<void> CheckReading(const Reading& reading) {
  const auto read_back = ReadingFromJson(ReadingToJson(reading), "this reading");
  if (!read_back) return tl::unexpected(read_back.error());
  return {};
}

nlohmann::ordered_json ToJson(const Reading& reading, const Summary& summary, bool with_spectrum) {
  auto json = nlohmann::ordered_json::parse(ReadingToJson(reading));
  json["measurements"] = summary.count;
  if (summary.count > 1) json["spread_relative"] = summary.spread_relative;
  if (summary.kept.cri_Ra) json["cri_Ra"] = *summary.kept.cri_Ra;
  if (with_spectrum && summary.kept.spectrum) {
    json["spectrum_nm"] = summary.kept.spectrum->wavelengths_nm;
    json["spectrum_W_m2_nm"] = summary.kept.spectrum->values;
  }
  return json;
}

std::string Sentence(const Reading& reading, const Summary& summary) {
  std::string text = LuxText(reading);
  const bool in_range = !reading.over_range && !reading.under_range;
  if (reading.sigma_relative && in_range) {
    text += " ± " + RoundedText(kZ95 * 100.0 * *reading.sigma_relative, 2) + " %";
  }
  if (reading.cct) text += ", " + RoundedText(reading.cct->value(), 4) + " K";
  if (reading.duv) text += ", Duv " + RoundedText(*reading.duv, 2);
  if (!reading.light.empty()) text += "  " + reading.light;
  if (reading.distance) text += " at " + ShortestText(reading.distance->value()) + " m";
  if (reading.shadow_card) text += ", shadow card";
  if (reading.lamp == LampState::kOff) text += ", lamp off";
  if (summary.count > 1) {
    text += "  (median of " + std::to_string(summary.count) + ", spread " +
            RoundedText(100.0 * summary.spread_relative, 2) + " %)";
  }
  return text + "\n";
}

// One run of the command.
class ReadRun {
 public:
  ReadRun(const Options& options, Console& console) : options_(options), console_(console) {}

  Result<void> Execute() {
    if (auto checked = CheckOptions(options_); !checked) return checked;
    auto frame = ReadingTemplate(options_);
    if (!frame) return Propagate(std::move(frame));
    if (auto planned = MakePlan(); !planned) return planned;
    if (auto loaded = LoadTheSession(); !loaded) return loaded;
    auto calibrations = MeterCalibrations::Load(options_.session);
    if (!calibrations) return Propagate(std::move(calibrations));
    calibrations_ = *std::move(calibrations);
    if (auto opened = OpenTheMeter(); !opened) return opened;
    auto done = TakeSeries(*frame);
    if (meter_) {
      const auto finished = meter_->Finish(console_);
      if (done && !finished) return finished;
    }
    if (!done) return done;
    if (auto strict = console_.RefuseIfStrict(); !strict) return strict;
    console_.PrintJson(Document());
    return {};
  }

 private:
  struct Taken {
    Reading reading;
    Summary summary;
  };

  Result<void> MakePlan() {
    plan_.measurements = options_.once ? 1 : options_.measurements;
    if (!options_.settle.empty()) {
      const auto tolerance = ParseTolerance(options_.settle);
      if (!tolerance) return tl::unexpected(tolerance.error());
      plan_.settle_relative = *tolerance;
    }
    const auto every = ParseDuration(options_.every);
    if (!every) return tl::unexpected(every.error());
    if (every->value() < 0.0 || every->value() > 86400.0) {
      return WrongUsage("--every " + options_.every, "give between 0s and 86400s");
    }
    every_ = std::chrono::milliseconds(static_cast<std::int64_t>(every->value() * 1e3));
    return {};
  }

  Result<void> LoadTheSession() {
    if (options_.session.empty()) return {};
    auto loaded = LoadSession(options_.session);
    if (!loaded) return Propagate(std::move(loaded));
    console_.Warn(loaded->warnings);
    session_ = std::move(loaded->session);
    return CheckNames(*session_, options_.light, options_.meter);
  }

  Result<void> OpenTheMeter() {
    if (!options_.lux.empty()) return {};
    auto opened = MeterSession::Open(options_.request, console_);
    if (opened) {
      meter_ = *std::move(opened);
      return {};
    }
    const bool may_type = opened.error().code == fault::kNoDevice &&
                          options_.request.device.empty() && AsksQuestions();
    if (!may_type) return Propagate(std::move(opened));
    console_.Note("No meter is plugged in: type what yours shows.");
    return {};
  }

  [[nodiscard]] bool AsksQuestions() const { return CanAsk() && !console_.json(); }

  // Each round is in the journal before it is printed, and printed before the next begins.
  Result<void> TakeSeries(const Reading& frame) {
    for (int round = 0; round < options_.repeat; ++round) {
      if (round > 0 && meter_ && !meter_->HasMore()) break;
      if (round > 0 && !(meter_ && meter_->IsReplay())) std::this_thread::sleep_for(every_);
      taken_.clear();
      if (auto taken = TakeReadings(frame); !taken) return taken;
      if (auto published = Publish(); !published) return published;
    }
    return {};
  }

  Result<void> TakeReadings(const Reading& frame) {
    const bool is_background = frame.shadow_card || frame.lamp == LampState::kOff;
    if (session_ && !is_background && !HasBackground(*session_, options_.light)) {
      if (auto first = BackgroundFirst(frame); !first) return first;
    }
    return TakeOne(frame);
  }

  // Ambient light and bounce are known only from a reading without the direct beam.
  Result<void> BackgroundFirst(const Reading& frame) {
    if (!AsksQuestions() || !options_.lux.empty()) {
      console_.Note(
          "note: " + options_.light +
          " has no shadow-card reading yet, so ambient light and bounce stay assumed. "
          "Block only\nthe direct beam with a card and add --shadow-card to this command.");
      return {};
    }
    const auto answer =
        Ask("First hold a card so that only the direct beam is blocked, then press Enter "
            "(s + Enter to skip). ");
    if (!answer || *answer == "s") return {};
    Reading shadow = frame;
    shadow.shadow_card = true;
    if (auto taken = TakeOne(shadow); !taken) return taken;
    if (!Ask("Now take the card away and press Enter. ")) {
      return Failed("interrupted", options_.light, "stopped by you; nothing was written");
    }
    return {};
  }

  Result<void> TakeOne(const Reading& frame) {
    auto summary = !options_.lux.empty() ? TypedSummary(options_.lux)
                   : meter_              ? TakeSummary(plan_, *meter_, console_)
                                         : AskedSummary();
    if (!summary) return Propagate(std::move(summary));
    Warnings& warnings = summary->kept.warnings;
    calibrations_.Apply(summary->kept.reading, warnings);
    WarnOutOfRange(summary->kept.reading, warnings);
    WarnOnce(warnings);
    Taken taken{Placed(summary->kept.reading, frame), *std::move(summary)};
    if (auto checked = CheckReading(taken.reading); !checked) return checked;
    taken_.push_back(std::move(taken));
    return {};
  }

  // A series may be long: what was said once is not said again.
  void WarnOnce(const Warnings& warnings) {
    for (const Warning& warning : warnings) {
      if (warned_.insert(warning.code + " " + warning.subject).second) console_.Warn(warning);
    }
  }

  Result<void> Publish() {
    if (auto strict = console_.RefuseIfStrict(); !strict) return strict;
    for (const Taken& taken : taken_) {
      if (session_) {
        const std::string journal = JournalPath(options_.session);
        if (auto kept = AppendToJournal(journal, taken.reading); !kept) return kept;
      }
      ++published_;
      console_.Print(Sentence(taken.reading, taken.summary));
      std::fflush(stdout);
    }
    return {};
  }

  [[nodiscard]] nlohmann::ordered_json Document() const {
    const Taken& last = taken_.back();
    auto json = ToJson(last.reading, last.summary, options_.with_spectrum);
    if (options_.repeat > 1) json["repeated"] = published_;
    return json;
  }

  const Options& options_;
  Console& console_;
  std::optional<Session> session_;
  std::unique_ptr<MeterSession> meter_;
  MeasuringPlan plan_;
  std::chrono::milliseconds every_{0};
  MeterCalibrations calibrations_;
  std::vector<Taken> taken_;  // of this round: a background reading, and the one asked for
  std::set<std::string> warned_;
  int published_ = 0;
};

Result<void> RunRead(const Options& given, Console& console) {
  Options options = given;
  const auto timeout = ParseDuration(options.timeout);
  if (!timeout) return tl::unexpected(timeout.error());
  if (timeout->value() < 1e-3 || timeout->value() > 3600.0) {
    return WrongUsage("--timeout " + options.timeout, "give between 1ms and 3600s");
  }
  options.request.reply_timeout =
      std::chrono::milliseconds(static_cast<int>(timeout->value() * 1e3));
  for (const std::string& setting : options.settings) {
    const auto equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) {
      return WrongUsage("--set " + setting, "write name=value");
    }
    options.request.settings[setting.substr(0, equals)] = setting.substr(equals + 1);
  }
  return ReadRun(options, console).Execute();
}

}  // namespace

Run BuildRead(CLI::App& parser) {
  auto options = std::make_shared<Options>();
  parser.add_option("-s,--session", options->session, "Session the readings are appended to");
  parser.add_option("--light", options->light, "Name of the lamp, as in session.toml");
  parser.add_option("--distance", options->distance, "From the lamp to the meter: 0.5m, 50cm, 2ft");
  parser.add_option("--tilt", options->tilt, "Between the meter's normal and the lamp, degrees");
  parser.add_option("--meter", options->meter, "The session's [[meter]] that took the reading");
  auto* count =
      parser.add_option("-n", options->measurements, "Measurements to take the median of");
  count->check(CLI::Range(1, 1000))->default_str(std::to_string(kDefaultMeasurements));
  auto* settle = parser.add_option("--settle", options->settle,
                                   "First wait until the light is steady, within 0.5% or this");
  settle->expected(0, 1);
  auto* repeat =
      parser.add_option("--repeat", options->repeat, "So many readings, one after another");
  repeat->check(CLI::Range(1, 10000000));
  parser.add_option("--every", options->every, "Pause between repeated readings: 10s");
  parser.add_option("--set", options->settings, "An option of the driver: name=value")
      ->allow_extra_args(false);
  auto* shadow =
      parser.add_flag("--shadow-card", options->shadow_card, "A card blocks the direct beam only");
  parser.add_flag("--lamp-off", options->lamp_off, "The lamp is switched off")->excludes(shadow);
  auto* lux = parser.add_option("--lux", options->lux, "A typed reading: 192, 192lx, 17.8fc");
  auto* device =
      parser.add_option("--device", options->request.device, "A meter's id or driver's name");
  auto* record = parser.add_option("--record", options->request.record_file,
                                   "Write the dialogue with the meter as a tape");
  auto* replay =
      parser.add_option("--replay", options->request.replay_file, "Play a tape instead of a meter");
  lux->excludes(device)->excludes(record)->excludes(replay)->excludes(count);
  lux->excludes(settle)->excludes(repeat);
  replay->excludes(device);
  parser.add_flag("--once", options->once, "One measurement; -s, --light and --distance optional")
      ->excludes(count);
  parser.add_flag("--with-spectrum", options->with_spectrum, "With --json: the spectrum too");
  parser.add_option("--timeout", options->timeout, "Longest wait for one answer of the meter")
      ->capture_default_str();
  return [options, settle](Console& console) {
    if (settle->count() > 0 && options->settle.empty()) options->settle = "0.5%";
    return RunRead(*options, console);
  };
}

}  // namespace lightcal::app
