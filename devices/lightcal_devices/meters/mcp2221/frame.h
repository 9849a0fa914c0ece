// SPDX-License-Identifier: Apache-2.0
// Reports of the Microchip MCP2221A USB-to-I2C bridge. Pure.
// Source: MCP2221A data sheet (DS20005565), chapter 3; the engine codes as the kernel's driver and
// Adafruit's Blinka have them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices::mcp2221 {

inline constexpr std::string_view kBadReply = "bad_reply";
inline constexpr std::size_t kReportBytes = 64;
inline constexpr std::size_t kMostDataBytes = 60;  // of one report

enum class Command : std::uint8_t {
  kStatus = 0x10,  // also cancel and speed
  kFetch = 0x40,   // the bytes a read brought
  kWrite = 0x90,
  kRead = 0x91,
  kReadRepeatedStart = 0x93,
  kWriteNoStop = 0x94,
};

// Requests, as hidapi wants them: the report's number (0, there are none), then 64 bytes.
[[nodiscard]] Bytes EncodeStatus();
[[nodiscard]] Bytes EncodeCancel();
// A clock of 12 MHz / (divider + 3).
inline constexpr std::uint8_t kDivider100kHz = 0x75;
[[nodiscard]] Bytes EncodeSpeed(std::uint8_t divider);
// At most kMostDataBytes.
[[nodiscard]] Bytes EncodeWrite(Command command, std::uint8_t address,
                                std::span<const std::byte> bytes);
[[nodiscard]] Bytes EncodeRead(Command command, std::uint8_t address, std::size_t count);
[[nodiscard]] Bytes EncodeFetch();

// Where the bridge's I2C engine stands.
inline constexpr unsigned kEngineIdle = 0x00;
inline constexpr unsigned kEngineWroteNoStop = 0x45;
// Why it stopped, in words; "" = it did not.
[[nodiscard]] std::string_view EngineFault(unsigned state);
inline constexpr unsigned kEngineAddressNack = 0x25;

struct Status {
  unsigned engine = kEngineIdle;
  bool address_nack = false;
  bool speed_taken = false;
};
// Each reply: 64 bytes, the first repeating the command.   Fails: bad_reply.
[[nodiscard]] Result<Status> DecodeStatus(std::span<const std::byte> reply);

// Whether the engine took a write or a read; if not, its state.
struct Acceptance {
  bool accepted = false;
  unsigned engine = kEngineIdle;
};
[[nodiscard]] Result<Acceptance> DecodeAcceptance(std::span<const std::byte> reply,
                                                  Command command);

// The bytes a read brought; absent = not there yet.
[[nodiscard]] Result<std::optional<Bytes>> DecodeFetched(std::span<const std::byte> reply);

}  // namespace lightcal::devices::mcp2221
