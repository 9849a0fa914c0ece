// SPDX-License-Identifier: Apache-2.0
// lightcal read: live readings, or typed ones, into a session's journal.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <thread>

#include "commands.h"
#include "guide/guided_reading.h"
#include "input_files.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/printable.h"
#include "lightcal/fit/model/input_checks.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/records/journal.h"
#include "lightcal/records/session_codec.h"
#include "lightcal/records/session_reader.h"
#include "read_options.h"
#include "reading_source.h"
#include "session_names.h"
#include "taken_back.h"
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

Node ToJson(const TakenReading& taken, bool with_spectrum) {
  const devices::Summary& summary = taken.summary;
  const devices::MeterReading& kept = summary.kept;
  Node node = DocumentOf(taken.reading);
  node.Put({{"measurements", summary.count},
            {"spread_relative", summary.count > 1 ? Node(summary.spread_relative) : Node()},
            {"cri_Ra", kept.cri_Ra},
            {"tlci_Qa", kept.tlci_Qa},
            {"tm30_rf", kept.tm30_Rf},
            {"tm30_rg", kept.tm30_Rg}});
  if (with_spectrum && kept.spectrum) {
    node.Put({{"spectrum_nm", kept.spectrum->wavelengths_nm},
              {"spectrum_W_m2_nm", kept.spectrum->values}});
  }
  return node;
}

// One run of the command.
class ReadRun {
 public:
  ReadRun(const ReadOptions& options, Console& console) : options_(options), console_(console) {}

  Result<void> Execute() {
    if (auto loaded = LoadTheSession(); !loaded) return loaded;
    DoubtDistance();
    const bool typed = options_.typed || !options_.lux.empty();
    auto opened = ReadingSource::Open(
        {options_.session, typed, options_.request,
         session_ ? session_->meters : std::vector<MeterDescription>(), "--lux 192"},
        AsksQuestions(), console_);
    if (!opened) return Propagate(std::move(opened));
    source_ = *std::move(opened);
    Reading frame = options_.frame;
    const bool by_hand = source_.meter() == nullptr || !options_.lux.empty();
    if (by_hand && session_ && frame.meter.empty() && session_->meters.size() == 1) {
      frame.meter = session_->meters.front().name;  // whose accuracy the session states
    }
    auto done = TakeSeries(frame);
    const auto finished = source_.Finish(console_);
    if (done && !finished) return finished;
    if (!done) return done;
    if (auto strict = console_.RefuseIfStrict(); !strict) return strict;
    console_.PrintDocument(Document());
    return {};
  }

 private:
  Result<void> LoadTheSession() {
    if (options_.session.empty()) return {};
    auto loaded = LoadSession(options_.session, InputSources().read_text);
    if (!loaded) return Propagate(std::move(loaded));
    console_.Warn(loaded->warnings);
    session_ = std::move(loaded->session);
    Reading& frame = options_.frame;
    auto light = LightMeant(*session_, frame.light);
    if (!light) return Propagate(std::move(light));
    frame.light = *std::move(light);
    if (auto named = CheckNames(*session_, frame.light, frame.meter); !named) return named;
    if (!frame.distance && fit::HasDistanceLaw(FindLight(*session_, frame.light)->kind)) {
      return WrongUsage("--distance",
                        "give the distance from the lamp, for example 0.5m; or --guided to be told "
                        "where to put the meter");
    }
    return CheckState(*session_, frame);
  }

  // As `fit` would of the session later, while the meter still stands there.
  void DoubtDistance() {
    const Reading& frame = options_.frame;
    if (!frame.distance) return;
    if (session_ && !fit::HasDistanceLaw(FindLight(*session_, frame.light)->kind)) return;
    const Surroundings around = session_ ? session_->surroundings : Surroundings::kIndoors;
    if (auto doubt = fit::DoubtOfDistance(around, frame.light, *frame.distance)) {
      console_.Warn({*std::move(doubt)});
    }
  }

  [[nodiscard]] bool AsksQuestions() const { return CanAsk() && !console_.json(); }

  // Each round is in the journal before it is printed, and printed before the next begins.
  Result<void> TakeSeries(const Reading& frame) {
    for (int round = 0; round < options_.repeat; ++round) {
      if (round > 0 && !source_.HasMore()) break;
      if (round > 0) Pause();
      taken_.clear();
      if (auto taken = TakeReadings(frame); !taken) return taken;
      if (auto published = Publish(); !published) return published;
    }
    return {};
  }

  void Pause() {
    if (source_.meter() != nullptr) {
      source_.meter()->Pause(options_.every);
    } else {
      std::this_thread::sleep_for(options_.every);
    }
  }

  Result<void> TakeReadings(const Reading& frame) {
    const bool is_background = frame.shadow_card || frame.lamp == LampState::kOff;
    const bool first_round = published_ == 0;
    const bool dark = session_ && session_->surroundings == Surroundings::kDark;
    if (session_ && first_round && !is_background && !dark &&
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
    if (AsksQuestions() && source_.meter() != nullptr && !taken_.empty()) {
      source_.meter()->DropBacklog();  // a card was taken away meanwhile
    }
    auto taken = options_.lux.empty() ? source_.Take(frame, options_.plan, console_)
                                      : source_.TakeTyped(frame, options_.lux, console_);
    if (!taken) return Propagate(std::move(taken));
    taken_.push_back(*std::move(taken));
    return {};
  }

  Result<void> Publish() {
    if (auto strict = console_.RefuseIfStrict(); !strict) return strict;
    for (const TakenReading& taken : taken_) {
      if (session_) {
        const std::string journal = JournalPath(options_.session);
        if (auto kept = AppendToJournal(journal, taken.reading); !kept) return kept;
      }
      ++published_;
      console_.Print(SayReading(taken));
      std::fflush(stdout);
    }
    return {};
  }

  [[nodiscard]] Node Document() const {
    Node node = ToJson(taken_.back(), options_.with_spectrum);
    if (options_.repeat > 1) node.Put("repeated", published_);
    return node;
  }

  ReadOptions options_;
  Console& console_;
  std::optional<Session> session_;
  ReadingSource source_;
  std::vector<TakenReading> taken_;  // of this round: a background reading, and the one asked for
  int published_ = 0;
};

// A number typed wrong is taken back; the line stays in the journal, and another says so.
Result<void> RunUndo(const std::string& session, const std::string& light, Console& console) {
  const auto taken = TakeBackLast(session, light, console);
  if (!taken) return tl::unexpected(taken.error());
  console.Print("took back " + taken->where + ": " + SayTakenBack(taken->reading) + "\n");
  console.PrintDocument({{"took_back", taken->where}, {"reading", DocumentOf(taken->reading)}});
  return {};
}

}  // namespace

Run BuildRead(CLI::App& parser) {
  auto arguments = AddReadOptions(parser);
  return [arguments](Console& console) -> Result<void> {
    if (arguments->undo) return RunUndo(arguments->session, arguments->light, console);
    const auto options = ReadOptionsFrom(*arguments, CanAsk() && !console.json());
    if (!options) return tl::unexpected(options.error());
    if (options->guided) return ReadGuided(*options, console);
    return ReadRun(*options, console).Execute();
  };
}

}  // namespace lightcal::app
