// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/gossen/meter.h"

#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/meters/display.h"
#include "lightcal_devices/meters/frame_search.h"

namespace lightcal::devices::gossen {
namespace {

constexpr std::chrono::milliseconds kAfterWrite{10};

bool AskingAgainMayHelp(const Error& error) {
  return error.code == kBadReply || error.code == "serial_error";
}

std::string AsIs(std::string line) { return line; }

}  // namespace

GossenMeter::GossenMeter(Transport& transport, const MeterSetup& setup)
    : transport_(transport), reader_(transport), timing_(setup.timing), serial_(setup.serial) {
  const auto accuracy = setup.options.find("class");
  if (accuracy != setup.options.end()) class_ = accuracy->second;
}

Result<std::string> GossenMeter::AskOnce(std::string_view command,
                                         std::chrono::milliseconds timeout) {
  const auto in_command = [&](Error error) {
    error.message = std::string(command) + ": " + error.message;
    return tl::unexpected(std::move(error));
  };
  const std::string line = std::string(command) + "\n";
  if (auto sent = transport_.Write(AsBytes(line), timing_.reply); !sent) {
    return in_command(sent.error());
  }
  timing_.Pause(kAfterWrite);
  const auto bytes = reader_.ReadUntil("\n", kLongestReplyBytes, timeout);
  if (!bytes) return in_command(bytes.error());
  std::string reply;
  for (const std::byte byte : *bytes) reply.push_back(static_cast<char>(byte));
  reply = TrimBlanks(reply);
  if (const auto number = DecodeError(reply)) return in_command(ErrorOf(*number, DeviceName()));
  return reply;
}

template <class Decode>
auto GossenMeter::Ask(std::string_view command, Decode decode, int timeouts)
    -> decltype(decode(std::string())) {
  const auto once = [&]() -> decltype(decode(std::string())) {
    auto reply = AskOnce(command, timing_.reply * timeouts);
    if (!reply) return tl::unexpected(reply.error());
    return decode(*std::move(reply));
  };
  auto answer = once();
  if (answer || !AskingAgainMayHelp(answer.error())) return answer;
  reader_.Drain(timing_.drain);
  return once();
}

Result<MeterIdentity> GossenMeter::Identify() {
  if (!class_.empty() && class_ != "B" && class_ != "C") {
    return WrongUsage("{meter.option} class=" + class_, "give the meter's accuracy class, B or C");
  }
  const auto echo = Ask("ECH ON", [](std::string line) { return Result<std::string>(AsIs(line)); });
  if (!echo) return tl::unexpected(echo.error());
  const auto identity = Ask("*IDN?", [](const std::string& line) { return DecodeIdentity(line); });
  if (!identity) return tl::unexpected(identity.error());
  if (serial_.empty()) serial_ = identity->serial;
  identified_ = true;
  return MeterIdentity{
      identity->serial.empty() ? identity->type : identity->serial, identity->firmware, {}};
}

// So that "over range" means above the highest one.
Result<void> GossenMeter::SetAutomaticRange() {
  const auto set = AskOnce("RAN:AUTO ON", timing_.reply);
  if (!set) return tl::unexpected(set.error());
  automatic_ = true;
  return {};
}

Result<MeterReading> GossenMeter::Measure(const Cancellation& cancellation) {
  if (!identified_) {
    if (auto identity = Identify(); !identity) return Propagate(std::move(identity));
  }
  if (!automatic_) {
    if (auto set = SetAutomaticRange(); !set) return Propagate(std::move(set));
  }
  if (cancellation.Requested()) return Interrupted(DeviceName());
  const auto shown = Ask(
      "?", [](const std::string& line) { return DecodeMeasurement(line); }, kMeasurementReplies);
  if (!shown && cancellation.Requested()) return Interrupted(DeviceName());
  const DisplayLimits limits = {class_ == "B" ? kSigmaRelativeClassB : kSigmaRelativeClassC,
                                kHighestIlluminanceLx};
  if (shown) return ReadingFromDisplay(*shown, limits, DeviceName());
  if (shown.error().code != "over_range") return tl::unexpected(shown.error());
  return OverRangeReading(limits.highest_lx, limits, DeviceName());
}

std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup) {
  return std::make_unique<GossenMeter>(transport, setup);
}

}  // namespace lightcal::devices::gossen
