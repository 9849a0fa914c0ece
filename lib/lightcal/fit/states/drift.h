// SPDX-License-Identifier: Apache-2.0
// What a lamp gave between the moments at which it was read: lamps warm up, tire and follow the
// mains.
#pragma once

#include <optional>
#include <vector>

namespace lightcal::fit {

// ln of one reading of the same state at the same place.
struct DatedLog {
  std::optional<double> seconds;  // since any moment
  double ln = 0.0, variance = 0.0;
};

struct LogAt {
  double ln = 0.0, variance = 0.0;
};

// ln of that state at a moment, from at least one reading of it. Where all are dated and two or
// more, the lamp walks at random between them (Brownian motion: of all continuous drifts the one
// that assumes least), how fast being averaged over by how probable it makes the readings, 0
// included; beyond them it goes on walking. Elsewhere their mean, whose variance grows by their
// scatter (Birge ratio) where that is more than their own.
[[nodiscard]] LogAt DriftedLog(const std::vector<DatedLog>& readings,
                               std::optional<double> seconds);

}  // namespace lightcal::fit
