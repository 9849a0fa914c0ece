// SPDX-License-Identifier: Apache-2.0
#include "guide/guided_reading.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "calibration_options.h"
#include "guide/drawings.h"
#include "guide/shell_word.h"
#include "guide/step_answer.h"
#include "interrupt.h"
#include "light_summary.h"
#include "light_table.h"
#include "lightcal/calibrate/reading_guide.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/printable.h"
#include "lightcal/records/journal.h"
#include "lightcal/records/session_codec.h"
#include "option_words.h"
#include "reading_source.h"
#include "session_names.h"
#include "taken_back.h"
#include "terminal.h"

namespace lightcal::app {
namespace {

std::string Within(double part) { return "± " + PercentText(part); }

// How far from one hundred per cent to what is wanted, in equal ratios.
std::string ProgressBar(double u95_relative, double wanted_relative) {
  constexpr double kWidth = 20.0;
  const double part = std::clamp(std::log(u95_relative) / std::log(wanted_relative), 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(std::floor(kWidth * part));
  return "[" + std::string(filled, '#') + std::string(std::size_t(kWidth) - filled, '.') + "]";
}

// "0.5 m" of the number that goes into the journal, too.
Metres Spoken(Metres distance) {
  return Metres(ParseNumber(RoundedText(distance.value(), 4)).value_or(distance.value()));
}

class Walk {
 public:
  Walk(const ReadOptions& options, Console& console)
      : options_(options), console_(console), frame_(options.frame), plan_(options.plan) {}

  Result<void> Run() {
    const InterruptGuard guard;
    if (auto begun = Begin(); !begun) return begun;
    auto walked = TakeSteps();
    const auto finished = source_.Finish(console_);
    if (!walked) return walked;
    if (!finished) return finished;
    Conclude();
    return {};
  }

 private:
  enum class Ending { kReached, kNoGain, kPerson, kTape };

  Result<void> Begin() {
    auto measured = MeasureAloud(options_.session, {}, console_);
    if (!measured) return Propagate(std::move(measured));
    const Session& session = measured->session;
    if (auto named = ChooseNames(session); !named) return named;
    const bool may_type = !console_.json() || options_.typed;
    auto opened = ReadingSource::Open(
        {options_.session, options_.typed, options_.request, session.meters, "--typed"}, may_type,
        console_);
    if (!opened) return Propagate(std::move(opened));
    source_ = *std::move(opened);
    typed_ = source_.meter() == nullptr;
    if (typed_ && frame_.meter.empty() && session.meters.size() == 1) {
      frame_.meter = session.meters.front().name;
    }
    const bool tape = !typed_ && source_.meter()->IsReplay();
    if (tape && plan_.measurements == 0) plan_.measurements = 1;
    guide_.emplace(session, frame_.light, options_.until_relative, options_.shadow_cards);
    Introduce(session);
    return {};
  }

  Result<void> ChooseNames(const Session& session) {
    auto light = LightMeant(session, frame_.light);
    if (!light) return Propagate(std::move(light));
    frame_.light = *std::move(light);
    if (auto named = CheckNames(session, frame_.light, frame_.meter); !named) return named;
    if (frame_.state.empty()) frame_.state = ReferenceState(session, frame_.light);
    return CheckState(session, frame_);
  }

  void Introduce(const Session& session) const {
    const LightDescription& light = *FindLight(session, frame_.light);
    console_.Note("Lamp " + light.name + " (" + std::string(LightKindName(light.kind)) +
                  "), until it is known within " + Within(options_.until_relative) + " (95 %).");
    const double meter = guide_->meter_u95_relative();
    if (meter >= 0.98 * options_.until_relative) {  // all else adds to it
      console_.Note("The meter's own accuracy leaves " + Within(meter) +
                    " however often it reads: that will not be reached.");
    }
    if (light.kind != LightKind::kDirectional && light.kind != LightKind::kDome) {
      console_.Note("Measure distances from one point of the lamp that you can find again.");
    }
    if (!frame_.state.empty()) {
      console_.Note("Its controls stay at " + StateText(frame_.state) + ".");
    }
    if (guide_->light()) console_.Note(Progress());
  }

  Result<void> TakeSteps() {
    while (true) {
      const auto advice = guide_->Next();
      if (!advice) {
        const auto undone = OfferToTakeBack(advice.error());
        if (!undone) return tl::unexpected(undone.error());
        if (*undone) continue;
        return tl::unexpected(advice.error());
      }
      if (advice->kind != GuideAdvice::Kind::kMeasure) {
        ending_ = advice->kind == GuideAdvice::Kind::kReached ? Ending::kReached : Ending::kNoGain;
        return {};
      }
      if (!source_.HasMore()) {
        ending_ = Ending::kTape;
        return {};
      }
      ++step_;
      const auto goes_on = TakeStep(advice->step);
      if (!goes_on) return tl::unexpected(goes_on.error());
      if (!*goes_on) return {};
    }
  }

  // Until the step is measured or skipped. False: the person stops here.
  Result<bool> TakeStep(PlannedReading step) {
    if (step.distance) step.distance = Spoken(*step.distance);
    const PlannedReading advised = step;
    if (step.action == PlannedAction::kShadowCard && !drawn_) {
      console_.Note("\n" + ShadowCardDrawing());
      drawn_ = true;
    }
    std::string prompt = "\n" + Instruction(step) + "\n" + Offer(step);
    while (true) {
      const auto typed = Ask(prompt);
      if (!typed) return EndOfInput();
      const auto answer = Understood(*typed, step);
      if (!answer) {
        Explain(answer.error());
        prompt = Offer(step);
        continue;
      }
      if (answer->kind == StepAnswer::Kind::kQuit) return false;
      if (answer->kind == StepAnswer::Kind::kUndo) {
        const auto undone = TakeBack();
        if (!undone) return tl::unexpected(undone.error());
        if (*undone) return true;
        prompt = Offer(step);
        continue;
      }
      if (answer->kind == StepAnswer::Kind::kSkip) {
        guide_->Skip(advised);
        return true;
      }
      if (answer->distance) MoveTo(*answer->distance, step);
      if (typed_ && answer->kind == StepAnswer::Kind::kMoved) {
        prompt = Offer(step);
        continue;
      }
      const auto kept = Measure(step, *answer);
      if (!kept) return tl::unexpected(kept.error());
      if (*kept) return true;
      prompt = "\n" + Instruction(step) + "\n" + Offer(step);
    }
  }

  // Readings that contradict one another lead nowhere: one of them may go. False: the person stops.
  Result<bool> OfferToTakeBack(const Error& error) {
    if (taken_ == 0) return false;
    Explain(error);
    const auto answer = Ask("   u = take the last reading back, Enter = stop here: ");
    if (!answer || (*answer != "u" && *answer != "undo")) return false;
    return TakeBack();
  }

  // The last reading of this run counts no more; its line stays in the journal. False: there is
  // none.
  Result<bool> TakeBack() {
    if (!guide_->TakeBack()) {
      console_.Note("   nothing was read in this run yet");
      return false;
    }
    const auto back = TakeBackThis(options_.session, mine_.back());
    if (!back) return tl::unexpected(back.error());
    mine_.pop_back();
    --taken_;
    console_.Note("   took the last reading back: " + SayTakenBack(back->reading));
    if (guide_->light()) console_.Note(Progress());
    return true;
  }

  [[nodiscard]] Result<StepAnswer> Understood(const std::string& text,
                                              const PlannedReading& step) const {
    auto answer = ParseStepAnswer(text, typed_);
    if (!answer || !answer->distance || step.action == PlannedAction::kRead) return answer;
    return WrongUsage("", "this reading belongs to the one before: leave the meter where it is");
  }

  static void MoveTo(Metres distance, PlannedReading& step) {
    step.distance = distance;
    step.position_m.reset();
    step.normal.reset();
    step.expected = Lux(0.0);
  }

  [[nodiscard]] Result<bool> EndOfInput() const {
    std::fputc('\n', stderr);
    if (!InterruptGuard::StopRequest().Requested()) return false;
    return Failed("interrupted", frame_.light,
                  "stopped by you; " + std::to_string(taken_) + " readings are in the journal");
  }

  // "1. Put the meter 0.5 m from the lamp, facing it."
  [[nodiscard]] std::string Instruction(const PlannedReading& step) const {
    std::string text = std::to_string(step_) + ". ";
    const bool by_distance = step.distance.has_value();
    const std::string at = by_distance ? ShortestText(step.distance->value()) + " m" : "";
    switch (step.action) {
      case PlannedAction::kShadowCard:
        return text + "Leave the meter" + (by_distance ? " at " + at : " where it is") +
               ". Hold the card so that only the lamp's direct light is blocked.";
      case PlannedAction::kLampOff:
        return text + "Switch the lamp off" +
               (by_distance ? ", the meter at " + at + "." : "; leave the meter where it is.");
      case PlannedAction::kRead:
        break;
    }
    if (by_distance && step.off_axis && step.off_axis->value() != 0.0) {
      text += "Put the meter " + at + " from the lamp, " +
              RoundedText(std::abs(DegreesFromRadians(*step.off_axis)), 3) +
              " degrees off its axis, facing it, nothing in between.";
    } else if (by_distance) {
      text += "Put the meter " + at + " from the lamp, facing it, nothing in between.";
    } else if (step.position_m) {
      text += "Now " + SayPlannedReading(step) + " (x, y, z of the session).";
    } else {
      text += "Put the meter where the light is to be known, facing the lamp.";
    }
    const bool expects = guide_->light() && step.expected.value() > 0.0;
    return text +
           (expects ? " Expect about " + RoundedText(step.expected.value(), 2) + " lx." : "");
  }

  [[nodiscard]] std::string Offer(const PlannedReading& step) const {
    const bool may_move = step.action == PlannedAction::kRead && step.distance;
    const std::string moved = may_move ? "0.8m = it stands at 0.8 m instead, " : "";
    const std::string others =
        moved + "s = skip, " + (taken_ > 0 ? "u = take the last one back, " : "") + "q = stop";
    if (!typed_) return "   Enter = measure, " + others + ": ";
    const std::string at =
        step.distance ? " at " + ShortestText(step.distance->value()) + " m" : "";
    return "   What does it show" + at + "? 192, 17.8fc or 192,2900K (" + others + "): ";
  }

  void Explain(const Error& error) const {
    const std::string subject = error.subject.empty() ? "" : error.subject + ": ";
    std::fprintf(stderr, "   %s\n", Printable(subject + InOptionWords(error.message)).c_str());
  }

  // Into the journal, unless it looks wrong and the person takes it back. False: measure again.
  Result<bool> Measure(const PlannedReading& step, const StepAnswer& answer) {
    Reading frame = frame_;
    frame.distance = step.distance;
    frame.position_m = step.position_m;
    frame.normal = step.normal;
    frame.off_axis = step.off_axis.value_or(Radians(0.0));
    frame.shadow_card = step.action == PlannedAction::kShadowCard;
    frame.lamp = step.action == PlannedAction::kLampOff ? LampState::kOff : LampState::kOn;
    if (!typed_) source_.meter()->DropBacklog();
    const auto taken = typed_ ? source_.TakeTyped(frame, answer.typed, console_)
                              : source_.Take(frame, plan_, console_);
    if (!taken) {
      if (!MayTryAgain(taken.error())) return tl::unexpected(taken.error());
      Explain(taken.error());
      return false;
    }
    const Reading& reading = taken->reading;
    console_.Print("   " + SayReading(*taken));
    std::fflush(stdout);
    if (const std::string doubt = guide_->DoubtAbout(reading); !doubt.empty()) {
      const auto keep = Ask("   Is that right? " + doubt +
                            ".\n   Enter = measure it again, k = keep it all the same: ");
      if (!keep) return EndOfInput();
      if (*keep != "k") return false;
    }
    if (auto strict = console_.RefuseIfStrict(); !strict) return Propagate(std::move(strict));
    const std::string journal = JournalPath(options_.session);
    if (auto kept = AppendToJournal(journal, reading); !kept) return Propagate(std::move(kept));
    mine_.push_back(reading);
    ++taken_;
    plan_.settle_relative.reset();  // the lamp is warm now
    guide_->Add(reading);
    Report(reading);
    return true;
  }

  // A number that is none can be typed again and a meter asked again; a tape only repeats itself.
  [[nodiscard]] bool MayTryAgain(const Error& error) const {
    if (InterruptGuard::StopRequest().Requested()) return false;
    return typed_ || (error.kind == ErrorKind::kFailed && !source_.meter()->IsReplay());
  }

  void Report(const Reading& reading) {
    const auto share = guide_->other_light_share();
    if (reading.shadow_card && share) {
      console_.Note("   " + PercentText(*share) +
                    " of what the meter saw here came from elsewhere; it is taken off.");
    }
    for (const Warning& warning : guide_->warnings()) {
      if (std::ranges::find(told_, warning.code) != told_.end()) continue;
      told_.push_back(warning.code);  // once a cause
      console_.Note("   note: " + InOptionWords(warning.message));
    }
    if (guide_->light()) console_.Note(Progress());
  }

  [[nodiscard]] std::string Progress() const {
    std::string text = "   So far " + frame_.light + ": " + Headline(*guide_->light());
    if (const auto u95 = guide_->u95_relative()) {
      text += "  " + ProgressBar(*u95, options_.until_relative) + " wanted " +
              Within(options_.until_relative);
    }
    return text;
  }

  [[nodiscard]] std::string EndingText() const {
    switch (ending_) {
      case Ending::kReached:
        return "That is within the " + Within(options_.until_relative) +
               " you wanted: enough is enough.\n";
      case Ending::kNoGain: {
        std::string text = "Enough with this meter: no further reading is worth its minutes";
        const auto& light = guide_->light();
        if (light && !light->budget.empty()) {
          text += ".\nMost of what is left is " + light->budget.front().name +
                  "; to halve it: " + light->budget.front().halve;
        }
        return text + ".\n";
      }
      case Ending::kTape:
        return "The tape has no more readings.\n";
      case Ending::kPerson:
        break;
    }
    return "Stopped by you; go on at any time with the same command.\n";
  }

  void Conclude() const {
    static constexpr const char* kWords[] = {"reached", "no_gain", "stopped", "tape_end"};
    Node document = {{"light", frame_.light},
                     {"readings_taken", taken_},
                     {"ended", kWords[static_cast<std::size_t>(ending_)]}};
    const auto& light = guide_->light();
    std::string text = "\n" + EndingText();
    if (light) {
      text = "\n" + light->name + ": " + Headline(*light) + " (95 %).\n" + EndingText() +
             "Next:\n  lightcal run " + ShellWord(options_.session) + "\n";
      const auto& value = light->intensity_cd ? light->intensity_cd : light->illuminance_lx;
      if (value) {
        document.Put(light->intensity_cd ? "intensity_cd" : "illuminance_lx", ValueAndU95(*value));
      }
    }
    document.Put("u95_relative", guide_->u95_relative());
    console_.Print(text);
    console_.PrintDocument(document);
  }

  const ReadOptions& options_;
  Console& console_;
  Reading frame_;
  MeasuringPlan plan_;
  ReadingSource source_;
  std::optional<ReadingGuide> guide_;
  Ending ending_ = Ending::kPerson;
  bool typed_ = false;
  bool drawn_ = false;
  std::vector<std::string> told_;  // codes of the fit's warnings that were shown
  std::vector<Reading> mine_;      // of this run, those that count
  int step_ = 0;
  int taken_ = 0;
};

}  // namespace

Result<void> ReadGuided(const ReadOptions& options, Console& console) {
  return Walk(options, console).Run();
}

}  // namespace lightcal::app
