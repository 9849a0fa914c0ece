// SPDX-License-Identifier: Apache-2.0
// A recorded dialogue with an instrument, as a text file a person can read and send.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal {

enum class TapeDirection { kWrite, kRead, kWriteFault, kReadFault };

struct TapeLine {
  TapeDirection direction = TapeDirection::kWrite;
  double elapsed_ms = 0.0;  // since the tape began
  Bytes bytes;              // of a write or a read
  std::string code;         // of a fault: the word of transport.h
};

struct Tape {
  std::string driver;    // a row of the meter table: "sekonic"
  std::string device;    // "sekonic:12345678"
  std::string recorded;  // ISO 8601 time of the first exchange
  std::string note;      // where it comes from
  std::vector<TapeLine> lines;
};

// The text:
//   lightcal-tape 1
//   driver sekonic
//   device sekonic:C-800
//   recorded 2026-11-21T10:00:00Z
//   note any words on one line
//   > 0 MN
//   < 1.25 \x060
//   !< 201 timeout
// One exchange a line: direction, milliseconds since the start, bytes. !> and !< are a write (its
// bytes on the line before) and a read that failed. Bytes are printable ASCII as they are,
// everything else (blank and backslash too) as \xHH with exactly two digits.
[[nodiscard]] std::string TapeToText(const Tape& tape);

// `where` stands in messages. Refused: bad_tape, with the line.
[[nodiscard]] Result<Tape> TapeFromText(std::string_view text, std::string_view where);

// Bytes as a tape and messages spell them.
[[nodiscard]] std::string EscapedBytes(std::span<const std::byte> bytes);

}  // namespace lightcal
