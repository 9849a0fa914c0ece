// SPDX-License-Identifier: Apache-2.0
// Colour temperature: lightcal and the published methods. Table: x, y, kelvins.
#include <vector>

#include "../cct_yardsticks.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/cct_approximations.h"
#include "lightcal/colorimetry/cct_batch.h"
#include "own.h"

namespace page {

void OwnCct(const std::vector<Numbers>& table) {
  using namespace lightcal;
  std::vector<Xy> colors;
  for (const Numbers& row : table) colors.push_back({row[0], row[1]});
  const Rows rows(table, ErrorScale::kRelative);
  rows.PrintEach("lightcal", "one by one",
                 [&](std::size_t i) { return CctFromXy(colors[i]).temperature.value(); });
  std::vector<CctResult> results(colors.size());
  rows.PrintFilled("lightcal", "side by side", [&](Numbers& out) {
    CctBatch(colors, results);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = results[i].temperature.value();
  });
  rows.PrintEach("McCamy", "polynomial",
                 [&](std::size_t i) { return McCamyCct(colors[i]).value(); });
  rows.PrintEach("Hernández-Andrés", "exponentials",
                 [&](std::size_t i) { return HernandezAndresCct(colors[i]).value(); });
  const Robertson31 robertson;
  rows.PrintEach("Robertson", "31 isotherms",
                 [&](std::size_t i) { return robertson.KelvinOf(Uv1960FromXy(colors[i])); });
  for (const auto& [name, step] : {std::pair{"1 % table", 1e-2}, {"0.1 % table", 1e-3}}) {
    const OhnoTable ohno(step);
    rows.PrintEach("Ohno", name,
                   [&](std::size_t i) { return ohno.KelvinOf(Uv1960FromXy(colors[i])); });
  }
}

}  // namespace page
