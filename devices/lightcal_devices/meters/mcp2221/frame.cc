// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/mcp2221/frame.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace lightcal::devices::mcp2221 {
namespace {

using ByteSpan = std::span<const std::byte>;

constexpr std::byte kCancel{0x10};
constexpr std::byte kSetSpeed{0x20};
constexpr unsigned kSpeedTaken = 0x20;
constexpr unsigned kAddressNackBit = 0x40;
constexpr unsigned kPartialData = 0x41;
constexpr unsigned kReadComplete = 0x55;
constexpr unsigned kReadPartial = 0x54;
constexpr unsigned kNoCount = 0x7F;

tl::unexpected<Error> BadReply(const std::string& what) {
  return Failed(std::string(kBadReply), "MCP2221",
                what + "; try again, then unplug the bridge and plug it in");
}

// The report's number, then the command and zeros.
Bytes Request(Command command) {
  Bytes report(1 + kReportBytes);
  report[1] = static_cast<std::byte>(command);
  return report;
}

void PutAddressed(Bytes& report, std::size_t count, std::uint8_t address_byte) {
  report[2] = static_cast<std::byte>(count & 0xFFU);
  report[3] = static_cast<std::byte>((count >> 8U) & 0xFFU);
  report[4] = static_cast<std::byte>(address_byte);
}

Result<void> CheckReply(ByteSpan reply, Command command) {
  if (reply.size() != kReportBytes) {
    return BadReply("a report of " + std::to_string(reply.size()) + " bytes, not 64");
  }
  if (reply[0] != static_cast<std::byte>(command)) {
    return BadReply("the answer to another command");
  }
  return {};
}

unsigned At(ByteSpan reply, std::size_t index) { return std::to_integer<unsigned>(reply[index]); }

}  // namespace

Bytes EncodeStatus() { return Request(Command::kStatus); }

Bytes EncodeCancel() {
  Bytes report = Request(Command::kStatus);
  report[3] = kCancel;
  return report;
}

Bytes EncodeSpeed(std::uint8_t divider) {
  Bytes report = Request(Command::kStatus);
  report[4] = kSetSpeed;
  report[5] = static_cast<std::byte>(divider);
  return report;
}

Bytes EncodeWrite(Command command, std::uint8_t address, ByteSpan bytes) {
  Bytes report = Request(command);
  const std::size_t count = std::min(bytes.size(), kMostDataBytes);
  PutAddressed(report, count, static_cast<std::uint8_t>(address << 1U));
  std::copy_n(bytes.begin(), count, report.begin() + 5);
  return report;
}

Bytes EncodeRead(Command command, std::uint8_t address, std::size_t count) {
  Bytes report = Request(command);
  PutAddressed(report, count, static_cast<std::uint8_t>(address << 1U | 1U));
  return report;
}

Bytes EncodeFetch() { return Request(Command::kFetch); }

std::string_view EngineFault(unsigned state) {
  switch (state) {
    case 0x12:
      return "no start condition: the bus is held low; check the wires and pull-up resistors";
    case 0x17:
      return "no repeated start: the bus is held low; check the wires and pull-up resistors";
    case 0x23:
      return "the address timed out; check the wires and pull-up resistors";
    case kEngineAddressNack:
      return "no chip answers at the address";
    case 0x44:
      return "writing timed out; check the wires";
    case 0x52:
      return "reading timed out; check the wires";
    case 0x62:
      return "no stop condition: the bus is held low; check the wires";
    default:
      return "";
  }
}

Result<Status> DecodeStatus(ByteSpan reply) {
  if (auto checked = CheckReply(reply, Command::kStatus); !checked) {
    return tl::unexpected(checked.error());
  }
  if (At(reply, 1) != 0) return BadReply("the bridge refused to tell its state");
  Status status;
  status.engine = At(reply, 8);
  status.address_nack = (At(reply, 20) & kAddressNackBit) != 0;
  status.speed_taken = At(reply, 3) == kSpeedTaken;
  return status;
}

Result<Acceptance> DecodeAcceptance(ByteSpan reply, Command command) {
  if (auto checked = CheckReply(reply, command); !checked) return tl::unexpected(checked.error());
  return Acceptance{At(reply, 1) == 0, At(reply, 2)};
}

Result<std::optional<Bytes>> DecodeFetched(ByteSpan reply) {
  if (auto checked = CheckReply(reply, Command::kFetch); !checked) {
    return tl::unexpected(checked.error());
  }
  const unsigned state = At(reply, 2);
  const unsigned count = At(reply, 3);
  if (At(reply, 1) == kPartialData) return std::optional<Bytes>();
  if (At(reply, 1) != 0 || count == kNoCount) return std::optional<Bytes>();
  if (state != kReadComplete && state != kReadPartial) return std::optional<Bytes>();
  if (count > kMostDataBytes) {
    return BadReply(std::to_string(count) + " bytes in a report that holds 60");
  }
  const ByteSpan data = reply.subspan(4, count);
  return std::optional(Bytes(data.begin(), data.end()));
}

}  // namespace lightcal::devices::mcp2221
