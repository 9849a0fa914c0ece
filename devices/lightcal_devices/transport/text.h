// SPDX-License-Identifier: Apache-2.0
// Lines of text as messages: from a serial port, a FIFO, a program, or a person.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "lightcal/core/result.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices {

// Cuts `inner`, a stream of bytes, into lines: each Read returns the next one without its end (LF,
// CR or both), at most `max` bytes of it; blank lines are passed over. What piled up while it was
// Paused, or where nobody read for longer than kStaleAfter, is old light: all but its last whole
// line is dropped, and that too of a stream that `repeats` itself, after kStaleAfter or where the
// kernel's buffer ran over. A stream that repeats may also be joined in the middle of a line; unless
// it is silent for kJoinSilence at first, it is read from its next line on. The end of the stream
// ends its last line.
inline constexpr std::chrono::milliseconds kStaleAfter{2000};
inline constexpr std::chrono::milliseconds kJoinSilence{50};
[[nodiscard]] std::unique_ptr<Transport> OpenLines(std::unique_ptr<Transport> inner, bool repeats);

// "/dev/ttyACM0" (9600 8N1), "/run/user/1000/lux" (a FIFO), or "!python3 meter.py" (what follows is
// a command of the shell; it is started anew when it has ended and another line is asked for).
// Fails: no_device, no_permission, busy, io.
[[nodiscard]] Result<std::unique_ptr<Transport>> OpenTextSource(const std::string& address);

// Each Read is one answer of `ask`; where it has none, ended.
using AskForText = std::function<std::optional<std::string>()>;
[[nodiscard]] std::unique_ptr<Transport> OpenTyped(AskForText ask);

}  // namespace lightcal::devices
