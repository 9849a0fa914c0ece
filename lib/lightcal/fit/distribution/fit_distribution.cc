// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/distribution/fit_distribution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/statistics.h"
#include "lightcal/core/units.h"
#include "lightcal/fit/distribution/chart_samples.h"
#include "lightcal/fit/distribution/intensity_surface.h"
#include "lightcal/light/lamp_axes.h"

namespace lightcal {
namespace {

using fit::ChartGrid;
using fit::ChartSample;
using fit::SurfaceProblem;

constexpr int kFewestSamples = 100;
constexpr double kAzimuthStep = 5.0;
constexpr std::array<int, 5> kIntervals = {6, 9, 13, 18, 24};  // knots over the longer side
constexpr std::array<double, 5> kLambdas = {1e-7, 1e-6, 1e-5, 1e-4, 1e-3};
constexpr double kWorthwhile = 0.97;  // finer knots must lower the score by this
constexpr double kOutlier = 6.0;      // robust sigmas
constexpr double kManyOutliers = 0.1;
constexpr double kNoticed = 0.01;        // share of the flux that was never seen
constexpr double kInterpolatedSd = 0.1;  // of the flux where nothing was seen

struct Surface {
  ChartGrid grid;
  double lambda = 0.0;
  SurfaceProblem problem;
  std::vector<double> coefficients;

  [[nodiscard]] double At(double u, double v, const std::vector<double>& of) const {
    const ChartGrid::Support support = grid.At(u, v);
    double sum = 0.0;
    for (std::size_t i = 0; i < support.index.size(); ++i) {
      sum += support.factor[i] * of[static_cast<std::size_t>(support.index[i])];
    }
    return sum;
  }
};

// Knots from coarse to fine while that pays; smoothing for each.
Surface ChooseSurface(const std::vector<ChartSample>& chart) {
  std::optional<Surface> best;
  double score = std::numeric_limits<double>::infinity();
  for (const int intervals : kIntervals) {
    const ChartGrid grid = fit::GridOver(chart, intervals);
    SurfaceProblem problem(grid, chart);
    double least = std::numeric_limits<double>::infinity(), lambda = kLambdas.front();
    for (const double candidate : kLambdas) {
      const double value = problem.CrossValidation(candidate);
      if (!(value < least)) break;  // one minimum: smoother still is worse
      least = value;
      lambda = candidate;
    }
    if (best && !(least < kWorthwhile * score)) break;
    score = least;
    best = Surface{grid, lambda, std::move(problem), {}};
  }
  return *std::move(best);
}

// Takes the weight of samples that lie off the surface; returns how many.
int Reject(const Surface& surface, std::vector<ChartSample>& chart) {
  std::vector<double> off;
  for (const ChartSample& s : chart) {
    if (s.weight > 0.0) {
      off.push_back(std::abs(s.value - surface.At(s.u, s.v, surface.coefficients)) *
                    std::sqrt(s.weight));
    }
  }
  const double sigma = kSdPerMad * UpperMedian(off);
  int rejected = 0;
  for (ChartSample& s : chart) {
    if (!(s.weight > 0.0)) continue;
    const double residual =
        std::abs(s.value - surface.At(s.u, s.v, surface.coefficients)) * std::sqrt(s.weight);
    if (residual > kOutlier * sigma && residual > kOutlier) {
      s.weight = 0.0;
      ++rejected;
    }
  }
  return rejected;
}

struct Nodes {
  std::vector<double> c_deg, gamma_deg;
};

Nodes NodesFor(const Surface& surface, double covered) {
  const double spacing_deg = surface.grid.spacing / kRadiansPerDegree;
  double step = 0.5;
  for (const double coarser : {1.0, 2.0, 2.5}) {
    if (coarser <= spacing_deg / 4.0) step = coarser;
  }
  Nodes nodes;
  const int count = static_cast<int>(covered / kRadiansPerDegree / step);
  for (int i = 0; i <= count; ++i) nodes.gamma_deg.push_back(step * i);
  for (double c = 0.0; c < 360.0 - 1e-9; c += kAzimuthStep) nodes.c_deg.push_back(c);
  return nodes;
}

template <class Visit>
void ForEachNode(const Nodes& nodes, const Visit& visit) {
  for (const double c : nodes.c_deg) {
    for (const double gamma : nodes.gamma_deg) {
      visit(gamma * kRadiansPerDegree * std::cos(c * kRadiansPerDegree),
            gamma * kRadiansPerDegree * std::sin(c * kRadiansPerDegree), gamma * kRadiansPerDegree);
    }
  }
}

Result<IntensityTable> TableOf(const Surface& surface, const std::vector<double>& coefficients,
                               const Nodes& nodes, const std::string& light) {
  IntensityGrid grid;
  grid.horizontal_deg = nodes.c_deg;
  grid.vertical_deg = nodes.gamma_deg;
  ForEachNode(nodes, [&](double u, double v, double /*gamma*/) {
    grid.candela.push_back(std::max(0.0, surface.At(u, v, coefficients)));
  });
  return IntensityTable::Make(std::move(grid), light);
}

// The factor of each coefficient in the flux: nodes weighted by their solid angle.
std::vector<double> FluxFunctional(const Surface& surface, const Nodes& nodes) {
  std::vector<double> out(static_cast<std::size_t>(surface.grid.Size()), 0.0);
  const double cell = kAzimuthStep * kRadiansPerDegree * (nodes.gamma_deg[1] - nodes.gamma_deg[0]) *
                      kRadiansPerDegree;
  ForEachNode(nodes, [&](double u, double v, double gamma) {
    const ChartGrid::Support support = surface.grid.At(u, v);
    for (std::size_t i = 0; i < support.index.size(); ++i) {
      out[static_cast<std::size_t>(support.index[i])] += cell * std::sin(gamma) * support.factor[i];
    }
  });
  return out;
}

std::vector<double> ValueFunctional(const Surface& surface, double u, double v) {
  std::vector<double> out(static_cast<std::size_t>(surface.grid.Size()), 0.0);
  const ChartGrid::Support support = surface.grid.At(u, v);
  for (std::size_t i = 0; i < support.index.size(); ++i) {
    out[static_cast<std::size_t>(support.index[i])] += support.factor[i];
  }
  return out;
}

// Share of the flux in chart cells of half a knot spacing that no sample fell into, directions
// between which and the next sample on every side something was seen.
double InterpolatedShare(const Surface& surface, const std::vector<ChartSample>& chart,
                         const Nodes& nodes) {
  // Samples lie about sqrt(area / count) apart; cells of three times that are empty in holes only.
  const ChartGrid& grid = surface.grid;
  const double area = (grid.columns - 3) * (grid.rows - 3) * grid.spacing * grid.spacing;
  const double cell = 3.0 * std::sqrt(area / static_cast<double>(chart.size()));
  const auto columns = static_cast<std::size_t>((grid.columns - 3) * grid.spacing / cell) + 1;
  const auto rows = static_cast<std::size_t>((grid.rows - 3) * grid.spacing / cell) + 1;
  const auto cell_of = [&](double u, double v) {
    const auto x = static_cast<std::size_t>(std::max(0.0, (u - grid.u0) / cell));
    const auto y = static_cast<std::size_t>(std::max(0.0, (v - grid.v0) / cell));
    return std::min(y, rows - 1) * columns + std::min(x, columns - 1);
  };
  std::vector<bool> seen(columns * rows, false);
  for (const ChartSample& s : chart) {
    if (s.weight > 0.0) seen[cell_of(s.u, s.v)] = true;
  }
  double whole = 0.0, hidden = 0.0;
  ForEachNode(nodes, [&](double u, double v, double gamma) {
    const double flux = std::sin(gamma) * surface.At(u, v, surface.coefficients);
    whole += flux;
    if (!seen[cell_of(u, v)]) hidden += flux;
  });
  return whole > 0.0 ? hidden / whole : 0.0;
}

double RmsOf(const Surface& surface, const std::vector<ChartSample>& chart, double peak) {
  double sum = 0.0;
  int count = 0;
  for (const ChartSample& s : chart) {
    if (!(s.weight > 0.0)) continue;
    const double value = surface.At(s.u, s.v, surface.coefficients);
    const double relative = (s.value - value) / std::max(value, fit::kDarkDirection * peak);
    sum += relative * relative;
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0.0;
}

// Mean of what is left over within three halves of a spacing of a point: what the knots are too
// coarse, or the model too simple, for.
double LeftOverAround(const Surface& surface, const std::vector<ChartSample>& chart, double u,
                      double v) {
  double sum = 0.0;
  int count = 0;
  for (const ChartSample& s : chart) {
    const bool near = std::hypot(s.u - u, s.v - v) < 1.5 * surface.grid.spacing;
    if (!(s.weight > 0.0) || !near) continue;
    sum += s.value - surface.At(s.u, s.v, surface.coefficients);
    ++count;
  }
  return count > 0 ? std::abs(sum / count) : 0.0;
}

using Part = FittedDistribution::Part;

Part& PartNamed(std::vector<Part>& budget, const std::string& name) {
  const auto found = std::ranges::find(budget, name, &Part::name);
  return found != budget.end() ? *found : budget.emplace_back(Part{name, 0.0, 0.0});
}

void AddTo(Part& part, double peak, double flux) {
  part.peak = std::hypot(part.peak, peak);
  part.flux = std::hypot(part.flux, flux);
}

// What every shift makes of peak and flux, the coefficients at zero staying there. To first order
// the largest intensity moves as the one where it was; the lesser of both is free of what a beam
// moved aside adds to the one, and a flat distribution's other heights to the other.
Result<void> AddShifts(const DistributionData& data, const LampAxes& axes, const Surface& surface,
                       const std::vector<ChartSample>& chart, const Nodes& nodes,
                       FittedDistribution& out) {
  const double peak = out.table.peak().intensity.value(), flux = out.table.Flux().value();
  const double u = out.table.peak().gamma.value() * std::cos(out.table.peak().c.value());
  const double v = out.table.peak().gamma.value() * std::sin(out.table.peak().c.value());
  for (const DistributionShift& shift : data.shifts) {
    std::vector<ChartSample> moved = fit::OnChart(axes, shift.samples, peak);
    for (std::size_t i = 0; i < moved.size(); ++i) {
      // A sample that this shift loses counts as it stands.
      if (!(moved[i].weight > 0.0)) moved[i] = chart[i];
      moved[i].weight = chart[i].weight;
    }
    const SurfaceProblem problem(surface.grid, moved);
    const auto x = problem.SolveWithZeros(surface.lambda, surface.coefficients);
    const auto table = TableOf(surface, x, nodes, data.light);
    if (!table) return tl::unexpected(table.error());
    const double off = std::min(std::abs(table->peak().intensity.value() / peak - 1.0),
                                std::abs(surface.At(u, v, x) / peak - 1.0));
    AddTo(PartNamed(out.budget, shift.name), off, table->Flux().value() / flux - 1.0);
  }
  return {};
}

void AddNoise(const Surface& surface, const std::vector<ChartSample>& chart, const Nodes& nodes,
              FittedDistribution& out) {
  const auto& peak = out.table.peak();
  const double flux = out.table.Flux().value();
  const double u = peak.gamma.value() * std::cos(peak.c.value());
  const double v = peak.gamma.value() * std::sin(peak.c.value());
  const double chi2 = surface.problem.ReducedChi2(surface.lambda, surface.coefficients);
  const auto sd = [&](const std::vector<double>& functional) {
    return std::sqrt(chi2 *
                     surface.problem.Variance(surface.lambda, surface.coefficients, functional));
  };
  AddTo(PartNamed(out.budget, "noise"), sd(ValueFunctional(surface, u, v)) / peak.intensity.value(),
        sd(FluxFunctional(surface, nodes)) / flux);
  AddTo(PartNamed(out.budget, "misfit"),
        LeftOverAround(surface, chart, u, v) / peak.intensity.value(),
        kInterpolatedSd * out.interpolated_share);
}

void SumUp(double scale_sd, FittedDistribution& out) {
  AddTo(PartNamed(out.budget, "scale"), scale_sd, scale_sd);
  double peak = 0.0, flux = 0.0;
  for (const Part& part : out.budget) {
    peak = std::hypot(peak, part.peak);
    flux = std::hypot(flux, part.flux);
  }
  out.peak_cd = UncertainFromLog(std::log(out.table.peak().intensity.value()), peak);
  out.flux_lm = UncertainFromLog(std::log(out.table.Flux().value()), flux);
}

void WarnOf(const std::string& light, FittedDistribution& out) {
  if (out.interpolated_share > kNoticed) {
    out.warnings.push_back(
        {"interpolated_directions", light,
         PercentText(out.interpolated_share) +
             " of the flux lies in directions that were never seen (the board, masks, what was "
             "saturated); hang the board beside the beam, or take it down for the frames and name "
             "its picture with board_frame"});
  }
  if (out.rejected > kManyOutliers * out.samples) {
    out.warnings.push_back({"wall_uneven", light,
                            std::to_string(out.rejected) + " of " + std::to_string(out.samples) +
                                " pieces of the wall do not fit a smooth distribution; give the "
                                "plain part with rect, or leave things out with masks"});
  }
}

}  // namespace

Result<FittedDistribution> FitDistribution(const DistributionData& data) {
  const LampAxes axes = AxesOfAim(data.aim);
  const double rough = fit::RoughPeak(data.samples);
  std::vector<ChartSample> chart = fit::OnChart(axes, data.samples, rough);
  const auto usable =
      std::ranges::count_if(chart, [](const ChartSample& s) { return s.weight > 0.0; });
  if (usable < kFewestSamples || !(rough > 0.0)) {
    return Refused("too_few_directions", data.light,
                   "only " + std::to_string(usable) + " directions carry light; " +
                       std::to_string(kFewestSamples) + " are needed");
  }
  const double covered = fit::CoveredCone(chart);
  if (!(covered > 3.0 * kRadiansPerDegree)) {
    return Refused("axis_not_covered", data.light,
                   "the wall was not seen on every side of the lamp's aim; give aim = the middle "
                   "of what the picture shows, or show more of the wall");
  }
  Surface surface = ChooseSurface(chart);
  const auto solve = [&]() -> Result<void> {
    auto x = surface.problem.SolveNonNegative(surface.lambda);
    if (!x) return Propagate(std::move(x));
    surface.coefficients = *std::move(x);
    return {};
  };
  if (auto solved = solve(); !solved) return Propagate(std::move(solved));
  const int rejected = Reject(surface, chart);
  if (rejected > 0) {
    surface.problem = SurfaceProblem(surface.grid, chart);
    if (auto solved = solve(); !solved) return Propagate(std::move(solved));
  }
  const Nodes nodes = NodesFor(surface, covered);
  auto table = TableOf(surface, surface.coefficients, nodes, data.light);
  if (!table) return Propagate(std::move(table));
  FittedDistribution out{.table = *std::move(table)};
  out.covered_deg = nodes.gamma_deg.back();
  out.samples = static_cast<int>(usable);
  out.rejected = rejected;
  out.degrees_of_freedom =
      std::max(0, out.samples - rejected - static_cast<int>(surface.coefficients.size()));
  out.spacing_deg = surface.grid.spacing / kRadiansPerDegree;
  out.rms_relative = RmsOf(surface, chart, out.table.peak().intensity.value());
  out.interpolated_share = InterpolatedShare(surface, chart, nodes);
  AddNoise(surface, chart, nodes, out);
  if (auto added = AddShifts(data, axes, surface, chart, nodes, out); !added) {
    return Propagate(std::move(added));
  }
  SumUp(data.scale_sd, out);
  WarnOf(data.light, out);
  return out;
}

}  // namespace lightcal
