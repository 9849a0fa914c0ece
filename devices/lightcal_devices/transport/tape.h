// SPDX-License-Identifier: Apache-2.0
// A recorded dialogue with an instrument; tape_codec.h writes it as a file.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices {

enum class TapeOperation { kWrite, kRead, kControl };

// One call of a Transport and what came of it.
struct TapeExchange {
  TapeOperation operation = TapeOperation::kWrite;
  double elapsed_ms = 0.0;  // since the tape began
  std::string verb;         // of a control
  Bytes sent;               // by a write or a control
  Bytes received;           // by a read or a control
  std::string fault;        // "" = it went well; else the word of transport.h
};

struct Tape {
  std::string driver;    // a row of the meter table: "sekonic"
  std::string device;    // "sekonic:12345678"
  std::string recorded;  // ISO 8601 time of the first exchange
  std::string settings;  // the driver's options it was recorded with: lines of name=value
  std::string note;      // where it comes from
  std::vector<TapeExchange> exchanges;
};

// Bytes as messages spell them: printable ASCII as it is, everything else (blank and backslash too)
// as \xHH.
[[nodiscard]] std::string EscapedBytes(std::span<const std::byte> bytes);

}  // namespace lightcal::devices
