// SPDX-License-Identifier: Apache-2.0
// How a program is started: its pipes, its environment, its process group and signals.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "lightcal_devices/transport/file_descriptor.h"

namespace lightcal::devices {

struct Pipe {
  FileDescriptor read_end;
  FileDescriptor write_end;
};

// Neither end is seen by any program but the one that gets a copy. Fails: false, with errno.
[[nodiscard]] bool MakePipe(Pipe& made);

// Our environment, in which `changes` ("NAME=value") stand instead of what had their names.
[[nodiscard]] std::vector<std::string> EnvironmentWith(const std::vector<std::string>& changes);

// Runs words[0] (a path, or a name looked up on PATH) with the rest as its arguments, `input` as
// its standard input and `output` as its standard output and error, in a process group of its own,
// no signal blocked, SIGINT, SIGTERM, SIGPIPE, SIGHUP and SIGQUIT as by default. 0, or an errno:
// then `child` says nothing.
[[nodiscard]] int SpawnProgram(pid_t& child, std::vector<std::string> words,
                               std::vector<std::string> environment, int input, int output);

}  // namespace lightcal::devices
