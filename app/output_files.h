// SPDX-License-Identifier: Apache-2.0
// How lightcal writes files: all of a command's outputs or none, each to a temporary name beside
// its target, synced, then renamed.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal_devices/disk_sources.h"

namespace lightcal::app {

struct OutputFile {
  std::string path;
  std::string contents;
};

// Before anything is written: fails with "exists" when a target is there, is not of the very format
// that would replace it as lightcal writes it (provenance_mark.h) and force is off. Refused, with
// force too: is_input, where this run reads it; wrong_ending; same_output, where two files would
// take one name. Fails with "unwritable" when a directory or file cannot be written, and of "-".
// Creates directories. On any failure no target has changed. Temporaries have names nobody can
// foresee and are made anew (never through a link); those that a killed run left beside the same
// targets are removed.
[[nodiscard]] Result<void> WriteOutputs(const std::vector<OutputFile>& files, bool force);

// The same questions of names alone, before long work. `formats` as of OwnFormatOf, empty = not
// known yet: then any file of ours may be replaced.
struct PlannedOutput {
  std::string path;
  std::string format;
};
[[nodiscard]] Result<void> CheckOutputs(const std::vector<PlannedOutput>& files, bool force);

// A file whose writer fills the temporary name it is given: for pictures too large to hold twice.
struct OutputWriter {
  std::string path;
  std::string format;  // as of OwnFormatOf; empty: nothing of ours, so that none is replaced
  std::function<Result<void>(const std::string& temporary)> write;
};
[[nodiscard]] OutputWriter WriterOf(OutputFile file);
// As WriteOutputs.
[[nodiscard]] Result<void> WriteOutputsWith(const std::vector<OutputWriter>& files, bool force);

// Removes what killed runs of lightcal were writing in a directory: hidden temporaries whose
// process is gone.
void RemoveLeftovers(const std::string& directory);

// Paths relative to a directory become paths below it.
void PlaceUnder(const std::string& directory, std::vector<OutputFile>& files);

// "wrote 18 files to DIR; see DIR/report.html", one: its path; "" = none.
[[nodiscard]] std::string WroteLine(const std::vector<OutputFile>& files,
                                    const std::string& directory);

[[nodiscard]] std::vector<std::string> PathsOf(const std::vector<OutputFile>& files);

// Whole file as bytes: one of our own outputs, which may be written again. What a person gives is
// read by ReadInputFile (input_files.h). Fails: not_found, unreadable.
[[nodiscard]] Result<std::string> ReadOutput(const std::string& path);

// "lightcal 0.1.0"
[[nodiscard]] std::string GeneratorName();

}  // namespace lightcal::app
