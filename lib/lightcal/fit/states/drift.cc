// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/states/drift.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lightcal::fit {
namespace {

// Of the whole time read over, 1 sigma of ln, and how often lamps walk so far.
struct Walk {
  double sd, weight;
};
constexpr std::array<Walk, 8> kWalks = {{{0.0, 1.0},
                                         {0.002, 1.0},
                                         {0.005, 1.0},
                                         {0.01, 1.0},
                                         {0.02, 1.0},
                                         {0.05, 0.4},
                                         {0.1, 0.15},
                                         {0.2, 0.05}}};
constexpr double kAnyLevel = 25.0;

LogAt MeanLog(const std::vector<DatedLog>& readings) {
  double weights = 0.0;
  double sum = 0.0;
  for (const DatedLog& one : readings) {
    weights += 1.0 / one.variance;
    sum += one.ln / one.variance;
  }
  LogAt mean{sum / weights, 1.0 / weights};
  double chi2 = 0.0;
  for (const DatedLog& one : readings) {
    chi2 += (one.ln - mean.ln) * (one.ln - mean.ln) / one.variance;
  }
  if (readings.size() > 1) {
    mean.variance *= std::max(1.0, chi2 / static_cast<double>(readings.size() - 1));
  }
  return mean;
}

}  // namespace

LogAt DriftedLog(const std::vector<DatedLog>& readings, std::optional<double> seconds) {
  const bool dated = seconds && std::ranges::all_of(readings, [](const DatedLog& one) {
                       return one.seconds.has_value();
                     });
  if (!dated || readings.size() < 2) return MeanLog(readings);
  double first = *seconds;
  double from = std::numeric_limits<double>::infinity();
  double to = -from;
  for (const DatedLog& one : readings) {
    from = std::min(from, *one.seconds);
    to = std::max(to, *one.seconds);
  }
  first = std::min(first, from);
  if (!(to > from)) return MeanLog(readings);
  const auto n = static_cast<Eigen::Index>(readings.size());
  const auto at = [&](Eigen::Index i) { return readings[static_cast<std::size_t>(i)]; };
  const double level = MeanLog(readings).ln;
  struct Walked {
    double evidence = 0.0, ln = 0.0, variance = 0.0;
  };
  std::vector<Walked> all;
  double best = -std::numeric_limits<double>::infinity();
  for (const auto& [walk, weight] : kWalks) {
    const auto covariance = [&](double a, double b) {
      return kAnyLevel + walk * walk * (std::min(a, b) - first) / (to - from);
    };
    Eigen::MatrixXd matrix(n, n);
    Eigen::VectorXd off(n);
    Eigen::VectorXd row(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) {
        matrix(i, j) = covariance(*at(i).seconds, *at(j).seconds);
      }
      matrix(i, i) += at(i).variance;
      off[i] = at(i).ln - level;
      row[i] = covariance(*at(i).seconds, *seconds);
    }
    const Eigen::LLT<Eigen::MatrixXd> solver(matrix);
    if (solver.info() != Eigen::Success) continue;
    const Eigen::VectorXd weights = solver.solve(off);
    double evidence = std::log(weight) - 0.5 * off.dot(weights);
    for (Eigen::Index i = 0; i < n; ++i) evidence -= std::log(solver.matrixLLT()(i, i));
    const double variance = covariance(*seconds, *seconds) - row.dot(solver.solve(row));
    all.push_back({evidence, level + row.dot(weights), std::max(0.0, variance)});
    best = std::max(best, evidence);
  }
  if (all.empty()) return MeanLog(readings);
  double sum = 0.0;
  LogAt out;
  double square = 0.0;
  for (const Walked& one : all) {
    const double share = std::exp(one.evidence - best);
    sum += share;
    out.ln += share * (one.ln - level);
    square += share * (one.variance + (one.ln - level) * (one.ln - level));
  }
  out.ln /= sum;
  out.variance = std::max(0.0, square / sum - out.ln * out.ln);
  out.ln += level;
  return out;
}

}  // namespace lightcal::fit
