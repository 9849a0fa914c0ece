// SPDX-License-Identifier: Apache-2.0
// Bytes of the Konica Minolta T-10A and CL-200A as values. Pure: no wire, no clock.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "lightcal/core/result.h"

namespace lightcal::devices::konica {

inline constexpr int kAllHeads = 99;
inline constexpr int kHighestHead = 29;

// STX HH CC PPPP ETX BCC CR LF: the head (0 .. 29, or 99 for all), the command and its four
// characters of parameters. BCC is the exclusive or of everything from HH to ETX, as two
// hexadecimal digits.
[[nodiscard]] std::string EncodeCommand(int head, int command, std::string_view parameters);

// The second status character, S1.
enum class Condition {
  kOk,
  kHeadPowerOff,  // switch the meter off and on, as after kMemoryError
  kMemoryError,   // EEPROM
  kExtRefused,    // the external measuring mode was not taken
  kOverRange,
  kLowLuminance,   // chromaticity means nothing
  kCctOutOfRange,  // illuminance and chromaticity hold
};

// The four status characters S0 S1 S2 S3; S0 and S2 repeat settings.
struct Status {
  Condition condition = Condition::kOk;
  bool battery_low = false;  // the maker says: discard the measurement
};

// 14 bytes, the answer to 54 and 40.
inline constexpr std::size_t kShortReplyBytes = 14;
// Fails: bad_reply (length, STX, ETX, BCC, end), also where it answers another head or command.
[[nodiscard]] Result<Condition> DecodeShortReply(std::span<const std::byte> bytes, int head,
                                                 int command);

// Sign, four digits padded with blanks, exponent e:  value = +- n 10^(e - 4).
struct Number {
  int n = 0;         // -9999 .. 9999
  int decimals = 0;  // 4 - e
  [[nodiscard]] double Value() const;
};

// 32 bytes, the answer to 02, 08 and 10: three numbers, each absent where six blanks stand.
struct LongReply {
  Status status;
  std::array<std::optional<Number>, 3> data;
};
inline constexpr std::size_t kLongReplyBytes = 32;
[[nodiscard]] Result<LongReply> DecodeLongReply(std::span<const std::byte> bytes, int head,
                                                int command);

}  // namespace lightcal::devices::konica
