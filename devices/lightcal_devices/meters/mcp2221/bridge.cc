// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/mcp2221/bridge.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <string>

namespace lightcal::devices::mcp2221 {
namespace {

constexpr std::chrono::milliseconds kPause(1);
constexpr int kPolls = 50;
constexpr int kPrepareTries = 3;

std::string Named(i2c::Address address) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "I2C 0x%02x", static_cast<unsigned>(address));
  return text.data();
}

tl::unexpected<Error> Nack(i2c::Address address) {
  return Failed(std::string(i2c::kNack), Named(address),
                "no chip answers there; check the wires (SDA, SCL, power) and the address");
}

tl::unexpected<Error> BusFault(i2c::Address address, unsigned engine) {
  if (engine == kEngineAddressNack) return Nack(address);
  return Failed("bus_fault", Named(address), std::string(EngineFault(engine)));
}

tl::unexpected<Error> StillBusy(i2c::Address address) {
  return Failed(std::string(fault::kBusy), Named(address),
                "the bridge's I2C engine is still busy after " + std::to_string(kPolls) +
                    " questions; check the wires, then unplug the bridge and plug it in");
}

// Nobody is there to be freed.
bool IsLineGone(const Error& error) {
  return error.code == fault::kUnplugged || error.code == fault::kTapeEnded ||
         error.code == fault::kTapeMismatch;
}

}  // namespace

Result<Bytes> Bridge::Exchange(const Bytes& request) {
  if (auto sent = transport_.Write(request, timing_.reply); !sent) {
    return tl::unexpected(sent.error());
  }
  return transport_.Read(kReportBytes, timing_.reply);
}

Result<Status> Bridge::AskStatus(const Bytes& request) {
  const auto reply = Exchange(request);
  if (!reply) return tl::unexpected(reply.error());
  return DecodeStatus(*reply);
}

template <class Answer>
Answer Bridge::FreedAfter(Answer answer) {
  if (answer || IsLineGone(answer.error())) return answer;
  // The failure stands, whatever the bridge says to this.
  static_cast<void>(AskStatus(EncodeCancel()));
  return answer;
}

Result<void> Bridge::Prepare() {
  auto status = AskStatus(EncodeStatus());
  for (int i = 0; i < kPrepareTries && status && status->engine != kEngineIdle; ++i) {
    status = AskStatus(EncodeCancel());
    timing_.Pause(kPause);
    if (status) status = AskStatus(EncodeStatus());
  }
  if (!status) return tl::unexpected(status.error());
  for (int i = 0; i < kPrepareTries; ++i) {
    status = AskStatus(EncodeSpeed(kDivider100kHz));
    if (!status) return tl::unexpected(status.error());
    if (status->speed_taken) return {};
    if (auto freed = AskStatus(EncodeCancel()); !freed) return tl::unexpected(freed.error());
    timing_.Pause(kPause);
  }
  return Failed(std::string(fault::kBusy), "MCP2221",
                "the bridge does not take a speed: its I2C bus is stuck; check the wires, then "
                "unplug it and plug it in");
}

Result<void> Bridge::Start(const Bytes& request, Command command, i2c::Address address) {
  for (int i = 0; i < kPolls; ++i) {
    const auto reply = Exchange(request);
    if (!reply) return tl::unexpected(reply.error());
    const auto acceptance = DecodeAcceptance(*reply, command);
    if (!acceptance) return tl::unexpected(acceptance.error());
    if (acceptance->accepted) return {};
    if (!EngineFault(acceptance->engine).empty()) return BusFault(address, acceptance->engine);
    timing_.Pause(kPause);
  }
  return StillBusy(address);
}

Result<void> Bridge::WaitFor(unsigned state, i2c::Address address) {
  for (int i = 0; i < kPolls; ++i) {
    const auto status = AskStatus(EncodeStatus());
    if (!status) return tl::unexpected(status.error());
    if (status->address_nack) return Nack(address);
    if (status->engine == state || status->engine == kEngineIdle) return {};
    if (!EngineFault(status->engine).empty()) return BusFault(address, status->engine);
    timing_.Pause(kPause);
  }
  return StillBusy(address);
}

Result<Bytes> Bridge::Fetch(std::size_t count, i2c::Address address) {
  for (int i = 0; i < kPolls; ++i) {
    const auto reply = Exchange(EncodeFetch());
    if (!reply) return tl::unexpected(reply.error());
    auto bytes = DecodeFetched(*reply);
    if (!bytes) return Propagate(std::move(bytes));
    if (*bytes && (*bytes)->size() == count) return **std::move(bytes);
    const auto status = AskStatus(EncodeStatus());
    if (!status) return tl::unexpected(status.error());
    if (status->address_nack) return Nack(address);
    if (!EngineFault(status->engine).empty()) return BusFault(address, status->engine);
    timing_.Pause(kPause);
  }
  return StillBusy(address);
}

Result<void> Bridge::Write(i2c::Address address, std::span<const std::byte> bytes) {
  auto done = Start(EncodeWrite(Command::kWrite, address, bytes), Command::kWrite, address);
  if (done) done = WaitFor(kEngineIdle, address);
  return FreedAfter(std::move(done));
}

Result<Bytes> Bridge::Read(i2c::Address address, std::size_t count) {
  const auto started = Start(EncodeRead(Command::kRead, address, count), Command::kRead, address);
  return FreedAfter(started ? Fetch(count, address)
                            : Result<Bytes>(tl::unexpected(started.error())));
}

Result<Bytes> Bridge::WriteThenRead(i2c::Address address, std::span<const std::byte> bytes,
                                    std::size_t count) {
  auto started =
      Start(EncodeWrite(Command::kWriteNoStop, address, bytes), Command::kWriteNoStop, address);
  if (started) started = WaitFor(kEngineWroteNoStop, address);
  if (started) {
    started = Start(EncodeRead(Command::kReadRepeatedStart, address, count),
                    Command::kReadRepeatedStart, address);
  }
  return FreedAfter(started ? Fetch(count, address)
                            : Result<Bytes>(tl::unexpected(started.error())));
}

}  // namespace lightcal::devices::mcp2221
