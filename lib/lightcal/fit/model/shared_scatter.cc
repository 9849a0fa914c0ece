// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/shared_scatter.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lightcal::fit {
namespace {

// Where the walls' light scatters alike: nearer together than a quarter of the distance. (Of 1,400
// traced rooms what is left of ln E_walls beside a line and its bend goes smoothly with ln d.)
constexpr double kOnePlace = 0.25;

struct SharedPlace {
  bool lit = false;
  double x = 0.0;                        // of the nearest row
  const Observation* nearest = nullptr;  // as that has it
  std::vector<WallsOfRow*> rows;

  [[nodiscard]] bool Reaches(bool row_lit, double row_x) const {
    return lit == row_lit && row_x <= x + kOnePlace;
  }
  [[nodiscard]] bool IsOf(const Observation& row) const {
    if (!row.position_m || !nearest->position_m) return true;
    const double apart = Length(*row.position_m - *nearest->position_m);
    return apart <= kOnePlace * row.distance_m;
  }
};

double SigmaWithScatter(const ReadingRow& row, const Theta& theta) {
  if (!row.walls && !(row.uneven > 0.0)) return row.own_sigma;
  const double intensity = std::exp(theta[kLnIntensity]);
  const double walls = intensity * WallsPerCandela(row, theta.data());
  const double lamp = intensity * LampPerCandela(row, theta[kDistanceOffset]);
  const double whole =
      row.form == RowForm::kLinear ? 1.0 : lamp + walls + row.ambient_gain * theta[kAmbient];
  const double scatter = row.walls ? row.walls->scatter * walls / whole : 0.0;
  const double uneven = row.uneven * lamp / whole;
  return whole > 0.0
             ? std::sqrt(row.own_sigma * row.own_sigma + scatter * scatter + uneven * uneven)
             : row.own_sigma;
}

}  // namespace

void ShareScatter(std::vector<ReadingOfWalls> readings) {
  std::ranges::sort(readings, {},
                    [](const ReadingOfWalls& one) { return std::pair(one.lit, one.walls->x); });
  std::vector<SharedPlace> places;  // as near as their nearest row, ascending
  for (const ReadingOfWalls& one : readings) {
    WallsOfRow& walls = *one.walls;
    auto place = places.rbegin();
    while (place != places.rend() && place->Reaches(one.lit, walls.x) && !place->IsOf(*one.at)) {
      ++place;
    }
    if (place == places.rend() || !place->Reaches(one.lit, walls.x)) {
      places.push_back({one.lit, walls.x, one.at, {}});
      place = places.rbegin();
    }
    walls.place = static_cast<int>(places.rend() - place) - 1;
    place->rows.push_back(&walls);
  }
  for (const SharedPlace& place : places) {
    for (WallsOfRow* walls : place.rows) {
      walls->rows = static_cast<int>(place.rows.size());
      walls->scatter *= std::sqrt(static_cast<double>(walls->rows));
    }
  }
}

double SettleScatter(Estimation& estimation, const Theta& theta) {
  double most = 0.0;
  for (ReadingRow& row : estimation.rows) {
    const double sigma = SigmaWithScatter(row, theta);
    most = std::max(most, std::abs(sigma / row.sigma - 1.0));
    row.sigma = sigma;
  }
  return most;
}

}  // namespace lightcal::fit
