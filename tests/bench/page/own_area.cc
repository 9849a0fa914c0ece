// SPDX-License-Identifier: Apache-2.0
// Illuminance per candela of a rectangle of 1.6 x 1.2 m. Table: position, normal, lx/cd.
#include "lightcal/light/models/ladder.h"
#include "own.h"

namespace page {

void OwnArea(const std::vector<Numbers>& table) {
  using namespace lightcal;
  const RectSource source{0.8, 0.6};
  std::vector<Receiver<double>> meters;
  for (const Numbers& r : table) meters.push_back({{r[0], r[1], r[2]}, {r[3], r[4], r[5]}});
  const Rows rows(table, ErrorScale::kRelative);
  rows.PrintEach("lightcal exact", "contour or quadrature",
                 [&](std::size_t i) { return LuxPerCandela(source, meters[i]); });
  for (const auto& [name, tolerance] : {std::pair{"1e-1", 1e-1},
                                        {"1e-2", 1e-2},
                                        {"1e-3", 1e-3},
                                        {"1e-4", 1e-4},
                                        {"1e-6", 1e-6},
                                        {"1e-9", 1e-9}}) {
    rows.PrintEach("lightcal ladder", std::string("tolerance ") + name,
                   [&](std::size_t i) { return LuxPerCandela(source, meters[i], tolerance); });
  }
  for (const auto& [name, level] : {std::pair{"point", LadderLevel::kPoint},
                                    {"2 x 2", LadderLevel::kGauss2},
                                    {"3 x 3", LadderLevel::kGauss3},
                                    {"4 x 4", LadderLevel::kGauss4}}) {
    rows.PrintEach("lightcal fixed level", name,
                   [&](std::size_t i) { return LuxPerCandelaAt(level, source, meters[i]); });
  }
}

}  // namespace page
