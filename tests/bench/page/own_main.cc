// SPDX-License-Identifier: Apache-2.0
//   lightcal_page_own cct|area|solver|intervals|million_draws TABLE
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "own.h"

int main(int count, char** words) {
  constexpr std::pair<std::string_view, void (*)(const std::vector<page::Numbers>&)> kFigures[] = {
      {"cct", page::OwnCct},
      {"area", page::OwnArea},
      {"solver", page::OwnSolver},
      {"intervals", page::OwnIntervals},
      {"million_draws", page::OwnMillionDraws}};
  for (const auto& [name, measure] : kFigures) {
    if (count != 3 || name != words[1]) continue;
    measure(page::ReadTable(words[2]));
    return EXIT_SUCCESS;
  }
  std::fputs("lightcal_page_own cct|area|solver|intervals|million_draws TABLE\n", stderr);
  return EXIT_FAILURE;
}
