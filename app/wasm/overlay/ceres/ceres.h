// SPDX-License-Identifier: Apache-2.0
// The part of Ceres that lightcal's fit asks for, for one block of parameters: Ceres itself needs
// threads and glog. Levenberg and Marquardt's method in a trust region, dense QR, box bounds by
// projection, robust losses by Triggs's correction, with Ceres's own constants, so that its steps
// are Ceres's steps.
// Source: Madsen, Nielsen, Tingleff, Methods for non-linear least squares problems (2004), 3.2;
// Triggs et al., Bundle adjustment, a modern synthesis (1999), 4.3; Ceres Solver's documentation.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace ceres {

enum LinearSolverType { DENSE_QR, DENSE_NORMAL_CHOLESKY };
enum LoggingType { SILENT };
enum Ownership { DO_NOT_TAKE_OWNERSHIP, TAKE_OWNERSHIP };

class CostFunction {
 public:
  virtual ~CostFunction() = default;
  virtual bool Evaluate(double const* const* parameters, double* residuals,
                        double** jacobians) const = 0;
  [[nodiscard]] const std::vector<int>& parameter_block_sizes() const { return sizes_; }
  [[nodiscard]] int num_residuals() const { return residuals_; }

 protected:
  std::vector<int>* mutable_parameter_block_sizes() { return &sizes_; }
  void set_num_residuals(int count) { residuals_ = count; }

 private:
  std::vector<int> sizes_;
  int residuals_ = 0;
};

// rho(s), rho'(s), rho''(s) of a squared residual s.
class LossFunction {
 public:
  virtual ~LossFunction() = default;
  virtual void Evaluate(double s, double rho[3]) const = 0;
};
class HuberLoss : public LossFunction {
 public:
  explicit HuberLoss(double a) : a_(a) {}
  void Evaluate(double s, double rho[3]) const override {
    if (s <= a_ * a_) {
      rho[0] = s, rho[1] = 1.0, rho[2] = 0.0;
      return;
    }
    const double r = std::sqrt(s);
    rho[0] = 2.0 * a_ * r - a_ * a_;
    rho[1] = std::max(std::numeric_limits<double>::min(), a_ / r);
    rho[2] = -rho[1] / (2.0 * s);
  }

 private:
  double a_;
};
class TukeyLoss : public LossFunction {
 public:
  explicit TukeyLoss(double a) : squared_(a * a) {}
  void Evaluate(double s, double rho[3]) const override {
    if (s > squared_) {
      rho[0] = squared_ / 3.0, rho[1] = 0.0, rho[2] = 0.0;
      return;
    }
    const double value = 1.0 - s / squared_;
    rho[0] = squared_ / 3.0 * (1.0 - value * value * value);
    rho[1] = value * value;
    rho[2] = -2.0 / squared_ * value;
  }

 private:
  double squared_;
};

struct SubsetManifold {
  SubsetManifold(int /*size*/, std::vector<int> constant) : held(std::move(constant)) {}
  std::vector<int> held;
};

class Problem {
 public:
  struct Options {
    Ownership loss_function_ownership = TAKE_OWNERSHIP;
    bool disable_all_safety_checks = false;
  };
  Problem() = default;
  explicit Problem(const Options& /*losses stay their owners'*/) {}

  void AddParameterBlock(double* block, int size) { Size(block, size); }
  void AddResidualBlock(CostFunction* cost, LossFunction* loss, double* block) {
    Size(block, cost->parameter_block_sizes().front());
    blocks.push_back({std::unique_ptr<CostFunction>(cost), loss});
    rows += cost->num_residuals();
  }
  void SetParameterLowerBound(double* /*values*/, int k, double bound) {
    low[k] = bound;
    bounded = true;
  }
  void SetParameterUpperBound(double* /*values*/, int k, double bound) {
    high[k] = bound;
    bounded = true;
  }
  void SetParameterBlockConstant(double* /*values*/) { free.clear(); }
  void SetManifold(double* /*values*/, SubsetManifold* manifold) {
    const std::unique_ptr<SubsetManifold> owned(manifold);
    std::erase_if(free, [&](int k) { return std::ranges::count(owned->held, k) > 0; });
  }

  struct Block {
    std::unique_ptr<CostFunction> cost;
    LossFunction* loss = nullptr;
  };
  std::vector<Block> blocks;
  double* values = nullptr;
  std::vector<int> free;  // parameters that move
  Eigen::VectorXd low, high;
  int rows = 0;
  bool bounded = false;

 private:
  void Size(double* block, int size) {
    values = block;
    if (low.size() == size) return;
    low = Eigen::VectorXd::Constant(size, -std::numeric_limits<double>::infinity());
    high = -low;
    for (int k = 0; k < size; ++k) free.push_back(k);
  }
};

struct Solver {
  struct Options {
    LinearSolverType linear_solver_type = DENSE_QR;
    LoggingType logging_type = SILENT;
    int num_threads = 1, max_num_iterations = 50;
    double function_tolerance = 1e-6, gradient_tolerance = 1e-10, parameter_tolerance = 1e-8;
    double initial_trust_region_radius = 1e4;
  };
  struct Summary {
    std::string message;
    bool usable = false;
    [[nodiscard]] bool IsSolutionUsable() const { return usable; }
  };
};

namespace detail {

struct State {
  double cost = 0.0;
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;  // by the free parameters
};

// The cost alone where `slopes` is false. False: a row has no value.
inline bool Evaluate(const Problem& problem, const Eigen::VectorXd& x, bool slopes, State& out) {
  const auto count = static_cast<Eigen::Index>(problem.free.size());
  out.cost = 0.0;
  if (slopes) {
    out.residuals.resize(problem.rows);
    out.jacobian.resize(problem.rows, count);
  }
  Eigen::Index at = 0;
  for (const Problem::Block& row : problem.blocks) {
    const int n = row.cost->num_residuals();
    Eigen::VectorXd r(n);
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> j(n, x.size());
    const double* const parameters = x.data();
    double* jacobian = j.data();
    if (!row.cost->Evaluate(&parameters, r.data(), slopes ? &jacobian : nullptr)) return false;
    if (!r.allFinite()) return false;
    const double s = r.squaredNorm();
    double rho[3] = {s, 1.0, 0.0};
    if (row.loss != nullptr) row.loss->Evaluate(s, rho);
    out.cost += 0.5 * rho[0];
    if (!slopes) continue;
    if (row.loss != nullptr) {
      const double root = std::sqrt(rho[1]);
      double scale = root, alpha_over_s = 0.0;
      if (s != 0.0 && rho[2] > 0.0) {
        const double alpha = 1.0 - std::sqrt(1.0 + 2.0 * s * rho[2] / rho[1]);
        scale = root / (1.0 - alpha);
        alpha_over_s = alpha / s;
      }
      j = root * (j - alpha_over_s * r * (r.transpose() * j)).eval();
      r *= scale;
    }
    out.residuals.segment(at, n) = r;
    for (Eigen::Index k = 0; k < count; ++k) {
      out.jacobian.col(k).segment(at, n) = j.col(problem.free[static_cast<std::size_t>(k)]);
    }
    at += n;
  }
  return true;
}

inline Eigen::VectorXd Moved(const Problem& problem, const Eigen::VectorXd& x,
                             const Eigen::VectorXd& step) {
  Eigen::VectorXd to = x;
  for (Eigen::Index k = 0; k < step.size(); ++k) {
    to[problem.free[static_cast<std::size_t>(k)]] += step[k];
  }
  return to.cwiseMax(problem.low).cwiseMin(problem.high);
}

// The first step of a halving series along `step` that lowers the cost enough (Armijo).
inline void ShortenToDescend(const Problem& problem, const Eigen::VectorXd& x, const State& now,
                             const Eigen::VectorXd& gradient, Eigen::VectorXd& step) {
  constexpr double kSufficient = 1e-4, kShrink = 0.6;
  constexpr int kTries = 20;
  const double slope = gradient.dot(step);
  double factor = 1.0;
  for (int i = 0; i < kTries; ++i, factor *= kShrink) {
    State there;
    const bool valued = Evaluate(problem, Moved(problem, x, factor * step), false, there);
    if (valued && there.cost <= now.cost + kSufficient * factor * slope) {
      step *= factor;
      return;
    }
  }
}

}  // namespace detail

inline void Solve(const Solver::Options& options, Problem* problem, Solver::Summary* summary) {
  using Eigen::VectorXd;
  const auto size = problem->low.size();
  VectorXd x =
      detail::Moved(*problem, Eigen::Map<const VectorXd>(problem->values, size), VectorXd());
  detail::State now;
  const auto end = [&](const char* message, bool usable) {
    summary->message = message;
    summary->usable = usable;
    if (usable) Eigen::Map<VectorXd>(problem->values, size) = x;
  };
  if (!detail::Evaluate(*problem, x, true, now)) return end("no value at the start", false);
  if (problem->free.empty()) return end("nothing to move", true);
  const VectorXd scale = (1.0 + now.jacobian.colwise().norm().array()).inverse();
  double radius = options.initial_trust_region_radius, shrink = 2.0;
  int invalid = 0;
  for (int iteration = 0;; ++iteration) {
    const VectorXd gradient = now.jacobian.transpose() * now.residuals;
    const double steepest = (detail::Moved(*problem, x, -gradient) - x).lpNorm<Eigen::Infinity>();
    if (steepest <= options.gradient_tolerance) return end("gradient is zero", true);
    if (iteration >= options.max_num_iterations) return end("many iterations", true);
    if (radius < 1e-32) return end("trust region is empty", true);
    const Eigen::MatrixXd scaled = now.jacobian * scale.asDiagonal();
    const VectorXd damping =
        (scaled.colwise().squaredNorm().transpose().array().max(1e-6).min(1e32) / radius).sqrt();
    Eigen::MatrixXd left(scaled.rows() + scaled.cols(), scaled.cols());
    left << scaled, Eigen::MatrixXd(damping.asDiagonal());
    VectorXd right = VectorXd::Zero(left.rows());
    right.head(scaled.rows()) = -now.residuals;
    const VectorXd step_scaled = left.householderQr().solve(right);
    const VectorXd change = scaled * step_scaled;
    const double promised = -change.dot(now.residuals + 0.5 * change);
    if (!step_scaled.allFinite() || !(promised > 0.0)) {
      if (++invalid >= 5) return end("no step goes down", false);
      radius *= 0.5;
      continue;
    }
    invalid = 0;
    VectorXd step = step_scaled.cwiseProduct(scale);
    if (problem->bounded) detail::ShortenToDescend(*problem, x, now, gradient, step);
    const VectorXd to = detail::Moved(*problem, x, step);
    detail::State next;
    if (!detail::Evaluate(*problem, to, false, next)) next.cost = HUGE_VAL;
    const double moved = (to - x).norm();
    const double tolerance = options.parameter_tolerance;
    if (moved <= tolerance * (x.norm() + tolerance)) return end("parameters stand", true);
    const double lowered = now.cost - next.cost;
    if (std::abs(lowered) <= options.function_tolerance * now.cost) {
      return end("cost stands", true);
    }
    const double quality = lowered / promised;
    if (quality > 1e-3 && detail::Evaluate(*problem, to, true, next)) {
      x = to;
      now = std::move(next);
      radius = std::min(1e16, radius / std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * quality - 1.0, 3)));
      shrink = 2.0;
    } else {
      radius /= shrink;
      shrink *= 2.0;
    }
  }
}

}  // namespace ceres
