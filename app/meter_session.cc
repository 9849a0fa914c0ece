// SPDX-License-Identifier: Apache-2.0
#include "meter_session.h"

#include <algorithm>
#include <sstream>
#include <thread>
#include <utility>

#include "clock.h"
#include "input_files.h"
#include "interrupt.h"
#include "lightcal_devices/transport/recording.h"
#include "lightcal_devices/transport/tape_codec.h"
#include "output_files.h"
#include "provenance_mark.h"

namespace lightcal::app {
namespace {

using devices::MeterOption;
using devices::MeterReading;
using devices::MeterSetup;
using devices::Transport;

// A driver's options, as a tape keeps them.
std::string SettingsText(const std::map<std::string, std::string>& settings) {
  std::string text;
  for (const auto& [name, value] : settings) {
    text += (text.empty() ? "" : "\n") + name + "=" + value;
  }
  return text;
}

// What was given on the command line counts before what a tape was recorded with.
void AddSettings(const std::string& text, std::map<std::string, std::string>& settings) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto equals = std::min(line.find('='), line.size());
    settings.emplace(line.substr(0, equals), line.substr(std::min(equals + 1, line.size())));
  }
}

// Before a meter is asked anything: its answers would be lost. Nothing here knows a --force.
Result<void> CheckRecordFile(const std::string& path) {
  if (path.empty()) return {};
  auto free = CheckOutputs({{path, std::string(kTapeFormat)}}, false);
  if (free || free.error().code != "exists") return free;
  return Failed("exists", path,
                "exists and is no tape of lightcal, which alone is replaced; name another file to "
                "record into");
}

}  // namespace

MeterSetup MeterSession::Setup() const {
  MeterSetup setup;
  setup.serial = serial_;
  setup.options = request_.settings;
  devices::MeterTiming& timing = setup.timing;
  timing.reply = request_.reply_timeout;
  timing.live = !IsReplay();
  return setup;
}

Result<void> MeterSession::OpenDevice() {
  const auto found = devices::FindMeters();
  if (!found) return tl::unexpected(found.error());
  const auto chosen = devices::ChooseMeter(*found, request_.device);
  if (!chosen) return tl::unexpected(chosen.error());
  auto line = devices::OpenMeter(*chosen);
  if (!line) return tl::unexpected(line.error());
  row_ = chosen->row;
  serial_ = chosen->serial;
  line_ = *std::move(line);
  return {};
}

Result<void> MeterSession::OpenTape() {
  const auto text = ReadInputFile(request_.replay_file);
  if (!text) return tl::unexpected(text.error());
  auto tape = devices::TapeFromText(*text, request_.replay_file);
  if (!tape) return tl::unexpected(tape.error());
  row_ = devices::FindDriver(tape->driver);
  if (row_ == nullptr) {
    return Refused("bad_tape", request_.replay_file,
                   "was recorded by the driver " + tape->driver +
                       ", which this lightcal does not have; see lightcal devices");
  }
  const auto colon = tape->device.find(':');
  if (colon != std::string::npos) serial_ = tape->device.substr(colon + 1);
  time_ = tape->recorded;
  AddSettings(tape->settings, request_.settings);
  auto replay = std::make_unique<devices::ReplayTransport>(*std::move(tape));
  replay_ = replay.get();
  line_ = std::move(replay);
  return {};
}

void MeterSession::Record() {
  if (request_.record_file.empty()) return;
  recorded_.driver = row_->driver;
  recorded_.recorded = time_;
  recorded_.settings = SettingsText(request_.settings);
  recorder_ = std::make_unique<devices::RecordingTransport>(*line_, recorded_);
}

Result<void> MeterSession::CheckSettings() const {
  for (const auto& [name, value] : request_.settings) {
    const auto known = std::ranges::find(row_->options, name, &MeterOption::name);
    if (known != row_->options.end()) continue;
    std::string list;
    for (const MeterOption& option : row_->options) {
      list += "\n  " + std::string(option.name) + "  " + std::string(option.help);
    }
    return WrongUsage("--set " + name, "the driver " + std::string(row_->driver) +
                                           (list.empty() ? " has no options" : " knows" + list));
  }
  return {};
}

Result<void> MeterSession::Identify(Console& console) {
  auto identity = meter_->Identify();
  if (!identity) return Propagate(std::move(identity));
  console.Warn(identity->warnings);
  recorded_.device =
      std::string(row_->driver) + ":" + (serial_.empty() ? identity->model : serial_);
  return {};
}

Result<std::unique_ptr<MeterSession>> MeterSession::Open(const MeterRequest& request,
                                                         Console& console) {
  if (auto free = CheckRecordFile(request.record_file); !free) return Propagate(std::move(free));
  std::unique_ptr<MeterSession> session(new MeterSession(request, NowIso8601()));
  const auto opened = request.replay_file.empty() ? session->OpenDevice() : session->OpenTape();
  if (!opened) return tl::unexpected(opened.error());
  if (auto checked = session->CheckSettings(); !checked) return tl::unexpected(checked.error());
  session->Record();
  Transport& line = session->recorder_ ? *session->recorder_ : *session->line_;
  session->meter_ = session->row_->make(line, session->Setup());
  if (const auto known = session->Identify(console); !known) {
    const auto written = session->Finish(console);
    return tl::unexpected(written ? known.error() : written.error());
  }
  return session;
}

Result<MeterReading> MeterSession::Measure() {
  const InterruptGuard guard;
  auto measured = meter_->Measure(InterruptGuard::StopRequest());
  if (!measured) return measured;
  Reading& reading = measured->reading;
  reading.time = IsReplay() ? time_ : MomentIso8601();
  return measured;
}

void MeterSession::Pause(std::chrono::milliseconds time) {
  if (IsReplay() || time.count() == 0) return;
  std::this_thread::sleep_for(time);
  DropBacklog();
}

void MeterSession::DropBacklog() {
  if (!IsReplay()) line_->Paused();
}

Result<MeterReading> MeterSession::ReadMemory(int index) {
  const InterruptGuard guard;
  return meter_->ReadMemory(index, InterruptGuard::StopRequest());
}

Result<void> MeterSession::Finish(Console& console) {
  if (IsReplay() && replay_->Unconsumed() > 0) {
    console.Warn({"tape_not_finished", request_.replay_file,
                  std::to_string(replay_->Unconsumed()) +
                      " exchanges of the tape were not played; it holds more than was asked for"});
  }
  if (request_.record_file.empty() || recorded_.exchanges.empty()) return {};
  return WriteOutputs({{request_.record_file, devices::TapeToText(recorded_)}}, false);
}

}  // namespace lightcal::app
