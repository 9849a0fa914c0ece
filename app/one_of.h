// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace lightcal::app {

// The names of a table's rows.
template <class Rows>
std::vector<std::string> NamesOf(const Rows& rows) {
  std::vector<std::string> names;
  for (const auto& row : rows) names.emplace_back(row.name);
  return names;
}

// The check of an option that takes one of a few words. --help lists them, completion offers them,
// and a wrong one is answered with the nearest.
template <class Words>
CLI::IsMember OneOf(const Words& words) {
  return CLI::IsMember(std::vector<std::string>(words.begin(), words.end()));
}

// The same, in any letter case.
template <class Words>
CLI::IsMember OneOfAnyCase(const Words& words) {
  return CLI::IsMember(std::vector<std::string>(words.begin(), words.end()), CLI::ignore_case);
}

}  // namespace lightcal::app
