// SPDX-License-Identifier: Apache-2.0
#include "reading_source.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "clock.h"
#include "input_files.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/printable.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/core/units_text.h"
#include "lightcal/records/session_codec.h"
#include "lightcal_devices/disk_sources.h"
#include "lightcal_devices/meters/text/frame.h"
#include "option_words.h"
#include "terminal.h"

namespace lightcal::app {
namespace {

// Where a person keeps meters.toml: beside the session ("" = none), whose word counts first, and in
// the settings folder.
std::vector<std::string> DirectoriesOfMeters(const std::string& session_path) {
  namespace fs = std::filesystem;
  std::vector<std::string> directories;
  if (!session_path.empty()) {
    directories.push_back(fs::path(JournalPath(session_path)).parent_path().string());
  }
  if (std::string settings = SettingsFolder(); !settings.empty()) {
    directories.push_back(std::move(settings));
  }
  return directories;
}

// What the driver `typed` understands; what is no number is a wrong command line.
Result<devices::Summary> TypedSummary(const std::string& text) {
  const auto typed = devices::text::DecodeLine(text);
  if (IsOverloadWord(text)) {
    return WrongUsage("--lux " + text, "says no number; " + std::string(kWriteALimit));
  }
  if (!typed || !*typed) {
    if (auto number = ParseIlluminance(text); !number) return tl::unexpected(number.error());
    return Refused("bad_reading", "--lux " + text, typed ? "is no reading" : typed.error().message);
  }
  devices::Summary summary;
  summary.count = 1;
  summary.kept.reading.illuminance = (*typed)->illuminance;
  summary.kept.reading.cct = (*typed)->cct;
  summary.kept.reading.over_range = (*typed)->over_range;
  summary.kept.reading.under_range = (*typed)->under_range;
  summary.kept.reading.time = MomentIso8601();
  return summary;
}

Result<devices::Summary> AskedSummary() {
  while (true) {
    const auto typed = Ask("What does the meter show? (for example 192, 17.8fc, or 192,2900K) ");
    if (!typed || typed->empty()) {
      return Failed("no_device", "meter", "no meter is plugged in and no number was typed");
    }
    auto summary = TypedSummary(*typed);
    if (summary) return summary;
    std::fprintf(stderr, "  %s\n", Printable(InOptionWords(summary.error().message)).c_str());
  }
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
  const auto fault = FaultOf(reading);
  if (fault) return Refused("bad_reading", "this reading", fault->message);
  return {};
}

}  // namespace

Reading PlacedIn(const Reading& frame, const Reading& measured) {
  Reading reading = measured;
  reading.light = frame.light;
  reading.meter = frame.meter;
  reading.distance = frame.distance;
  reading.position_m = frame.position_m;
  reading.normal = frame.normal;
  reading.tilt = frame.tilt;
  reading.off_axis = frame.off_axis;
  reading.lamp = frame.lamp;
  reading.shadow_card = frame.shadow_card;
  reading.state = frame.state;
  if (frame.duv) reading.duv = frame.duv;
  return reading;
}

std::string SayReading(const TakenReading& taken) {
  const Reading& reading = taken.reading;
  std::string text = LuxText(reading);
  const bool in_range = !reading.over_range && !reading.under_range;
  if (reading.sigma_relative && in_range) {
    text += " ± " + RoundedText(kZ95 * 100.0 * *reading.sigma_relative, 2) + " %";
  }
  if (reading.cct) text += ", " + RoundedText(reading.cct->value(), 4) + " K";
  if (reading.duv) text += ", Duv " + DuvText(*reading.duv);
  if (!reading.light.empty()) text += "  " + reading.light;
  if (reading.distance) text += " at " + ShortestText(reading.distance->value()) + " m";
  if (!reading.state.empty()) text += ", " + StateText(reading.state);
  if (reading.shadow_card) text += ", shadow card";
  if (reading.lamp == LampState::kOff) text += ", lamp off";
  if (taken.summary.count > 1) {
    text += "  (median of " + std::to_string(taken.summary.count) + ", spread " +
            PercentText(taken.summary.spread_relative) + ")";
  }
  return text + "\n";
}

Result<ReadingSource> ReadingSource::Open(const Settings& settings, bool may_type,
                                          Console& console) {
  ReadingSource source;
  auto calibrations =
      MeterCalibrations::Load(DirectoriesOfMeters(settings.session), InputSources());
  if (!calibrations) return Propagate(std::move(calibrations));
  source.calibrations_ = *std::move(calibrations);
  source.meters_ = settings.meters;
  source.sigma_is_set_ = settings.request.settings.contains("sigma");
  if (settings.typed) return source;
  auto opened = MeterSession::Open(settings.request, console);
  if (opened) {
    source.meter_ = *std::move(opened);
    return source;
  }
  const bool nothing_there =
      opened.error().code == devices::fault::kNoDevice && settings.request.device.empty();
  if (!may_type || !nothing_there) {
    Error error = std::move(opened).error();
    if (error.code == devices::fault::kNoDevice && !settings.to_type.empty()) {
      error.message += ", or type the reading: " + settings.to_type;
    }
    return tl::unexpected(std::move(error));
  }
  console.Note("No meter is plugged in: type what yours shows.");
  return source;
}

Result<TakenReading> ReadingSource::Take(const Reading& frame, const MeasuringPlan& plan,
                                         Console& console) {
  return Finished(frame, meter_ ? TakeSummary(plan, *meter_, console) : AskedSummary(), console);
}

Result<TakenReading> ReadingSource::TakeTyped(const Reading& frame, const std::string& text,
                                              Console& console) {
  return Finished(frame, TypedSummary(text), console);
}

void ReadingSource::HearSigma(const std::string& meter, const std::optional<double>& guess,
                              devices::Summary& summary) const {
  Reading& reading = summary.kept.reading;
  if (reading.device.empty() || !reading.sigma_relative) return;
  // Whoever says how far off it may be knows that nobody corrected it.
  const auto vouched = [&] {
    std::erase_if(summary.kept.warnings, [](const Warning& w) { return w.code == "uncalibrated"; });
  };
  if (sigma_is_set_) {
    reading.sigma_relative = guess;
    return vouched();
  }
  const bool guessed = reading.quality == MeterQuality::kBareSensor;
  const bool by_file = reading.sigma_relative != guess;
  const auto named = std::ranges::find(meters_, meter, &MeterDescription::name);
  if (named == meters_.end() || !named->states_sigma) {
    if (!guessed || by_file || !reading.calibration_factor) return;
    summary.kept.warnings.push_back(
        {"sigma_guessed", reading.device,
         "is corrected by its factor, yet counts within " +
             PercentText(kZ95 * *reading.sigma_relative) +
             " as any bare sensor: write sigma_relative beside the factor in meters.toml, how far "
             "off it may still be (1 sigma: 0.05)"});
    return;
  }
  const double scatter = summary.spread_relative;
  const double stated = named->sigma_relative;
  if (guessed || by_file || *reading.sigma_relative <= std::max(stated, scatter)) {
    reading.sigma_relative = scatter > stated ? std::optional(scatter) : std::nullopt;
    return vouched();
  }
  summary.kept.warnings.push_back(
      {"meter_sigma", reading.device,
       "counts within " + PercentText(kZ95 * *reading.sigma_relative) +
           " as its driver knows it, not within the " + PercentText(kZ95 * stated) +
           " of [[meter]] " + meter +
           "; write sigma_relative of this device into meters.toml if you know better"});
}

Result<TakenReading> ReadingSource::Finished(const Reading& frame, Result<devices::Summary> summary,
                                             Console& console) {
  if (!summary) return Propagate(std::move(summary));
  Warnings& warnings = summary->kept.warnings;
  const std::optional<double> guess = summary->kept.reading.sigma_relative;
  calibrations_.Apply(summary->kept.reading, warnings);
  HearSigma(frame.meter, guess, *summary);
  WarnOutOfRange(summary->kept.reading, warnings);
  for (const Warning& warning : warnings) {
    if (warned_.insert(warning.code + " " + warning.subject).second) console.Warn(warning);
  }
  TakenReading taken{PlacedIn(frame, summary->kept.reading), *std::move(summary)};
  if (auto checked = CheckReading(taken.reading); !checked) return Propagate(std::move(checked));
  return taken;
}

Result<void> ReadingSource::Finish(Console& console) {
  if (!meter_) return {};
  return meter_->Finish(console);
}

}  // namespace lightcal::app
