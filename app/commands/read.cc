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
#include "lightcal_devices/meters/text/frame.h"
#include "measuring.h"
#include "meter_calibrations.h"
#include "meter_session.h"
#include "read_options.h"
#include "session_names.h"
#include "terminal.h"

namespace lightcal::app {
namespace {

// Everything but the lamp was measured once: shadow card in the beam, or the lamp off.
bool HasBackground(const Session& session, const std::string& light) {
  return std::ranges::any_of(session.readings, [&](const SessionReading& row) {
    return row.reading.light == light &&
           (row.reading.shadow_card || row.reading.lamp == LampState::kOff);
  });
}

// What the driver `typed` understands; what is no number is a wrong command line.
Result<Summary> TypedSummary(const std::string& text) {
  const auto typed = text::DecodeLine(text);
  if (!typed || !*typed) {
    if (auto number = ParseIlluminance(text); !number) return tl::unexpected(number.error());
    return Refused("bad_reading", "--lux " + text, typed ? "is no reading" : typed.error().message);
  }
  Summary summary;
  summary.count = 1;
  summary.kept.reading.illuminance = (*typed)->illuminance;
  summary.kept.reading.cct = (*typed)->cct;
  summary.kept.reading.time = NowIso8601();
  return summary;
}

Result<Summary> AskedSummary() {
  const auto typed = Ask("What does the meter show? (for example 192, 17.8fc, or 192,2900K) ");
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
  const MeterReading& kept = summary.kept;
  if (kept.cri_Ra) json["cri_Ra"] = *kept.cri_Ra;
  if (kept.tlci_Qa) json["tlci_Qa"] = *kept.tlci_Qa;
  if (kept.tm30_Rf) json["tm30_rf"] = *kept.tm30_Rf;
  if (kept.tm30_Rg) json["tm30_rg"] = *kept.tm30_Rg;
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
  ReadRun(const ReadOptions& options, Console& console) : options_(options), console_(console) {}

  Result<void> Execute() {
    if (auto loaded = LoadTheSession(); !loaded) return loaded;
    auto calibrations = MeterCalibrations::Load(options_.session);
    if (!calibrations) return Propagate(std::move(calibrations));
    calibrations_ = *std::move(calibrations);
    if (auto opened = OpenTheMeter(); !opened) return opened;
    auto done = TakeSeries(options_.frame);
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

  Result<void> LoadTheSession() {
    if (options_.session.empty()) return {};
    auto loaded = LoadSession(options_.session);
    if (!loaded) return Propagate(std::move(loaded));
    console_.Warn(loaded->warnings);
    session_ = std::move(loaded->session);
    return CheckNames(*session_, options_.frame.light, options_.frame.meter);
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
      if (round > 0 && !(meter_ && meter_->IsReplay())) std::this_thread::sleep_for(options_.every);
      taken_.clear();
      if (auto taken = TakeReadings(frame); !taken) return taken;
      if (auto published = Publish(); !published) return published;
    }
    return {};
  }

  Result<void> TakeReadings(const Reading& frame) {
    const bool is_background = frame.shadow_card || frame.lamp == LampState::kOff;
    const bool first_round = published_ == 0;
    if (session_ && first_round && !is_background &&
        !HasBackground(*session_, options_.frame.light)) {
      if (auto first = BackgroundFirst(frame); !first) return first;
    }
    return TakeOne(frame);
  }

  // Ambient light and bounce are known only from a reading without the direct beam.
  Result<void> BackgroundFirst(const Reading& frame) {
    if (!AsksQuestions() || !options_.lux.empty()) {
      console_.Note(
          "note: " + options_.frame.light +
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
      return Failed("interrupted", options_.frame.light, "stopped by you; nothing was written");
    }
    return {};
  }

  Result<void> TakeOne(const Reading& frame) {
    auto summary = !options_.lux.empty() ? TypedSummary(options_.lux)
                   : meter_              ? TakeSummary(options_.plan, *meter_, console_)
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

  const ReadOptions& options_;
  Console& console_;
  std::optional<Session> session_;
  std::unique_ptr<MeterSession> meter_;
  MeterCalibrations calibrations_;
  std::vector<Taken> taken_;  // of this round: a background reading, and the one asked for
  std::set<std::string> warned_;
  int published_ = 0;
};

}  // namespace

Run BuildRead(CLI::App& parser) {
  auto arguments = AddReadOptions(parser);
  return [arguments](Console& console) -> Result<void> {
    const auto options = ReadOptionsFrom(*arguments);
    if (!options) return tl::unexpected(options.error());
    return ReadRun(*options, console).Execute();
  };
}

}  // namespace lightcal::app
