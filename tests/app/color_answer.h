// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "run_cli_json.h"

namespace lightcal::test {

inline nlohmann::json Color(const std::vector<std::string>& arguments) {
  return LightcalJson("color", arguments);
}

}  // namespace lightcal::test
