// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"

namespace lightcal::test {

inline std::vector<std::string> Codes(const Warnings& warnings) {
  std::vector<std::string> codes;
  for (const Warning& warning : warnings) codes.push_back(warning.code);
  return codes;
}

}  // namespace lightcal::test
