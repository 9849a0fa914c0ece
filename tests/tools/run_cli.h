// SPDX-License-Identifier: Apache-2.0
// Drives the built lightcal binary as a person's shell would.
#pragma once

#include <string>
#include <vector>

namespace lightcal::test {

struct CliResult {
  int exit_code = -1;  // 128 + signal when killed
  std::string out;
  std::string err;
};

// Runs the binary (no shell) with `arguments`; stdin gives `input`, the environment is ours plus
// `environment` ("NAME=value"). wrapper comes before the binary ("umockdev-run", "-d", ...).
CliResult RunLightcal(const std::vector<std::string>& arguments, const std::string& input = "",
                      const std::vector<std::string>& environment = {},
                      const std::vector<std::string>& wrapper = {});

// Runs any program the same way.
CliResult RunProgram(const std::vector<std::string>& command, const std::string& input = "",
                     const std::vector<std::string>& environment = {});

// A fresh empty directory, removed with everything in it at the end of the scope.
class TempDir {
 public:
  TempDir();
  ~TempDir();
  TempDir(const TempDir&) = delete;
  TempDir& operator=(const TempDir&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }
  // path()/name with these contents; returns the whole path. Creates folders.
  std::string Write(const std::string& name, const std::string& contents) const;

 private:
  std::string path_;
};

std::string ReadFile(const std::string& path);
// <source>/sample_data/<name>
std::string SampleData(const std::string& name);

}  // namespace lightcal::test
