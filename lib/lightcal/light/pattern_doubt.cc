// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/pattern_doubt.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "lightcal/core/uncertain.h"
#include "lightcal/core/units.h"

namespace lightcal {

double PatternDoubt::At(double gamma) const {
  if (gamma_rad.empty()) return 0.0;
  const auto above = std::ranges::upper_bound(gamma_rad, gamma);
  if (above == gamma_rad.begin()) return part_sd.front();
  if (above == gamma_rad.end()) return part_sd.back();
  const auto i = static_cast<std::size_t>(above - gamma_rad.begin());
  const double part = (gamma - gamma_rad[i - 1]) / (gamma_rad[i] - gamma_rad[i - 1]);
  return part_sd[i - 1] + part * (part_sd[i] - part_sd[i - 1]);
}

PatternDoubt PatternDoubtOf(const std::vector<double>& gamma_deg, std::vector<double> part_sd) {
  PatternDoubt out{{}, std::move(part_sd)};
  for (const double degrees : gamma_deg) {
    out.gamma_rad.push_back(RadiansFromDegrees(degrees).value());
  }
  return out;
}

PatternDoubt DoubtOfAnyAim() { return {{0.0}, {1.0 / kZ95}}; }

PatternDoubt DoubtOfAnyBeam() {
  constexpr double kNarrowest_deg = 3.0, kWidest_deg = 60.0;
  constexpr int kBeams = 60;
  PatternDoubt out;
  for (double gamma = 0.0; gamma <= 90.0; gamma += gamma < 10.0 ? 0.25 : 1.0) {
    double squares = 0.0;
    for (int i = 0; i < kBeams; ++i) {
      const double half =
          kNarrowest_deg * std::pow(kWidest_deg / kNarrowest_deg, (i + 0.5) / kBeams);
      const double less = 1.0 - std::exp2(-(gamma / half) * (gamma / half));
      squares += less * less / kBeams;
    }
    out.gamma_rad.push_back(RadiansFromDegrees(gamma).value());
    out.part_sd.push_back(std::min(std::sqrt(squares), 1.0 / kZ95));
  }
  return out;
}

}  // namespace lightcal
