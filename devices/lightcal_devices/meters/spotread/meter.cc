// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/spotread/meter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/transport/process.h"

namespace lightcal::devices::spotread {
namespace {

using std::chrono::milliseconds;

constexpr std::string_view kModel = "ArgyllCMS";
constexpr int kSlicesPerReply = 4;  // so that Ctrl-C is seen in time
constexpr int kSilentReplies = 60;  // it lists the ports and talks to each before it measures
constexpr int kMostReads = 20000;   // of one run
constexpr int kMostRuns = 4;        // one for a colorimeter, two that calibrate, one that reads
constexpr int kMostCalibrations = 2;
constexpr int kMostPrompts = 3;
constexpr std::size_t kLongestOutput = 262144;
constexpr std::size_t kReadBytes = 4096;
constexpr std::string_view kGiveUp = "q\n";

std::string Quoted(std::string_view text, Ending ending) {
  const std::string line = TellingLine(text, ending);
  return line.empty() ? "spotread said nothing" : "spotread said: " + line;
}

bool IsYes(std::string_view value) {
  constexpr std::array<std::string_view, 4> kYes = {"yes", "1", "true", "on"};
  return std::ranges::find(kYes, value) != kYes.end();
}

bool IsNo(std::string_view value) {
  constexpr std::array<std::string_view, 4> kNo = {"no", "0", "false", "off"};
  return std::ranges::find(kNo, value) != kNo.end();
}

bool IsPortNumber(std::string_view value) {
  return !value.empty() && value.size() <= 3 && value.front() != '0' &&
         std::ranges::all_of(value, [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

Result<void> SpotreadMeter::ReadOptions() {
  if (options_read_) return {};
  for (const auto& [name, value] : options_) {
    if (name == "port") {
      if (!IsPortNumber(value)) {
        return WrongUsage("{meter.option} port=" + value,
                          "give a number of the list spotread -? prints");
      }
      chosen_.insert(chosen_.end(), {"-c", value});
    } else if (name == "ccss") {
      if (value.empty() || value.find_first_of("\n\r") != std::string::npos ||
          value.find('\0') != std::string::npos) {
        return WrongUsage("{meter.option} ccss", "give a .ccss or .ccmx file");
      }
      chosen_.insert(chosen_.end(), {"-X", value});
    } else if (name == "hires") {
      if (!IsYes(value) && !IsNo(value)) {
        return WrongUsage("{meter.option} hires=" + value, "give yes or no");
      }
      if (IsYes(value)) chosen_.emplace_back("-H");
    } else if (name == "spotread") {
      auto set = transport_.Control("program", AsBytes(value), 0, timing_.reply);
      if (!set) return Propagate(std::move(set));
    }
  }
  options_read_ = true;
  return {};
}

Result<MeterIdentity> SpotreadMeter::Identify() {
  if (auto read = ReadOptions(); !read) return tl::unexpected(read.error());
  return MeterIdentity{std::string(kModel), "", {}};
}

std::vector<std::string> SpotreadMeter::Arguments() const {
  std::vector<std::string> arguments = {"-v", "-a", "-x", "-T"};
  if (with_spectrum_) arguments.emplace_back("-s");
  arguments.insert(arguments.end(), chosen_.begin(), chosen_.end());
  arguments.emplace_back("-O");  // last: a word behind it would be a file to write
  return arguments;
}

void SpotreadMeter::Stop() { static_cast<void>(transport_.Control("stop", {}, 0, timing_.reply)); }

Result<bool> SpotreadMeter::Answer(Situation situation) {
  if (situation == Situation::kWrongPosition || ++prompts_ > kMostPrompts) return false;
  const auto given_up = transport_.Write(AsBytes(kGiveUp), timing_.reply);
  if (!given_up && given_up.error().code != fault::kEnded) {
    return tl::unexpected(given_up.error());
  }
  return true;
}

Result<std::string> SpotreadMeter::Listen(const Cancellation& cancellation) {
  const milliseconds slice = std::max(timing_.reply / kSlicesPerReply, milliseconds(1));
  std::string text;
  std::size_t heard = 0;  // up to where `text` was looked at for prompts
  int silent = 0;
  prompts_ = 0;
  for (int reads = 0; reads < kMostReads && text.size() < kLongestOutput; ++reads) {
    if (cancellation.Requested()) {
      return Failed("interrupted", std::string(kModel), "stopped by you; spotread was ended");
    }
    const auto bytes = transport_.Read(kReadBytes, slice);
    if (!bytes && bytes.error().code == fault::kEnded) return text;
    if (!bytes && bytes.error().code != fault::kTimeout) return tl::unexpected(bytes.error());
    if (!bytes) {
      if (++silent < kSlicesPerReply * kSilentReplies) continue;
      return Failed(std::string(fault::kTimeout), std::string(kModel),
                    "spotread answered nothing for long; unplug other USB-serial adapters (it "
                    "talks to each), or name the instrument's port: {meter.option} port=1");
    }
    silent = 0;
    text.append(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    for (auto now = NextSituation(text, heard); now != Situation::kNone;
         now = NextSituation(text, heard)) {
      const auto goes_on = Answer(now);
      if (!goes_on) return tl::unexpected(goes_on.error());
      if (!*goes_on) return text;
    }
  }
  return Failed(std::string(kBadReply), std::string(kModel),
                "spotread printed without end; " + Quoted(text, Ending::kUnknown));
}

Result<std::string> SpotreadMeter::RunOnce(const Cancellation& cancellation) {
  const auto started = transport_.Control("start", StartArguments(Arguments()), 0, timing_.reply);
  if (!started && started.error().code == fault::kNoDevice) {
    return Failed(std::string(fault::kNoDevice), transport_.Name(),
                  "is not there; install ArgyllCMS (apt install argyll), or give its path: "
                  "{meter.option} spotread=PATH");
  }
  if (!started) return tl::unexpected(started.error());
  auto text = Listen(cancellation);
  Stop();
  return text;
}

tl::unexpected<Error> SpotreadMeter::Explain(Ending ending, std::string_view text) const {
  const std::string subject(kModel);
  switch (ending) {
    case Ending::kNoAmbient:
      return Failed("no_ambient", subject,
                    "this instrument has no ambient head, so it cannot measure lux; use another");
    case Ending::kPlacedToCalibrate:
      return Failed("calibrated", subject,
                    "the instrument had to be calibrated first: " + CalibrationInstructions(text) +
                        ". Do so and read again; then turn its ambient head to the light and read");
    case Ending::kCalibrated:
      return Failed("calibrated", subject,
                    "the instrument asks for a calibration again and again; calibrate it with "
                    "spotread itself, then read again");
    case Ending::kWrongPosition:
      return Failed("wrong_position", subject,
                    "its dial is in the wrong position; turn it to ambient light and read again");
    case Ending::kTooDark:
      return Failed(
          "too_dark", subject,
          "there is too little light for a colour temperature, and spotread then gives no "
          "illuminance either; move closer");
    case Ending::kSaturated:
      return Refused(
          "over_range", subject,
          "the light is above the instrument's range; move back (" + Quoted(text, ending) + ")");
    case Ending::kMisread:
      return Failed("misread", subject,
                    "the instrument misread; hold the light steady and read again (" +
                        Quoted(text, ending) + ")");
    case Ending::kCommunication:
      return Failed("communication", subject,
                    "spotread lost the instrument; plug it in again and read again");
    case Ending::kNoInstrument:
      return Failed(std::string(fault::kNoDevice), subject,
                    "spotread finds no instrument it knows; plug it in, see whether this version "
                    "of ArgyllCMS knows it, or name its port: {meter.option} port=1");
    case Ending::kNoConnection:
      return Failed("communication", subject,
                    "the instrument is there but does not answer; close other programs that use it "
                    "and see {FindMeters} for its permission (" +
                        Quoted(text, ending) + ")");
    case Ending::kBadOption:
      return WrongUsage("{meter.option} ccss", Quoted(text, ending));
    case Ending::kFatal:
      return Failed("instrument_error", subject, Quoted(text, ending) + "; plug it in again");
    case Ending::kNoSpectrum:
    case Ending::kUnknown:
      break;
  }
  return Failed(std::string(kBadReply), subject,
                "spotread ended without a reading; " + Quoted(text, ending));
}

Result<Report> SpotreadMeter::Measured(const Cancellation& cancellation, Warnings& warnings) {
  int calibrations = 0;
  std::string text;
  for (int run = 0; run < kMostRuns; ++run) {
    auto printed = RunOnce(cancellation);
    if (!printed) return Propagate(std::move(printed));
    text = *std::move(printed);
    const Ending ending = EndingOf(text);
    // A result of the same run was read where the person had put it to calibrate.
    if (ending == Ending::kPlacedToCalibrate) return Explain(ending, text);
    auto report = DecodeReport(text);
    if (!report || report->illuminance_lx) return report;
    if (ending == Ending::kNoSpectrum && with_spectrum_) {
      with_spectrum_ = false;
    } else if (ending == Ending::kCalibrated && calibrations < kMostCalibrations) {
      ++calibrations;
      if (calibrations == 1) {
        warnings.push_back({"calibrated", std::string(kModel),
                            "the instrument calibrated itself before the reading"});
      }
    } else {
      return Explain(ending, text);
    }
  }
  return Explain(EndingOf(text), text);
}

std::string SpotreadMeter::DeviceName(const Report& report) const {
  if (!report.serial.empty()) return "spotread:" + report.serial;
  return "spotread:" + (serial_.empty() ? std::string(kModel) : serial_);
}

Result<MeterReading> SpotreadMeter::Measure(const Cancellation& cancellation) {
  if (auto read = ReadOptions(); !read) return tl::unexpected(read.error());
  Warnings warnings;
  const auto report = Measured(cancellation, warnings);
  if (!report) return tl::unexpected(report.error());
  if (*report->illuminance_lx <= 0.0) return Explain(Ending::kTooDark, "");
  MeterReading reading = ReadingFromReport(*report, DeviceName(*report));
  reading.warnings.insert(reading.warnings.begin(), warnings.begin(), warnings.end());
  return reading;
}

std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup) {
  return std::make_unique<SpotreadMeter>(transport, setup);
}

}  // namespace lightcal::devices::spotread
