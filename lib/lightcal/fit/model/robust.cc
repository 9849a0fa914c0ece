// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/robust.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lightcal/core/statistics.h"
#include "lightcal/fit/model/starts.h"

namespace lightcal::fit {
namespace {

constexpr int kFewestForRejection = 5;
constexpr int kFewestForPairs = 6;
constexpr std::size_t kMostForLeaveOut = 9;

std::vector<double> Residuals(const Estimation& estimation, const Theta& theta) {
  std::vector<double> residuals;
  residuals.reserve(estimation.rows.size());
  for (const ReadingRow& row : estimation.rows) residuals.push_back(RowResidual(row, theta));
  return residuals;
}

double MedianAbsolute(std::vector<double> values) {
  for (double& v : values) v = std::abs(v);
  return Median(values);
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

// ln(E d^2) of four readings falls into two pairs, each close within itself.
bool TwoAgainstTwo(const Estimation& estimation) {
  std::vector<std::pair<double, double>> values;  // ln(E d^2), sigma
  for (const ReadingRow& row : estimation.rows) {
    if (row.form != ReadingRow::Form::kLog || !(row.direct_gain > 0.0)) continue;
    values.emplace_back(std::log(row.measured / LuxPerCandela(row, 0.0)), row.sigma);
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
  return Solve(estimation, StartOf(estimation));
}

// Sum of Tukey's loss, in units of its plateau: each reading beyond the constant counts 1.
double TukeyLossOf(const Estimation& estimation, const Theta& theta, double scale) {
  double sum = 0.0;
  for (const ReadingRow& row : estimation.rows) {
    const double u = RowResidual(row, theta) / (kTukeyConstant * scale);
    const double left = std::max(0.0, 1.0 - u * u);
    sum += 1.0 - left * left * left;
  }
  const ParameterRule& offset = estimation.rules[kDistanceOffset];
  if (offset.free && offset.prior_sd > 0.0) {
    const double z = (theta[kDistanceOffset] - offset.prior_mean) / offset.prior_sd;
    sum += 3.0 * z * z / (kTukeyConstant * kTukeyConstant);
  }
  return sum;
}

// Squared-loss estimates with one reading, then each pair, left out: for few readings the only
// starts that a blunder at the nearest or farthest distance cannot reach.
void AddLeaveOutStarts(const Estimation& estimation, std::vector<Theta>& starts) {
  const auto n = static_cast<int>(estimation.rows.size());
  const auto add = [&](const std::vector<int>& left_out) {
    Estimation rest = estimation;
    rest.rows = Without(estimation.rows, left_out);
    if (Result<Theta> theta = SolveSquared(rest)) starts.push_back(*theta);
  };
  for (int i = 0; i < n; ++i) {
    add({i});
    for (int j = i + 1; n >= kFewestForPairs && j < n; ++j) add({i, j});
  }
}

Result<RobustEstimate> RejectAndRefit(const Estimation& estimation, const Theta& squared) {
  const Theta median = MedianStart(estimation);
  Result<Theta> huber = Solve(estimation, median, Loss::kHuber);
  if (!huber) return Propagate(std::move(huber));
  std::vector<Theta> starts = {*huber, median};
  if (estimation.rows.size() <= kMostForLeaveOut) AddLeaveOutStarts(estimation, starts);
  double scale = RobustScale(estimation, starts.front());
  for (const Theta& start : starts) scale = std::min(scale, RobustScale(estimation, start));
  const auto best =
      std::min_element(starts.begin(), starts.end(), [&](const Theta& a, const Theta& b) {
        return TukeyLossOf(estimation, a, scale) < TukeyLossOf(estimation, b, scale);
      });
  Result<Theta> tukey = Solve(estimation, *best, Loss::kTukey, scale);
  if (!tukey) return Propagate(std::move(tukey));
  RobustEstimate out{squared, estimation, {}, {}, false};
  out.rejected = Beyond(Residuals(estimation, *tukey), kTukeyConstant * scale);
  if (out.rejected.empty()) return out;
  out.kept.rows = Without(estimation.rows, out.rejected);
  Result<Theta> refit = Solve(out.kept, *tukey);
  if (!refit) return Propagate(std::move(refit));
  out.theta = *refit;
  return out;
}

}  // namespace

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

Result<RobustEstimate> EstimateRobustly(const Estimation& estimation, const Theta* known) {
  Result<Theta> squared = known != nullptr ? Result<Theta>(*known) : SolveSquared(estimation);
  if (!squared) return Propagate(std::move(squared));
  RobustEstimate out{*squared, estimation, {}, {}, false};
  const std::vector<int> far = Beyond(Residuals(estimation, *squared), kSuspiciousResidual);
  const auto lit = std::count_if(estimation.rows.begin(), estimation.rows.end(),
                                 [](const ReadingRow& row) { return row.direct_gain > 0.0; });
  if (far.empty() || !estimation.choice.reject) return out;
  if (lit >= kFewestForRejection) return RejectAndRefit(estimation, *squared);
  out.suspicious = far;
  if (lit == 4) {
    out.bimodal = TwoAgainstTwo(estimation);
    // Between two camps of equal weight Huber's loss is flat; the squared one stays in the middle.
    if (out.bimodal) return out;
    Result<Theta> huber = Solve(estimation, MedianStart(estimation), Loss::kHuber);
    if (!huber) return Propagate(std::move(huber));
    out.theta = *huber;
    out.suspicious = Beyond(Residuals(estimation, *huber), kSuspiciousResidual);
  }
  return out;
}

}  // namespace lightcal::fit
