// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/solve.h"

#include <ceres/ceres.h>
#include <ceres/tiny_solver.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "lightcal/fit/model/costs/censored_illuminance_cost.h"
#include "lightcal/fit/model/costs/linear_illuminance_cost.h"
#include "lightcal/fit/model/costs/log_illuminance_cost.h"
#include "lightcal/fit/model/costs/normal_prior_cost.h"

namespace lightcal::fit {
namespace {

template <class Cost>
ceres::CostFunction* AutoDiff(const ReadingRow& row) {
  return new ceres::AutoDiffCostFunction<Cost, 1, 1, 1, 1>(new Cost{&row});
}

ceres::CostFunction* CostOf(const ReadingRow& row) {
  switch (row.form) {
    case ReadingRow::Form::kLinear:
      return AutoDiff<LinearIlluminanceCost>(row);
    case ReadingRow::Form::kCensored:
      return AutoDiff<CensoredIlluminanceCost>(row);
    case ReadingRow::Form::kLog:
      break;
  }
  return AutoDiff<LogIlluminanceCost>(row);
}

std::unique_ptr<ceres::LossFunction> LossOf(Loss loss, double scale) {
  switch (loss) {
    case Loss::kHuber:
      return std::make_unique<ceres::HuberLoss>(kHuberConstant * scale);
    case Loss::kTukey:
      return std::make_unique<ceres::TukeyLoss>(kTukeyConstant * scale);
    case Loss::kSquared:
      break;
  }
  return nullptr;
}

// The polish below takes the last digits; the large first trust region makes the first steps
// Gauss-Newton.
ceres::Solver::Options SolverOptions(Loss loss) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 200;
  options.function_tolerance = loss == Loss::kSquared ? 1e-12 : 1e-9;
  options.parameter_tolerance = loss == Loss::kSquared ? 1e-10 : 1e-7;
  options.gradient_tolerance = 1e-13;
  options.initial_trust_region_radius = 1e8;
  options.max_trust_region_radius = 1e16;
  return options;
}

ceres::Solver::Options LooseOptions(Loss loss) {
  ceres::Solver::Options options = SolverOptions(loss);
  options.function_tolerance = 1e-3;
  options.parameter_tolerance = 1e-4;
  return options;
}

template <class Cost, class T>
T EvaluateAs(const ReadingRow& row, const T* theta) {
  T residual(0.0);
  if (!Cost{&row}(&theta[kLnIntensity], &theta[kDistanceOffset], &theta[kAmbient], &residual)) {
    residual = T(std::numeric_limits<double>::infinity());
  }
  return residual;
}

template <class T>
T Evaluate(const ReadingRow& row, const T* theta) {
  switch (row.form) {
    case ReadingRow::Form::kLinear:
      return EvaluateAs<LinearIlluminanceCost>(row, theta);
    case ReadingRow::Form::kCensored:
      return EvaluateAs<CensoredIlluminanceCost>(row, theta);
    case ReadingRow::Form::kLog:
      break;
  }
  return EvaluateAs<LogIlluminanceCost>(row, theta);
}

void AddPriors(const Estimation& estimation, Theta& theta, ceres::Problem& problem) {
  for (int k = 0; k < kParameters; ++k) {
    const ParameterRule& rule = estimation.rules[k];
    if (!rule.free || !(rule.prior_sd > 0.0)) continue;
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<NormalPriorCost, 1, 1>(
                                 new NormalPriorCost{rule.prior_mean, rule.prior_sd}),
                             nullptr, &theta[k]);
  }
}

void AddBounds(const Estimation& estimation, Theta& theta, ceres::Problem& problem) {
  for (int k = 0; k < kParameters; ++k) {
    if (!estimation.rules[k].free) problem.SetParameterBlockConstant(&theta[k]);
  }
  if (estimation.rules[kDistanceOffset].free) {
    problem.SetParameterLowerBound(&theta[kDistanceOffset], 0, estimation.least_distance_offset);
  }
  if (estimation.rules[kAmbient].free) problem.SetParameterLowerBound(&theta[kAmbient], 0, 0.0);
}

bool AtBound(const Estimation& estimation, const Theta& theta, int k) {
  if (k == kAmbient) return theta[kAmbient] <= 0.0;
  return k == kDistanceOffset && theta[k] <= estimation.least_distance_offset;
}

// One Gauss-Newton step over the free parameters that are not at a bound. Ceres stops when the cost
// no longer falls, which leaves half of the digits of the parameters; a parameter held at its bound
// slows it further, because the step of the others is not the one along the bound.
Theta GaussNewtonStep(const Estimation& estimation, const Theta& theta) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (const ReadingRow& row : estimation.rows) {
    const RowDerivative at = DifferentiateRow(row, theta);
    const Eigen::Vector3d j(at.gradient[0], at.gradient[1], at.gradient[2]);
    normal += j * j.transpose();
    gradient += j * at.residual;
  }
  for (int k = 0; k < kParameters; ++k) {
    const ParameterRule& rule = estimation.rules[k];
    if (!rule.free || AtBound(estimation, theta, k)) {
      normal.row(k).setZero();
      normal.col(k).setZero();
      normal(k, k) = 1.0;
      gradient[k] = 0.0;
    } else if (rule.prior_sd > 0.0) {
      const double weight = 1.0 / (rule.prior_sd * rule.prior_sd);
      normal(k, k) += weight;
      gradient[k] += weight * (theta[k] - rule.prior_mean);
    }
  }
  const Eigen::Vector3d scale = normal.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::Matrix3d scaled = scale.asDiagonal() * normal * scale.asDiagonal();
  const Eigen::Vector3d step =
      -(scale.asDiagonal() * scaled.ldlt().solve(scale.asDiagonal() * gradient));
  return {theta[0] + step[0], theta[1] + step[1], theta[2] + step[2]};
}

// A few steps more, as long as they are small and the cost does not grow beyond rounding.
Theta Polish(const Estimation& estimation, Theta theta) {
  constexpr int kSteps = 8;
  constexpr double kLargestStep = 0.05;
  const double cost = HalfChiSquared(estimation, theta);
  for (int i = 0; i < kSteps; ++i) {
    const Theta next = GaussNewtonStep(estimation, theta);
    double step = 0.0;
    for (int k = 0; k < kParameters; ++k) step = std::max(step, std::abs(next[k] - theta[k]));
    const bool inside = next[kAmbient] >= 0.0 || !estimation.rules[kAmbient].free;
    if (!(step < kLargestStep) || !inside ||
        next[kDistanceOffset] < estimation.least_distance_offset) {
      break;
    }
    if (!(HalfChiSquared(estimation, next) <= cost * (1.0 + 1e-12) + 1e-20)) break;
    theta = next;
    if (step < 1e-13) break;
  }
  return theta;
}

// The rows and priors as TinySolver takes them, column-major; what is not free has no derivative.
class TinyRows {
 public:
  using Scalar = double;
  enum : int { NUM_PARAMETERS = kParameters, NUM_RESIDUALS = Eigen::Dynamic };

  TinyRows(const Estimation& estimation, bool hold_ambient) : estimation_(estimation) {
    for (int k = 0; k < kParameters; ++k) {
      free_[k] = estimation.rules[k].free && !(k == kAmbient && hold_ambient);
    }
  }
  [[nodiscard]] int NumResiduals() const {
    return static_cast<int>(estimation_.rows.size()) + kParameters;
  }
  bool operator()(const double* parameters, double* residuals, double* jacobian) const {
    const Theta theta = {parameters[0], parameters[1], parameters[2]};
    const int n = NumResiduals();
    const int rows = n - kParameters;
    for (int i = 0; i < rows; ++i) {
      const ReadingRow& row = estimation_.rows[static_cast<std::size_t>(i)];
      if (jacobian == nullptr) {
        residuals[i] = RowResidual(row, theta);
      } else {
        const RowDerivative at = DifferentiateRow(row, theta);
        residuals[i] = at.residual;
        for (int k = 0; k < kParameters; ++k) {
          jacobian[i + k * n] = free_[k] ? at.gradient[k] : 0.0;
        }
      }
      if (!std::isfinite(residuals[i])) return false;
    }
    for (int k = 0; k < kParameters; ++k) {
      const ParameterRule& rule = estimation_.rules[k];
      const double weight = free_[k] && rule.prior_sd > 0.0 ? 1.0 / rule.prior_sd : 0.0;
      residuals[rows + k] = weight * (theta[k] - rule.prior_mean);
      for (int j = 0; jacobian != nullptr && j < kParameters; ++j) {
        jacobian[rows + k + j * n] = j == k ? weight : 0.0;
      }
    }
    return true;
  }

 private:
  const Estimation& estimation_;
  std::array<bool, kParameters> free_{};
};

std::optional<Theta> SolveTiny(const Estimation& estimation, const Theta& start,
                               bool hold_ambient) {
  const TinyRows rows(estimation, hold_ambient);
  ceres::TinySolver<TinyRows> solver;
  solver.options.max_num_iterations = 40;
  solver.options.initial_trust_region_radius = 1e8;
  solver.options.gradient_tolerance = 1e-9;
  solver.options.function_tolerance = 1e-10;
  solver.options.parameter_tolerance = 1e-7;  // the polish takes the last digits
  Eigen::Vector3d x(start[0], start[1], start[2]);
  const auto& summary = solver.Solve(rows, &x);
  const bool converged = summary.status != ceres::TinySolver<TinyRows>::HIT_MAX_ITERATIONS;
  if (!converged || !x.allFinite() || !std::isfinite(summary.final_cost)) return std::nullopt;
  if (estimation.rules[kDistanceOffset].free && x[1] <= estimation.least_distance_offset) {
    return std::nullopt;
  }
  return Theta{x[0], x[1], x[2]};
}

// Slope of 1/2 chi-squared along E0.
double SlopeAlongAmbient(const Estimation& estimation, const Theta& theta) {
  double slope = 0.0;
  for (const ReadingRow& row : estimation.rows) {
    const RowDerivative at = DifferentiateRow(row, theta);
    slope += at.residual * at.gradient[kAmbient];
  }
  const ParameterRule& rule = estimation.rules[kAmbient];
  if (rule.prior_sd > 0.0) {
    slope += (theta[kAmbient] - rule.prior_mean) / (rule.prior_sd * rule.prior_sd);
  }
  return slope;
}

}  // namespace

std::optional<Theta> SolveCoarsely(const Estimation& estimation, const Theta& start) {
  std::optional<Theta> theta = SolveTiny(estimation, start, false);
  if (theta && estimation.rules[kAmbient].free && (*theta)[kAmbient] < 0.0) {
    theta = SolveTiny(estimation, {(*theta)[0], (*theta)[1], 0.0}, true);
    if (theta && SlopeAlongAmbient(estimation, *theta) < 0.0) return std::nullopt;
  }
  return theta;
}

std::optional<Theta> SolveQuickly(const Estimation& estimation, const Theta& start) {
  const std::optional<Theta> theta = SolveCoarsely(estimation, start);
  if (!theta) return std::nullopt;
  return Polish(estimation, *theta);
}

Result<Theta> Solve(const Estimation& estimation, const Theta& start, Loss loss, double scale) {
  const SolverChoice solver = estimation.choice.solver;
  if (solver == SolverChoice::kClosedForm) return start;
  if (loss == Loss::kSquared && solver == SolverChoice::kQuick) {
    if (const std::optional<Theta> theta = SolveQuickly(estimation, start)) return *theta;
  }
  return SolveInFull(estimation, start, loss, scale);
}

Result<Theta> SolveInFull(const Estimation& estimation, const Theta& start, Loss loss,
                          double scale) {
  Theta theta = start;
  const std::unique_ptr<ceres::LossFunction> loss_function = LossOf(loss, scale);
  ceres::Problem::Options problem_options;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.disable_all_safety_checks = true;
  ceres::Problem problem(problem_options);
  for (const ReadingRow& row : estimation.rows) {
    problem.AddResidualBlock(CostOf(row), loss_function.get(), &theta[kLnIntensity],
                             &theta[kDistanceOffset], &theta[kAmbient]);
  }
  AddPriors(estimation, theta, problem);
  AddBounds(estimation, theta, problem);
  ceres::Solver::Summary summary;
  const bool loose = estimation.choice.solver == SolverChoice::kLoose;
  ceres::Solve(loose ? LooseOptions(loss) : SolverOptions(loss), &problem, &summary);
  const bool finite =
      std::all_of(theta.begin(), theta.end(), [](double x) { return std::isfinite(x); });
  if (!summary.IsSolutionUsable() || !finite) {
    return Failed("no_convergence", "fit", "the solver found no estimate: " + summary.message);
  }
  return loss == Loss::kSquared && !loose ? Polish(estimation, theta) : theta;
}

double RowResidual(const ReadingRow& row, const Theta& theta) {
  return Evaluate(row, theta.data());
}

RowDerivative DifferentiateRow(const ReadingRow& row, const Theta& theta) {
  using Jet = ceres::Jet<double, kParameters>;
  const std::array<Jet, kParameters> variables = {Jet(theta[0], 0), Jet(theta[1], 1),
                                                  Jet(theta[2], 2)};
  const Jet residual = Evaluate(row, variables.data());
  return {residual.a, {residual.v[0], residual.v[1], residual.v[2]}};
}

double HalfChiSquared(const Estimation& estimation, const Theta& theta) {
  double sum = 0.0;
  for (const ReadingRow& row : estimation.rows) {
    const double r = RowResidual(row, theta);
    sum += r * r;
  }
  for (int k = 0; k < kParameters; ++k) {
    const ParameterRule& rule = estimation.rules[k];
    if (!rule.free || !(rule.prior_sd > 0.0)) continue;
    const double r = (theta[k] - rule.prior_mean) / rule.prior_sd;
    sum += r * r;
  }
  return 0.5 * sum;
}

}  // namespace lightcal::fit
