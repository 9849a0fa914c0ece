// SPDX-License-Identifier: Apache-2.0
#include "lightcal/core/nearest_word.h"

#include <algorithm>
#include <vector>

namespace lightcal {
namespace {

// Optimal string alignment distance.
std::size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) cost[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) cost[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, replace});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
      }
    }
  }
  return cost[a.size()][b.size()];
}

std::size_t AlikeAtFirst(std::string_view a, std::string_view b) {
  return static_cast<std::size_t>(std::ranges::mismatch(a, b).in1 - a.begin());
}

}  // namespace

std::string NearestWord(std::string_view word, std::span<const std::string_view> known) {
  std::size_t best = std::max<std::size_t>(2, word.size() / 3) + 1;
  std::size_t most_alike = 0;
  std::string_view nearest;
  for (const std::string_view candidate : known) {
    const std::size_t distance = EditDistance(word, candidate);
    const bool shares_a_letter = distance < std::max(word.size(), candidate.size());
    if (!shares_a_letter) continue;
    // Of two as near, the one that begins alike: "of" is "off", not "on".
    const std::size_t alike = AlikeAtFirst(word, candidate);
    if (distance < best || (distance == best && !nearest.empty() && alike > most_alike)) {
      best = distance;
      most_alike = alike;
      nearest = candidate;
    }
  }
  return std::string(nearest);
}

}  // namespace lightcal
