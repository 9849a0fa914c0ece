// SPDX-License-Identifier: Apache-2.0
// The optimum of solver_problem.h by public solvers, each with its Jacobian and from the same
// start. Table as own_solver.cc.
#include <cminpack-1/cminpack.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>

#include <Eigen/Dense>
#include <unsupported/Eigen/NonLinearOptimization>

#include "solver_problem.h"

namespace {

using page::kResiduals;
using page::kUnknowns;
using page::SolverProblem;

constexpr int kMostIterations = 200;

void NoJacobian(int, int, double) {}

// ---- GSL's multifit_nlinear, Levenberg-Marquardt ----

int GslResiduals(const gsl_vector* theta, void* problem, gsl_vector* residuals) {
  page::Evaluate(*static_cast<const SolverProblem*>(problem), theta->data, residuals->data, false,
                 NoJacobian);
  return GSL_SUCCESS;
}

int GslJacobian(const gsl_vector* theta, void* problem, gsl_matrix* jacobian) {
  double residuals[kResiduals];
  gsl_matrix_set_zero(jacobian);
  page::Evaluate(*static_cast<const SolverProblem*>(problem), theta->data, residuals, true,
                 [&](int i, int k, double value) { gsl_matrix_set(jacobian, i, k, value); });
  return GSL_SUCCESS;
}

class Gsl {
 public:
  double LnIntensity(SolverProblem problem, double tolerance) {
    gsl_multifit_nlinear_fdf functions{};
    functions.f = GslResiduals;
    functions.df = GslJacobian;
    functions.n = kResiduals;
    functions.p = kUnknowns;
    functions.params = &problem;
    double start[] = {problem.start_ln_intensity, 0.0, 0.0};
    const gsl_vector_view at = gsl_vector_view_array(start, kUnknowns);
    gsl_multifit_nlinear_init(&at.vector, &functions, workspace_);
    int why = 0;
    gsl_multifit_nlinear_driver(kMostIterations, tolerance, tolerance, tolerance, nullptr, nullptr,
                                &why, workspace_);
    return gsl_vector_get(gsl_multifit_nlinear_position(workspace_), 0);
  }

 private:
  gsl_multifit_nlinear_parameters parameters_ = gsl_multifit_nlinear_default_parameters();
  gsl_multifit_nlinear_workspace* workspace_ =
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &parameters_, kResiduals, kUnknowns);
};

// ---- Eigen's port of MINPACK ----

struct EigenProblem {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };
  const SolverProblem* problem = nullptr;

  [[nodiscard]] int inputs() const { return kUnknowns; }
  [[nodiscard]] int values() const { return kResiduals; }
  int operator()(const InputType& theta, ValueType& residuals) const {
    page::Evaluate(*problem, theta.data(), residuals.data(), false, NoJacobian);
    return 0;
  }
  int df(const InputType& theta, JacobianType& jacobian) const {
    double residuals[kResiduals];
    jacobian.setZero(kResiduals, kUnknowns);
    page::Evaluate(*problem, theta.data(), residuals, true,
                   [&](int i, int k, double value) { jacobian(i, k) = value; });
    return 0;
  }
};

double EigenLnIntensity(const SolverProblem& problem, double tolerance) {
  EigenProblem functor{&problem};
  Eigen::LevenbergMarquardt<EigenProblem> solver(functor);
  solver.parameters.ftol = solver.parameters.xtol = tolerance;
  solver.parameters.maxfev = kMostIterations;
  Eigen::VectorXd theta(kUnknowns);
  theta << problem.start_ln_intensity, 0.0, 0.0;
  solver.minimize(theta);
  return theta[0];
}

// ---- cminpack: MINPACK's lmder in C ----

int MinpackStep(void* problem, int, int, const double* theta, double* residuals, double* jacobian,
                int leading, int what) {
  const auto& given = *static_cast<const SolverProblem*>(problem);
  if (what == 1) {
    page::Evaluate(given, theta, residuals, false, NoJacobian);
    return 0;
  }
  double unused[kResiduals];
  std::fill(jacobian, jacobian + leading * kUnknowns, 0.0);
  page::Evaluate(given, theta, unused, true,
                 [&](int i, int k, double value) { jacobian[i + leading * k] = value; });
  return 0;
}

double MinpackLnIntensity(SolverProblem problem, double tolerance) {
  double theta[] = {problem.start_ln_intensity, 0.0, 0.0};
  double residuals[kResiduals], jacobian[kResiduals * kUnknowns];
  double diagonal[kUnknowns], qtf[kUnknowns], w1[kUnknowns], w2[kUnknowns], w3[kUnknowns];
  double w4[kResiduals];
  int pivots[kUnknowns], evaluations = 0, jacobians = 0;
  lmder(MinpackStep, &problem, kResiduals, kUnknowns, theta, residuals, jacobian, kResiduals,
        tolerance, tolerance, 0.0, kMostIterations, diagonal, 1, 100.0, 0, &evaluations, &jacobians,
        pivots, qtf, w1, w2, w3, w4);
  return theta[0];
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) return EXIT_FAILURE;
  gsl_set_error_handler_off();
  const auto table = page::ReadTable(words[1]);
  std::vector<SolverProblem> problems;
  for (const auto& row : table) problems.push_back(page::SolverProblemOf(row));
  const page::Rows rows(table, page::ErrorScale::kAbsolute);
  Gsl gsl;
  for (const auto& [name, tolerance] : {std::pair{"1e-2", 1e-2},
                                        {"1e-4", 1e-4},
                                        {"1e-6", 1e-6},
                                        {"1e-9", 1e-9},
                                        {"1e-14", 1e-14}}) {
    const std::string setting = std::string("tolerance ") + name;
    rows.PrintEach("GSL", setting,
                   [&](std::size_t i) { return gsl.LnIntensity(problems[i], tolerance); });
    rows.PrintEach("Eigen", setting,
                   [&](std::size_t i) { return EigenLnIntensity(problems[i], tolerance); });
    rows.PrintEach("cminpack", setting,
                   [&](std::size_t i) { return MinpackLnIntensity(problems[i], tolerance); });
  }
  return EXIT_SUCCESS;
}
