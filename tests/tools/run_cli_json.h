// SPDX-License-Identifier: Apache-2.0
// A command that must succeed, asked for JSON: the document it answers with.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "run_cli.h"

namespace lightcal::test {

inline nlohmann::json LightcalJson(const std::string& command, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), command);
  arguments.emplace_back("--json");
  const CliResult result = RunLightcal(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return nlohmann::json::parse(result.out);
}

}  // namespace lightcal::test
