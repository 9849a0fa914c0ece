// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/konica/meter.h"

#include <algorithm>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/meters/frame_search.h"
#include "lightcal_devices/meters/konica/reading.h"

namespace lightcal::devices::konica {
namespace {

using std::chrono::milliseconds;

constexpr int kReadEvXy = 2;
constexpr int kReadEvCct = 8;
constexpr int kReadEv = 10;
constexpr int kMeasure = 40;
constexpr int kConnect = 54;
constexpr int kHoldOrRun = 55;

constexpr std::string_view kHold = "1  0";
constexpr std::string_view kRun = "0  0";
constexpr std::string_view kExternalMode = "10  ";
constexpr std::string_view kStart = "21  ";
constexpr std::string_view kColorConditions = "1200";
// Running, colour correction factors on, automatic range.
constexpr std::string_view kT10aConditions = "0200";

constexpr milliseconds kAfterConnect{500};
constexpr milliseconds kAfterHold{500};
constexpr milliseconds kAfterExternalMode{125};
constexpr milliseconds kMeasuring{500};
constexpr milliseconds kAutoRange{3000};
constexpr milliseconds kSlice{100};  // Ctrl-C waits no longer

}  // namespace

Link::Link(Transport& transport, const MeterSetup& setup, std::string_view driver,
           std::string_view model)
    : transport_(transport), reader_(transport), timing_(setup.timing), model_(model) {
  const auto head = setup.options.find("head");
  if (head != setup.options.end()) head_text_ = head->second;
  device_ = std::string(driver) + ":" + (setup.serial.empty() ? model_ : setup.serial);
}

tl::unexpected<Error> Link::InCommand(int command, Error error) const {
  error.message = "command " + std::to_string(command) + ": " + error.message;
  error.subject = device_;
  return tl::unexpected(std::move(error));
}

Result<void> Link::Send(int head, int command, std::string_view parameters) {
  const auto sent =
      transport_.Write(AsBytes(EncodeCommand(head, command, parameters)), timing_.reply);
  if (!sent) return InCommand(command, sent.error());
  return {};
}

Result<void> Link::Connect() {
  head_ = 0;
  if (!head_text_.empty()) {
    const auto head = ParseNumber(head_text_);
    if (!head || *head < 0 || *head > kHighestHead || *head != static_cast<int>(*head)) {
      return WrongUsage("{meter.option} head=" + head_text_, "give a receptor head from 0 to 29");
    }
    head_ = static_cast<int>(*head);
  }
  const auto connected = Order(kConnect, "1   ");
  if (!connected) return tl::unexpected(connected.error());
  timing_.Pause(kAfterConnect);
  return {};
}

Result<Condition> Link::Order(int command, std::string_view parameters) {
  // The body, head 0, takes the connection for all heads.
  const int head = command == kConnect ? 0 : head_;
  if (auto sent = Send(head, command, parameters); !sent) return tl::unexpected(sent.error());
  const auto reply = reader_.ReadUntil("\r\n", kShortReplyBytes, timing_.reply);
  if (!reply) return InCommand(command, reply.error());
  auto condition = DecodeShortReply(*reply, head, command);
  if (!condition) return InCommand(command, condition.error());
  return condition;
}

Result<void> Link::Announce(int command, std::string_view parameters, milliseconds pause) {
  if (auto sent = Send(kAllHeads, command, parameters); !sent) return sent;
  timing_.Pause(pause);
  reader_.Drain(timing_.drain);
  return {};
}

Result<LongReply> Link::AskOnce(int command, std::string_view parameters) {
  if (auto sent = Send(head_, command, parameters); !sent) return tl::unexpected(sent.error());
  const auto bytes = reader_.ReadUntil("\r\n", kLongReplyBytes, timing_.reply);
  if (!bytes) return InCommand(command, bytes.error());
  auto reply = DecodeLongReply(*bytes, head_, command);
  if (!reply) return InCommand(command, reply.error());
  return reply;
}

Result<LongReply> Link::Ask(int command, std::string_view parameters) {
  auto reply = AskOnce(command, parameters);
  if (!reply && reply.error().code == kBadReply) {
    reader_.Drain(timing_.drain);
    reply = AskOnce(command, parameters);
  }
  if (!reply) return reply;
  switch (reply->status.condition) {
    case Condition::kHeadPowerOff:
      return Failed("head_power_off", device_,
                    "the receptor head has no power; switch the meter off and on");
    case Condition::kMemoryError:
      return Failed("memory_error", device_,
                    "the meter reports a fault of its memory; switch it off and on, then have it "
                    "serviced");
    default:
      break;
  }
  if (reply->status.battery_low) {
    return Failed("battery_low", device_,
                  "the battery is too low for a measurement to be believed; change it");
  }
  return reply;
}

Result<void> Link::Wait(milliseconds duration, const Cancellation& cancellation) const {
  while (!cancellation.Requested()) {
    if (duration <= milliseconds(0)) return {};
    timing_.Pause(std::min(duration, kSlice));
    duration -= kSlice;
  }
  return Interrupted(device_);
}

Result<MeterIdentity> T10aMeter::Identify() {
  if (auto connected = link_.Connect(); !connected) return tl::unexpected(connected.error());
  connected_ = true;
  return MeterIdentity{link_.model(), "", {}};
}

Result<MeterReading> T10aMeter::Measure(const Cancellation& cancellation) {
  if (!connected_) {
    if (auto identity = Identify(); !identity) return Propagate(std::move(identity));
  }
  if (!ranged_) {
    if (auto set = link_.Ask(kReadEv, kT10aConditions); !set) return Propagate(std::move(set));
    if (auto waited = link_.Wait(kAutoRange, cancellation); !waited) {
      return Propagate(std::move(waited));
    }
    ranged_ = true;
  }
  if (auto waited = link_.Wait(milliseconds(0), cancellation); !waited) {
    return Propagate(std::move(waited));
  }
  const auto reply = link_.Ask(kReadEv, kT10aConditions);
  if (!reply && cancellation.Requested()) return Interrupted(link_.device());
  if (!reply) return tl::unexpected(reply.error());
  return ReadingFromT10a(*reply, link_.device());
}

Result<MeterIdentity> Cl200aMeter::Identify() {
  if (auto connected = link_.Connect(); !connected) return tl::unexpected(connected.error());
  connected_ = true;
  return MeterIdentity{link_.model(), "", {}};
}

Result<void> Cl200aMeter::Hold(const Cancellation& cancellation) {
  if (auto held = link_.Announce(kHoldOrRun, kHold, kAfterHold); !held) return held;
  return link_.Wait(milliseconds(0), cancellation);
}

Result<void> Cl200aMeter::SetExternalMode(const Cancellation& cancellation) {
  auto taken = link_.Order(kMeasure, kExternalMode);
  if (taken && *taken == Condition::kExtRefused) {
    if (auto held = Hold(cancellation); !held) return held;
    taken = link_.Order(kMeasure, kExternalMode);
  }
  if (!taken) return tl::unexpected(taken.error());
  if (*taken == Condition::kExtRefused) {
    return Failed("ext_refused", link_.device(),
                  "the meter does not let itself be measured from outside; leave its menu, release "
                  "its buttons and try again");
  }
  return link_.Wait(kAfterExternalMode, cancellation);
}

Result<MeterReading> Cl200aMeter::MeasureHeld(const Cancellation& cancellation) {
  if (auto held = Hold(cancellation); !held) return Propagate(std::move(held));
  if (auto set = SetExternalMode(cancellation); !set) return Propagate(std::move(set));
  if (auto measured = link_.Announce(kMeasure, kStart, kMeasuring); !measured) {
    return Propagate(std::move(measured));
  }
  if (auto waited = link_.Wait(milliseconds(0), cancellation); !waited) {
    return Propagate(std::move(waited));
  }
  const auto chromaticity = link_.Ask(kReadEvXy, kColorConditions);
  if (!chromaticity) return tl::unexpected(chromaticity.error());
  const auto temperature = link_.Ask(kReadEvCct, kColorConditions);
  if (!temperature) return tl::unexpected(temperature.error());
  return ReadingFromCl200a(*chromaticity, *temperature, link_.device());
}

Result<MeterReading> Cl200aMeter::Measure(const Cancellation& cancellation) {
  if (!connected_) {
    if (auto identity = Identify(); !identity) return Propagate(std::move(identity));
  }
  auto reading = MeasureHeld(cancellation);
  if (!reading && IsGone(reading.error())) return reading;
  const auto running = link_.Announce(kHoldOrRun, kRun, milliseconds(0));
  if (reading && !running) {
    reading->warnings.push_back({"not_restored", link_.device(),
                                 "the meter could not be set running again (" +
                                     running.error().message + "); switch it off and on"});
  }
  // A wait that Ctrl-C cut short ended as a timeout.
  if (!reading && cancellation.Requested()) return Interrupted(link_.device());
  return reading;
}

std::unique_ptr<Meter> MakeT10a(Transport& transport, const MeterSetup& setup) {
  return std::make_unique<T10aMeter>(transport, setup);
}

std::unique_ptr<Meter> MakeCl200a(Transport& transport, const MeterSetup& setup) {
  return std::make_unique<Cl200aMeter>(transport, setup);
}

}  // namespace lightcal::devices::konica
