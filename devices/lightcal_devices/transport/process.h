// SPDX-License-Identifier: Apache-2.0
// A program as the line to an instrument: what it prints comes in, what it reads goes out.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices {

struct ProcessSettings {
  std::string program;                   // a path, or a name that is looked up on PATH
  std::vector<std::string> environment;  // "NAME=value", beside ours and LC_ALL=C
  // The longest one run may take; then its whole process group is killed. 0 = as long as it likes.
  std::chrono::milliseconds longest_run{0};
};

// The program as a Transport. It does not run before the verb "start"; then it runs in a process
// group of its own (Ctrl-C does not reach it) with the C locale, its standard input a pipe that
// stays open and its standard output and error both read here. The end of the transport ends the
// whole group: SIGTERM, after 500 ms SIGKILL.
//   Read     what it printed since: at least one byte, at most max; timeout. When the program is
//            over and all it printed was read: ended, with the exit code in the message.
//   Write    onto its standard input. ended: it reads no more.
//   Control  "program"      another program than the settings' (bytes: its path)
//            "start"        runs it; bytes: the arguments, each ended by a newline or NUL (the last
//                           need not be). Ends the former run first. Fails: no_device (no such
//                           program), no_permission (not to be executed), io.
//            "stop"         ends the run; does nothing when none is
//            "exit_status"  "0" to "255", or "signal 11"; waits for the end. timeout: still running
[[nodiscard]] std::unique_ptr<Transport> OpenProcess(const ProcessSettings& settings);

// The bytes of "start": one argument a line.
[[nodiscard]] Bytes StartArguments(const std::vector<std::string>& arguments);

// Where PATH finds the program (a name with a slash is its own path); absent when nowhere, or when
// it may not be executed.
[[nodiscard]] std::optional<std::string> ProgramOnPath(std::string_view program);

}  // namespace lightcal::devices
