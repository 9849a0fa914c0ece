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
  if (!row.walls) return row.sigma;
  const double intensity = std::exp(theta[kLnIntensity]);
  const double walls = intensity * WallsPerCandela(row, theta.data());
  double whole = 1.0;
  if (row.form != RowForm::kLinear) {
    whole = intensity * LampPerCandela(row, theta[kDistanceOffset]) + walls +
            row.ambient_gain * theta[kAmbient];
  }
  const double scatter = row.walls->scatter * walls / whole;
  return whole > 0.0 ? std::sqrt(row.own_sigma * row.own_sigma + scatter * scatter) : row.own_sigma;
}

}  // namespace

void ShareScatter(const std::vector<int>& observation, const Observations& observations,
                  std::vector<ReadingRow>& rows) {
  std::vector<std::size_t> seeing;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].walls) seeing.push_back(i);
  }
  const auto lit = [&](std::size_t i) { return rows[i].direct_gain > 0.0; };
  std::ranges::sort(seeing, {}, [&](std::size_t i) { return std::pair(lit(i), rows[i].walls->x); });
  std::vector<SharedPlace> places;  // as near as their nearest row, ascending
  for (const std::size_t i : seeing) {
    const Observation& at = observations.rows[static_cast<std::size_t>(observation[i])];
    WallsOfRow& walls = *rows[i].walls;
    auto place = places.rbegin();
    while (place != places.rend() && place->Reaches(lit(i), walls.x) && !place->IsOf(at)) ++place;
    if (place == places.rend() || !place->Reaches(lit(i), walls.x)) {
      places.push_back({lit(i), walls.x, &at, {}});
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

double LnDensity(const Estimation& estimation, const Theta& theta) {
  struct Shared {
    double strength = 0.0, pull = 0.0;  // s^T D^-1 s, s^T D^-1 (reading - model)
  };
  std::vector<Shared> places;
  double ln = 0.0;
  for (const ReadingRow& row : estimation.rows) {
    const double residual = RowResidual(row, theta);
    if (!row.walls || row.walls->rows == 1) {
      ln -= 0.5 * residual * residual + std::log(row.sigma);
      continue;
    }
    const double whole = row.sigma / row.own_sigma;
    const double own = residual * whole;
    ln -= 0.5 * own * own + std::log(row.own_sigma);
    const double scatter = std::sqrt(std::max(0.0, whole * whole - 1.0) / row.walls->rows);
    const auto at = static_cast<std::size_t>(row.walls->place);
    if (places.size() <= at) places.resize(at + 1);
    places[at].strength += scatter * scatter;
    places[at].pull += scatter * own;
  }
  for (const Shared& place : places) {
    ln += 0.5 * place.pull * place.pull / (1.0 + place.strength) - 0.5 * std::log1p(place.strength);
  }
  return ln;
}

}  // namespace lightcal::fit
