// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/sekonic/meter.h"

#include <algorithm>
#include <array>
#include <utility>

#include "lightcal_devices/meters/frame_search.h"
#include "lightcal_devices/meters/sekonic/reading.h"

namespace lightcal::devices::sekonic {
namespace {

constexpr std::array<std::string_view, 4> kKnownModels = {"C-700", "C-800", "C-800-U", "C-7000"};
constexpr std::string_view kModelWithSetUp = "C-7000";
constexpr int kFirstFirmwareWithShutter = 26;
constexpr int kLongestDrain = 8;
constexpr int kDarkPatience = 4;

// Errors after which the line may still hold a reply nobody waits for.
bool MayLeaveReply(const Error& error) {
  return error.code == kBadReply || error.code == fault::kTimeout ||
         error.code == fault::kStalled || error.code == fault::kIo;
}

tl::unexpected<Error> InCommand(std::string_view command, Error error) {
  error.message = std::string(command) + ": " + error.message;
  return tl::unexpected(std::move(error));
}

}  // namespace

std::string SekonicMeter::DeviceName() const {
  return "sekonic:" + (serial_.empty() ? model_ : serial_);
}

Result<Bytes> SekonicMeter::ReadReply() {
  return transport_.Read(kLongestReplyBytes, timing_.reply);
}

Result<Bytes> SekonicMeter::Exchange(std::string_view command) {
  if (auto sent = transport_.Write(AsBytes(command), timing_.reply); !sent) {
    return InCommand(command, sent.error());
  }
  const auto acknowledge = ReadReply();
  if (!acknowledge) return InCommand(command, acknowledge.error());
  if (auto accepted = DecodeAcknowledge(*acknowledge); !accepted) {
    return InCommand(command, accepted.error());
  }
  auto reply = ReadReply();
  if (!reply) return InCommand(command, reply.error());
  if (auto echo = CheckEcho(*reply, command); !echo) return InCommand(command, echo.error());
  return reply;
}

Result<void> SekonicMeter::Order(std::string_view command) {
  if (auto reply = Exchange(command); !reply) return tl::unexpected(reply.error());
  return {};
}

template <class Decode>
auto SekonicMeter::Ask(std::string_view command, Decode decode) -> decltype(decode(Bytes())) {
  const auto once = [&]() -> decltype(decode(Bytes())) {
    const auto reply = Exchange(command);
    if (!reply) return tl::unexpected(reply.error());
    return decode(*reply);
  };
  auto answer = once();
  if (answer || answer.error().code != kBadReply) return answer;
  Drain();
  return once();
}

void SekonicMeter::Drain() {
  for (int i = 0; i < kLongestDrain; ++i) {
    if (!transport_.Read(kLongestReplyBytes, timing_.drain)) return;
  }
}

Result<MeterIdentity> SekonicMeter::Identify() {
  auto model = Ask("MN", DecodeModel);
  if (!model) return Propagate(std::move(model));
  model_ = *model;
  MeterIdentity identity{model_, "", {}};
  if (std::ranges::find(kKnownModels, model_) == kKnownModels.end()) {
    identity.warnings.push_back({"untested_model", DeviceName(),
                                 "is a " + model_ +
                                     ", a model this driver was never tried with; please send a "
                                     "tape ({meter.tape})"});
  }
  return identity;
}

Result<void> SekonicMeter::CheckUsable(const State& state) const {
  if (state.activity == Activity::kHardwareError) {
    return Failed(
        "hardware_error", DeviceName(),
        "the meter reports a hardware error; switch it off and on, then have it serviced");
  }
  if (state.ring != Ring::kLow) {
    return Failed("wrong_ring", DeviceName(),
                  "the ring of the light receptor is " + std::string(RingName(state.ring)) +
                      "; turn it to LOW and try again");
  }
  if (state.measure_button_held) {
    return Failed("button_held", DeviceName(),
                  "the measuring button is pressed; let it go and try again");
  }
  return {};
}

Result<void> SekonicMeter::WaitUntilIdle(int polls, const Cancellation& cancellation) {
  std::string doing;
  int dark = 0;
  for (int i = 0; i - dark < polls && dark < kDarkPatience * polls; ++i) {
    if (cancellation.Requested()) {
      return Failed("interrupted", DeviceName(), "stopped by you; the meter is released");
    }
    if (i > 0) timing_.Pause(timing_.poll);
    const auto state = Ask("ST", DecodeState);
    if (!state) return tl::unexpected(state.error());
    if (auto usable = CheckUsable(*state); !usable) return usable;
    if (state->activity == Activity::kIdle) return {};
    doing = state->doing;
    if (state->calibrating_dark) ++dark;
    calibrated_dark_ = calibrated_dark_ || state->calibrating_dark;
  }
  return Failed(std::string(fault::kBusy), DeviceName(),
                "still " + doing + " after " + std::to_string(polls + dark) +
                    " questions; wait until its display is idle and try again");
}

// Field of view 2 deg, ambient mode, automatic exposure, shutter 1/125 s.
Result<void> SekonicMeter::SetUpC7000() {
  const auto firmware = Ask("FV", DecodeFirmware);
  if (!firmware) return tl::unexpected(firmware.error());
  for (const std::string_view command : {"AGw,0", "MMw,0", "AMw,0"}) {
    if (auto done = Order(command); !done) return done;
  }
  if (firmware->main < kFirstFirmwareWithShutter) return {};
  return Order("SSw,0,08");
}

Result<Measurement> SekonicMeter::MeasureRemotely(const Cancellation& cancellation) {
  if (auto on = Order("RT1"); !on) return tl::unexpected(on.error());
  if (model_ == kModelWithSetUp) {
    if (auto done = SetUpC7000(); !done) return tl::unexpected(done.error());
  }
  if (auto started = Order("RM0"); !started) return tl::unexpected(started.error());
  if (auto idle = WaitUntilIdle(timing_.measure_polls, cancellation); !idle) {
    return tl::unexpected(idle.error());
  }
  return Ask("NR", DecodeMeasurement);
}

Result<MeterReading> SekonicMeter::Measure(const Cancellation& cancellation) {
  if (model_.empty()) {
    if (auto identity = Identify(); !identity) return Propagate(std::move(identity));
  }
  calibrated_dark_ = false;
  if (auto idle = WaitUntilIdle(timing_.ready_polls, cancellation); !idle) {
    return tl::unexpected(idle.error());
  }
  const auto measurement = MeasureRemotely(cancellation);
  if (!measurement && IsGone(measurement.error())) return tl::unexpected(measurement.error());
  if (!measurement && MayLeaveReply(measurement.error())) Drain();
  const auto restored = Order("RT0");
  if (!measurement) return tl::unexpected(measurement.error());
  MeterReading reading = ReadingFromMeasurement(*measurement, DeviceName());
  if (calibrated_dark_) {
    reading.warnings.push_back({"dark_calibration", DeviceName(),
                                "the meter calibrated its dark signal first, which takes longer"});
  }
  if (!restored) {
    reading.warnings.push_back({"not_restored", DeviceName(),
                                "remote control could not be switched off (" +
                                    restored.error().message + "); switch the meter off and on"});
  }
  return reading;
}

Result<MeterReading> SekonicMeter::ReadMemory(int index, const Cancellation& cancellation) {
  if (model_.empty()) {
    if (auto identity = Identify(); !identity) return Propagate(std::move(identity));
  }
  if (model_ != kModelWithSetUp) {
    return Refused("no_memory", DeviceName(),
                   "only the memory of a C-7000 can be read; export its readings to a file and "
                   "import that");
  }
  if (cancellation.Requested()) return Failed("interrupted", DeviceName(), "stopped by you");
  const auto stored = Ask("MI", DecodeMemoryInfo);
  if (!stored) return tl::unexpected(stored.error());
  if (index < 0 || index >= *stored) {
    return Refused("no_such_reading", DeviceName(),
                   "the memory holds " + std::to_string(*stored) + " readings, numbered from 0");
  }
  const auto measurement = Ask(StoredMeasurementCommand(index), DecodeStoredMeasurement);
  if (!measurement) return tl::unexpected(measurement.error());
  MeterReading reading = ReadingFromMeasurement(*measurement, DeviceName());
  reading.warnings.push_back({"experimental", DeviceName(),
                              "reading a C-7000's memory was never tried on one; compare with its "
                              "display, and please send a tape ({meter.tape})"});
  return reading;
}

std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup) {
  return std::make_unique<SekonicMeter>(transport, setup);
}

}  // namespace lightcal::devices::sekonic
