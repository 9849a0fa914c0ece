// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/room_exchange.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lightcal/light/models/ladder.h"

namespace lightcal {
namespace {

constexpr double kPatches = 216.0;
constexpr double kFewest = 4.0, kMost = 32.0;  // along a side
constexpr double kShareTolerance = 2e-2;

// Edges of `count` patches from `low` on, a fifth as wide at the ends as in the mean.
std::vector<double> Edges(double low, double length, int count) {
  constexpr double kTowardsEnds = 0.8;
  std::vector<double> edges;
  for (int i = 0; i <= count; ++i) {
    const double turn = 2.0 * std::numbers::pi;
    const double t = static_cast<double>(i) / count;
    edges.push_back(low + length * (t - kTowardsEnds / turn * std::sin(turn * t)));
  }
  return edges;
}

}  // namespace

RoomExchange::RoomExchange(const RoomBox& room) : reflectance_(room.reflectance) {
  const Vec3& size_m = room.size_m;
  const double side_m = std::sqrt(AreaOfWalls_m2(size_m) / kPatches);
  const auto edges = [&](int along) {
    const double count = std::clamp(std::round(size_m[along] / side_m), kFewest, kMost);
    return Edges(LowEnd(size_m, along), size_m[along], static_cast<int>(count));
  };
  for (const RoomWall& wall : kRoomWalls) {
    for (const WallPatch& patch : PatchesOf(wall, size_m, edges(wall.u()), edges(wall.v()))) {
      patches_.push_back(patch);
      area_m2_ += patch.area_m2();
    }
  }
  FindShares();
}

void RoomExchange::FindShares() {
  const std::size_t n = patches_.size();
  shares_.assign(n * n, 0.0);
  // A_i F_ij by what j casts on i's middle.
  const auto exchanged = [&](std::size_t i, std::size_t j) {
    const WallPatch& from = patches_[j];
    return patches_[i].area_m2() * from.area_m2() / std::numbers::pi *
           LuxPerCandela(from.source, from.Seen(patches_[i].middle()), kShareTolerance);
  };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      // Patches of one wall do not see each other.
      const double both = 0.5 * (exchanged(i, j) + exchanged(j, i));
      shares_[i * n + j] = shares_[j * n + i] = both;
    }
  }
  // Rows of the whole area, by one factor a patch, which keeps both ways alike.
  std::vector<double> factor(n);
  for (int round = 0; round < 8; ++round) {
    for (std::size_t i = 0; i < n; ++i) {
      double whole = 0.0;
      for (std::size_t j = 0; j < n; ++j) whole += shares_[i * n + j];
      factor[i] = std::sqrt(patches_[i].area_m2() / whole);
    }
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) shares_[i * n + j] *= factor[i] * factor[j];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) shares_[i * n + j] /= patches_[i].area_m2();
  }
}

double RoomExchange::MeanOf(const std::vector<double>& lux) const {
  double flux = 0.0;
  for (std::size_t i = 0; i < lux.size(); ++i) flux += lux[i] * patches_[i].area_m2();
  return flux / area_m2_;
}

std::vector<double> RoomExchange::Settled(std::vector<double> once_lx, double mean_lx) const {
  constexpr int kRounds = 100;
  constexpr double kSettled = 1e-4;  // of the mean
  const double found = MeanOf(once_lx);
  if (!(found > 0.0)) return std::vector<double>(once_lx.size(), 0.0);
  for (double& lux : once_lx) lux *= mean_lx / found;
  // From the mean of all of them: what is left to find dies out faster than by rho a bounce.
  const std::size_t n = once_lx.size();
  std::vector<double> all(n);
  for (std::size_t i = 0; i < n; ++i) {
    all[i] = once_lx[i] + reflectance_ / (1.0 - reflectance_) * mean_lx;
  }
  std::vector<double> next(n);
  for (int round = 0; round < kRounds; ++round) {
    double change = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      double gathered = 0.0;
      for (std::size_t j = 0; j < n; ++j) gathered += shares_[i * n + j] * all[j];
      next[i] = once_lx[i] + reflectance_ * gathered;
      change = std::max(change, std::abs(next[i] - all[i]));
    }
    all.swap(next);
    if (change <= kSettled * mean_lx) break;
  }
  return all;
}

}  // namespace lightcal
