// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/least_squares.h"

#include <ceres/ceres.h>

#include <memory>

namespace lightcal::fit {
namespace {

class RowCost : public ceres::CostFunction {
 public:
  RowCost(const ErasedProblem& problem, std::size_t row) : problem_(problem), row_(row) {
    set_num_residuals(1);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(problem.rules.size()));
  }
  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    double* const gradient = jacobians == nullptr ? nullptr : jacobians[0];
    if (!problem_.row(row_, parameters[0], residuals, gradient)) return false;
    // Ceres prints pages of what is not finite.
    const auto finite = [](double x) { return std::isfinite(x); };
    return gradient == nullptr ||
           std::all_of(gradient, gradient + parameter_block_sizes()[0], finite);
  }

 private:
  const ErasedProblem& problem_;
  std::size_t row_;
};

class PriorCost : public ceres::CostFunction {
 public:
  PriorCost(const ErasedProblem& problem, std::size_t k) : rule_(problem.rules[k]), k_(k) {
    set_num_residuals(1);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(problem.rules.size()));
  }
  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    residuals[0] = (parameters[0][k_] - rule_.prior_mean) / rule_.prior_sd;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    std::fill_n(jacobians[0], parameter_block_sizes()[0], 0.0);
    jacobians[0][k_] = 1.0 / rule_.prior_sd;
    return true;
  }

 private:
  ParameterRule rule_;
  std::size_t k_;
};

std::unique_ptr<ceres::LossFunction> LossOf(const FullSolver& how) {
  switch (how.loss) {
    case Loss::kHuber:
      return std::make_unique<ceres::HuberLoss>(kHuberConstant * how.scale);
    case Loss::kTukey:
      return std::make_unique<ceres::TukeyLoss>(kTukeyConstant * how.scale);
    case Loss::kSquared:
      break;
  }
  return nullptr;
}

void AddParameters(const ErasedProblem& erased, double* theta, ceres::Problem& problem) {
  const auto count = static_cast<int>(erased.rules.size());
  std::vector<int> held;
  for (int k = 0; k < count; ++k) {
    const auto at = static_cast<std::size_t>(k);
    if (!erased.rules[at].free) {
      held.push_back(k);
      continue;
    }
    if (std::isfinite(erased.bounds[at].low)) {
      problem.SetParameterLowerBound(theta, k, erased.bounds[at].low);
    }
    if (std::isfinite(erased.bounds[at].high)) {
      problem.SetParameterUpperBound(theta, k, erased.bounds[at].high);
    }
    if (!(erased.rules[at].prior_sd > 0.0)) continue;
    problem.AddResidualBlock(new PriorCost(erased, at), nullptr, theta);
  }
  if (static_cast<int>(held.size()) == count) {
    problem.SetParameterBlockConstant(theta);
  } else if (!held.empty()) {
    problem.SetManifold(theta, new ceres::SubsetManifold(count, held));
  }
}

}  // namespace

Result<void> MinimiseInFull(const ErasedProblem& erased, const FullSolver& how,
                            const std::string& what, double* theta) {
  const std::unique_ptr<ceres::LossFunction> loss = LossOf(how);
  ceres::Problem::Options problem_options;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.disable_all_safety_checks = true;
  ceres::Problem problem(problem_options);
  problem.AddParameterBlock(theta, static_cast<int>(erased.rules.size()));
  for (std::size_t i = 0; i < erased.rows; ++i) {
    problem.AddResidualBlock(new RowCost(erased, i), loss.get(), theta);
  }
  AddParameters(erased, theta, problem);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = how.iterations;
  options.function_tolerance = how.function_tolerance;
  options.parameter_tolerance = how.parameter_tolerance;
  options.gradient_tolerance = 1e-13;
  options.initial_trust_region_radius = how.first_trust_region;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  const bool finite =
      std::all_of(theta, theta + erased.rules.size(), [](double x) { return std::isfinite(x); });
  if (summary.IsSolutionUsable() && finite) return {};
  return Failed("no_convergence", "fit", "the solver found no " + what + ": " + summary.message);
}

}  // namespace lightcal::fit
