// SPDX-License-Identifier: Apache-2.0
// A tape as a file of JSON lines, which a person can read and send.
#pragma once

#include <string>
#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal_devices/transport/tape.h"

namespace lightcal::devices {

// The file:
//   {"schema":"lightcal.tape/1","driver":"sekonic","device":"sekonic:C-800","recorded":"...Z"}
//   {"t_ms":0,"op":"write","sent":"MN"}
//   {"t_ms":1.25,"op":"read","got":"\u00060"}
//   {"t_ms":2,"op":"control","verb":"get_feature","sent_hex":"05","got_hex":"05ff"}
//   {"t_ms":201,"op":"read","fault":"timeout"}
// The first line may also have "settings", lines of name=value the driver was given, and "note".
// One exchange a line: milliseconds since the start, what was asked, the bytes that went out (sent)
// and came in (got). Bytes below 0x7f are a JSON string, one character a byte; any others make it
// the hexadecimal sent_hex or got_hex. No bytes, no key.
[[nodiscard]] std::string TapeToText(const Tape& tape);

// `where` stands in messages. Refused: bad_tape, with the line.
[[nodiscard]] Result<Tape> TapeFromText(std::string_view text, std::string_view where);

}  // namespace lightcal::devices
