// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/robust.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lightcal/fit/starts.h"

namespace lightcal::fit {
namespace {

constexpr double kSdPerMad = 1.4826;  // of a normal variable
constexpr int kFewestForRejection = 5;

std::vector<double> Residuals(const Estimation& estimation, const Theta& theta) {
  std::vector<double> residuals;
  residuals.reserve(estimation.rows.size());
  for (const ReadingRow& row : estimation.rows) residuals.push_back(RowResidual(row, theta));
  return residuals;
}

double MedianAbsolute(std::vector<double> values) {
  for (double& v : values) v = std::abs(v);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  const double upper = *middle;
  return 0.5 * (upper + *std::max_element(values.begin(), middle));
}

double RobustScale(const Estimation& estimation, const Theta& theta) {
  return std::max(1.0, kSdPerMad * MedianAbsolute(Residuals(estimation, theta)));
}

std::vector<int> Beyond(const std::vector<double>& residuals, double limit) {
  std::vector<int> out;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    if (std::abs(residuals[i]) > limit) out.push_back(static_cast<int>(i));
  }
  return out;
}

std::vector<ReadingRow> Without(const std::vector<ReadingRow>& rows,
                                const std::vector<int>& rejected) {
  std::vector<ReadingRow> kept;
  kept.reserve(rows.size());
  auto next = rejected.begin();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (next != rejected.end() && *next == static_cast<int>(i)) {
      ++next;
    } else {
      kept.push_back(rows[i]);
    }
  }
  return kept;
}

// ln(E d^2) of four readings falls into two pairs, each close within itself.
bool TwoAgainstTwo(const Estimation& estimation) {
  std::vector<std::pair<double, double>> values;  // ln(E d^2), sigma
  for (const ReadingRow& row : estimation.rows) {
    if (row.form != ReadingRow::Form::kLog || !(row.direct_gain > 0.0)) continue;
    values.emplace_back(std::log(row.measured * row.distance * row.distance / row.direct_gain),
                        row.sigma);
  }
  if (values.size() != 4) return false;
  std::sort(values.begin(), values.end());
  const double within =
      std::max(values[1].first - values[0].first, values[3].first - values[2].first);
  const double between = values[2].first - values[1].first;
  double sigma = 0.0;
  for (const auto& v : values) sigma = std::max(sigma, v.second);
  return between > 5.0 * sigma && between > 3.0 * within;
}

Result<Theta> SolveSquared(const Estimation& estimation) {
  const ParameterRule& ambient = estimation.rules[kAmbient];
  const Theta start =
      ambient.free ? ScanStart(estimation) : ClosedFormStart(estimation, ambient.prior_mean);
  return Solve(estimation, start);
}

Result<RobustEstimate> RejectAndRefit(const Estimation& estimation, const Theta& squared) {
  Result<Theta> huber = Solve(estimation, MedianStart(estimation), Loss::kHuber);
  if (!huber) return Propagate(std::move(huber));
  const double scale = RobustScale(estimation, *huber);
  Result<Theta> tukey = Solve(estimation, *huber, Loss::kTukey, scale);
  if (!tukey) return Propagate(std::move(tukey));
  RobustEstimate out{squared, estimation, {}, {}, false};
  out.rejected = Beyond(Residuals(estimation, *tukey),
                        kTukeyConstant * std::min(scale, RobustScale(estimation, *tukey)));
  if (out.rejected.empty()) return out;
  out.kept.rows = Without(estimation.rows, out.rejected);
  Result<Theta> refit = Solve(out.kept, *tukey);
  if (!refit) return Propagate(std::move(refit));
  out.theta = *refit;
  return out;
}

}  // namespace

Result<RobustEstimate> EstimateRobustly(const Estimation& estimation) {
  Result<Theta> squared = SolveSquared(estimation);
  if (!squared) return Propagate(std::move(squared));
  RobustEstimate out{*squared, estimation, {}, {}, false};
  const std::vector<int> far = Beyond(Residuals(estimation, *squared), kSuspiciousResidual);
  const auto lit = std::count_if(estimation.rows.begin(), estimation.rows.end(),
                                 [](const ReadingRow& row) { return row.direct_gain > 0.0; });
  if (far.empty()) return out;
  if (lit >= kFewestForRejection) return RejectAndRefit(estimation, *squared);
  out.suspicious = far;
  if (lit == 4) {
    out.bimodal = TwoAgainstTwo(estimation);
    Result<Theta> huber = Solve(estimation, MedianStart(estimation), Loss::kHuber);
    if (!huber) return Propagate(std::move(huber));
    out.theta = *huber;
    out.suspicious = Beyond(Residuals(estimation, *huber), kSuspiciousResidual);
  }
  return out;
}

}  // namespace lightcal::fit
