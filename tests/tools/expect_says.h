// SPDX-License-Identifier: Apache-2.0
// A command line that is not answered, and what the person is told instead.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "run_cli.h"

namespace lightcal::test {

inline void ExpectSays(const std::vector<std::string>& command, int exit_code,
                       const std::string& says) {
  const CliResult run = RunLightcal(command);
  EXPECT_EQ(run.exit_code, exit_code) << run.out << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
}

}  // namespace lightcal::test
