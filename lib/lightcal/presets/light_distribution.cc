// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/light_distribution.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "lightcal/photometry/spot_cone.h"

namespace lightcal {
namespace {

constexpr double kJumpDeg = 0.01;  // how steeply a table that ends in light goes dark

std::vector<double> EvenAngles(double to, int steps) {
  std::vector<double> out;
  for (int i = 0; i <= steps; ++i) out.push_back(to * i / steps);
  return out;
}

// Relative intensity at c and gamma, in degrees.
using Profile = std::function<double(double, double)>;

Result<IntensityTable> Sampled(std::vector<double> c_deg, std::vector<double> gamma_deg,
                               double intensity_cd, const Profile& profile) {
  IntensityGrid grid{GoniometerType::kC, std::move(c_deg), std::move(gamma_deg), {}};
  for (const double c : grid.horizontal_deg) {
    for (const double gamma : grid.vertical_deg) {
      grid.candela.push_back(intensity_cd * std::max(0.0, profile(c, gamma)));
    }
  }
  return IntensityTable::Make(std::move(grid), "light");
}

double Cosine(double degrees) {
  // Exact where tables end.
  return degrees == 90.0 ? 0.0 : std::cos(RadiansFromDegrees(degrees).value());
}

Result<IntensityTable> SpotTable(double intensity_cd, double inner_deg, double outer_deg) {
  const SpotCone cone{RadiansFromDegrees(std::min(inner_deg, outer_deg)),
                      RadiansFromDegrees(outer_deg)};
  constexpr double kStepDeg = 0.5;
  constexpr int kLeastSteps = 8;
  const bool hard = inner_deg >= outer_deg;
  const double first = hard ? 0.0 : inner_deg;
  const int steps =
      std::max(kLeastSteps, static_cast<int>(std::ceil((outer_deg - first) / kStepDeg)));
  const double step = (outer_deg - first) / steps;
  std::vector<double> gamma = {0.0};
  // Two more nodes on either side of the penumbra: Cycles draws cubics through four neighbours.
  for (const int i : {-2, -1, 0}) {
    if (const double at = first + i * step; at > 0.0) gamma.push_back(at);
  }
  for (int i = 1; i <= steps; ++i) gamma.push_back(first + step * i);
  for (const int i : {1, 2}) {
    if (const double at = outer_deg + i * step; !hard && at < 180.0) gamma.push_back(at);
  }
  // A hard edge still needs room to fall in.
  if (hard && outer_deg + kJumpDeg < 180.0) gamma.push_back(outer_deg + kJumpDeg);
  if (gamma.back() < 180.0) gamma.push_back(180.0);
  return Sampled({0.0}, std::move(gamma), intensity_cd, [&](double, double g) {
    const SpotFalloff law = hard ? SpotFalloff::kHard : SpotFalloff::kSquaredLinear;
    // Nodes on the rim itself count as inside.
    if (hard && g <= outer_deg) return 1.0;
    return SpotAttenuation(RadiansFromDegrees(g), cone, law);
  });
}

// ---- measured tables ----

// Nothing where the table ends, down to nadir and up to zenith.
void CoverSphere(IntensityGrid& grid) {
  const auto add = [&](double at, bool in_front) {
    const std::size_t nv = grid.vertical_deg.size();
    grid.vertical_deg.insert(in_front ? grid.vertical_deg.begin() : grid.vertical_deg.end(), at);
    std::vector<double> candela;
    for (std::size_t p = 0; p < grid.horizontal_deg.size(); ++p) {
      const auto row = grid.candela.begin() + static_cast<std::ptrdiff_t>(p * nv);
      if (in_front) candela.push_back(0.0);
      candela.insert(candela.end(), row, row + static_cast<std::ptrdiff_t>(nv));
      if (!in_front) candela.push_back(0.0);
    }
    grid.candela = std::move(candela);
  };
  if (const double first = grid.vertical_deg.front(); first > 0.0) {
    if (first > kJumpDeg) add(first - kJumpDeg, true);
    add(0.0, true);
  }
  if (const double last = grid.vertical_deg.back(); last < 180.0) {
    if (last < 180.0 - kJumpDeg) add(last + kJumpDeg, false);
    add(180.0, false);
  }
}

// Readers pick the value at a pole from different planes.
void UnifyPoles(IntensityGrid& grid) {
  const std::size_t nv = grid.vertical_deg.size();
  const std::size_t nh = grid.horizontal_deg.size();
  for (const std::size_t v : {std::size_t{0}, nv - 1}) {
    double sum = 0.0;
    for (std::size_t p = 0; p < nh; ++p) sum += grid.candela[p * nv + v];
    for (std::size_t p = 0; p < nh; ++p) grid.candela[p * nv + v] = sum / static_cast<double>(nh);
  }
}

Result<IntensityTable> MeasuredTable(const IntensityTable& table) {
  IntensityGrid grid = table.grid();
  if (grid.type != GoniometerType::kC) {
    const auto as_c = SampledAsTypeC(table, EvenAngles(360.0, 144), EvenAngles(180.0, 180),
                                     TableInterpolation::kLinear);
    if (!as_c) return as_c;
    grid = as_c->grid();
  }
  CoverSphere(grid);
  UnifyPoles(grid);
  return IntensityTable::Make(std::move(grid), "light");
}

// The part of a turn each stored plane stands for: half the way to both neighbours, within what is
// stored of a mirrored lamp, round the turn otherwise.
std::vector<double> PlaneShares(const IntensityTable& table) {
  constexpr double kTurn = 360.0, kSame = 1e-6;
  const std::vector<double>& c = table.grid().horizontal_deg;
  if (c.size() == 1) return {1.0};
  std::vector<double> shares(c.size(), 0.0);
  const bool open = table.symmetry() == TableSymmetry::kNone && c.back() < kTurn - kSame;
  const double whole = open ? kTurn : c.back() - c.front();
  for (std::size_t i = 0; i + 1 < c.size(); ++i) {
    const double half = (c[i + 1] - c[i]) / (2.0 * whole);
    shares[i] += half;
    shares[i + 1] += half;
  }
  if (open) {
    const double half = (kTurn - c.back()) / (2.0 * whole);
    shares.front() += half;
    shares.back() += half;
  }
  return shares;
}

}  // namespace

Result<RoundTable> RoundAboutAim(const IntensityTable& table) {
  const IntensityGrid& grid = table.grid();
  const std::vector<double> shares = PlaneShares(table);
  const std::size_t nv = grid.vertical_deg.size();
  IntensityGrid round{GoniometerType::kC, {0.0}, grid.vertical_deg, std::vector<double>(nv, 0.0)};
  for (std::size_t i = 0; i < grid.candela.size(); ++i) {
    round.candela[i % nv] += shares[i / nv] * grid.candela[i];
  }
  double worst = 0.0, at = 0.0;  // both are linear between nodes
  for (std::size_t i = 0; i < grid.candela.size(); ++i) {
    const double off = std::abs(round.candela[i % nv] - grid.candela[i]);
    if (off <= worst) continue;
    worst = off;
    at = grid.vertical_deg[i % nv];
  }
  auto made = IntensityTable::Make(std::move(round), "light");
  if (!made) return Propagate(std::move(made));
  return RoundTable{*std::move(made), worst, RadiansFromDegrees(at)};
}

Result<std::optional<IntensityTable>> DistributionOf(const FittedLight& lamp) {
  const auto given = [](Result<IntensityTable>&& table) -> Result<std::optional<IntensityTable>> {
    if (!table) return Propagate(std::move(table));
    return std::optional<IntensityTable>(*std::move(table));
  };
  if (lamp.distribution) return given(MeasuredTable(lamp.distribution->table));
  if (!lamp.intensity_cd || !(lamp.intensity_cd->value > 0.0)) return std::nullopt;
  const double cd = lamp.intensity_cd->value;
  switch (lamp.kind) {
    case LightKind::kSpot:
    case LightKind::kPhotometric:
      if (lamp.outer_deg && *lamp.outer_deg > 0.0) {
        return given(SpotTable(cd, lamp.inner_deg.value_or(0.0), *lamp.outer_deg));
      }
      [[fallthrough]];
    case LightKind::kPoint:
    case LightKind::kSphere:
      return given(Sampled({0.0}, EvenAngles(180.0, 36), cd, [](double, double) { return 1.0; }));
    case LightKind::kDisk:
    case LightKind::kRect:
      return given(Sampled({0.0}, EvenAngles(180.0, 180), cd,
                           [](double, double g) { return g < 90.0 ? Cosine(g) : 0.0; }));
    case LightKind::kTube:
      return given(Sampled(EvenAngles(90.0, 18), EvenAngles(180.0, 90), cd, [](double c, double g) {
        const double along = Cosine(90.0 - g) * Cosine(c);
        return std::sqrt(std::max(0.0, 1.0 - along * along));
      }));
    case LightKind::kDirectional:
    case LightKind::kDome:
      break;
  }
  return std::nullopt;
}

}  // namespace lightcal
