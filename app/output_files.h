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

// Fails with "exists" (exit 1) before writing anything when a target exists, does not carry
// lightcal's own provenance (the word "lightcal" in its first 4 KiB or anywhere in a JSON or PDF
// file) and force is off; with "unwritable" when a directory or file cannot be written. Creates
// directories. On any failure no target has changed. Temporaries of the same targets that a killed
// run left are removed.
[[nodiscard]] Result<void> WriteOutputs(const std::vector<OutputFile>& files, bool force);

// A file whose writer fills the temporary name it is given: for pictures too large to hold twice.
struct OutputWriter {
  std::string path;
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

// Whole file as bytes. Fails: not_found, unreadable.
[[nodiscard]] Result<std::string> ReadWholeFile(const std::string& path);

// "lightcal 0.1.0"
[[nodiscard]] std::string GeneratorName();

}  // namespace lightcal::app
