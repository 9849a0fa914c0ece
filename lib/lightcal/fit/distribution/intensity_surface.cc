// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/distribution/intensity_surface.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lightcal::fit {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr double kRidge = 1e-10;  // of the mean diagonal: coefficients that nothing decides
constexpr double kZero = 1e-9;    // of the largest coefficient

// The four uniform cubic B-splines over an interval, at t in [0, 1].
std::array<double, 4> CubicPieces(double t) {
  const double s = 1.0 - t;
  return {s * s * s / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
          (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0, t * t * t / 6.0};
}

struct Place {
  int first = 0;
  double t = 0.0;
};
Place PlaceOf(double value, double start, double spacing, int coefficients) {
  const int intervals = coefficients - 3;
  const double x = std::clamp((value - start) / spacing, 0.0, static_cast<double>(intervals));
  const int first = std::min(static_cast<int>(x), intervals - 1);
  return {first, x - first};
}

// Adds the square of one second difference: the three cells a, b, c with factors 1, -2, 1.
void AddDifference(Matrix& penalty, int a, int b, int c) {
  const std::array<int, 3> index = {a, b, c};
  const std::array<double, 3> factor = {1.0, -2.0, 1.0};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) penalty(index[i], index[j]) += factor[i] * factor[j];
  }
}

// Twice the square of a mixed difference, so that the penalty does not know the axes' direction.
void AddTwist(Matrix& penalty, const std::array<int, 4>& index) {
  const std::array<double, 4> factor = {1.0, -1.0, -1.0, 1.0};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) penalty(index[i], index[j]) += 2.0 * factor[i] * factor[j];
  }
}

Matrix PenaltyOf(const ChartGrid& grid) {
  Matrix penalty = Matrix::Zero(grid.Size(), grid.Size());
  const auto at = [&](int column, int row) { return row * grid.columns + column; };
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      if (column + 2 < grid.columns) {
        AddDifference(penalty, at(column, row), at(column + 1, row), at(column + 2, row));
      }
      if (row + 2 < grid.rows) {
        AddDifference(penalty, at(column, row), at(column, row + 1), at(column, row + 2));
      }
      if (column + 1 < grid.columns && row + 1 < grid.rows) {
        AddTwist(penalty, {at(column, row), at(column + 1, row), at(column, row + 1),
                           at(column + 1, row + 1)});
      }
    }
  }
  return penalty;
}

// |L'x - L^-1 b|^2 = x'Mx - 2 b'x + const, with M = LL': the whole problem in n residuals.
class ReducedCost : public ceres::CostFunction {
 public:
  ReducedCost(const Matrix& normal, const Vector& right) {
    const Eigen::LLT<Matrix> factor(normal);
    upper_ = factor.matrixU();
    target_ = factor.matrixL().solve(right);
    set_num_residuals(static_cast<int>(right.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(right.size()));
  }
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const Eigen::Map<const Vector> x(parameters[0], target_.size());
    Eigen::Map<Vector>(residuals, target_.size()) = upper_ * x - target_;
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
      Eigen::Map<RowMajor>(jacobians[0], target_.size(), target_.size()) = upper_;
    }
    return true;
  }

 private:
  Matrix upper_;
  Vector target_;
};

std::vector<Eigen::Index> FreeOf(std::span<const double> coefficients) {
  const double largest = *std::ranges::max_element(coefficients);
  std::vector<Eigen::Index> free;
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    if (coefficients[i] > kZero * largest) free.push_back(static_cast<Eigen::Index>(i));
  }
  return free;
}

}  // namespace

ChartGrid::Support ChartGrid::At(double u, double v) const {
  const Place a = PlaceOf(u, u0, spacing, columns), b = PlaceOf(v, v0, spacing, rows);
  const auto across = CubicPieces(a.t), up = CubicPieces(b.t);
  Support out;
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 4; ++i) {
      out.index[4 * j + i] =
          (b.first + static_cast<int>(j)) * columns + a.first + static_cast<int>(i);
      out.factor[4 * j + i] = up[j] * across[i];
    }
  }
  return out;
}

struct SurfaceProblem::Matrices {
  Matrix data, penalty;
  Vector right;
  double values2 = 0.0;  // sum of w value^2
  double samples = 0.0;

  [[nodiscard]] Matrix Normal(double lambda) const {
    Matrix normal = data + lambda * penalty;
    normal.diagonal().array() += kRidge * data.trace() / static_cast<double>(data.rows());
    return normal;
  }
  [[nodiscard]] double SumOfSquares(const Vector& x) const {
    return std::max(0.0, values2 - 2.0 * x.dot(right) + x.dot(data * x));
  }
};

SurfaceProblem::~SurfaceProblem() = default;
SurfaceProblem::SurfaceProblem(SurfaceProblem&&) noexcept = default;
SurfaceProblem& SurfaceProblem::operator=(SurfaceProblem&&) noexcept = default;

SurfaceProblem::SurfaceProblem(const ChartGrid& grid, std::span<const ChartSample> samples)
    : m_(std::make_unique<Matrices>()) {
  Matrices& m = *m_;
  m.data = Matrix::Zero(grid.Size(), grid.Size());
  m.right = Vector::Zero(grid.Size());
  for (const ChartSample& sample : samples) {
    if (!(sample.weight > 0.0)) continue;
    const ChartGrid::Support support = grid.At(sample.u, sample.v);
    for (std::size_t i = 0; i < support.index.size(); ++i) {
      const double weighted = sample.weight * support.factor[i];
      m.right(support.index[i]) += weighted * sample.value;
      for (std::size_t j = 0; j < support.index.size(); ++j) {
        m.data(support.index[i], support.index[j]) += weighted * support.factor[j];
      }
    }
    m.values2 += sample.weight * sample.value * sample.value;
    m.samples += 1.0;
  }
  m.penalty = PenaltyOf(grid);
  m.penalty *= m.data.trace() / m.penalty.trace();
}

double SurfaceProblem::CrossValidation(double lambda) const {
  const Eigen::LLT<Matrix> factor(m_->Normal(lambda));
  const Vector x = factor.solve(m_->right);
  const double trace = factor.solve(m_->data).trace();
  const double left = m_->samples - trace;
  return m_->samples * m_->SumOfSquares(x) / (left * left);
}

Result<std::vector<double>> SurfaceProblem::SolveNonNegative(double lambda) const {
  const Matrix normal = m_->Normal(lambda);
  const Vector start = Eigen::LLT<Matrix>(normal).solve(m_->right).cwiseMax(0.0);
  std::vector<double> x(start.data(), start.data() + start.size());
  ceres::Problem problem;
  problem.AddResidualBlock(new ReducedCost(normal, m_->right), nullptr, x.data());
  for (int i = 0; i < static_cast<int>(x.size()); ++i) {
    problem.SetParameterLowerBound(x.data(), i, 0.0);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.function_tolerance = 1e-12;
  options.gradient_tolerance = 1e-14;
  options.parameter_tolerance = 1e-12;
  options.max_num_iterations = 200;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) {
    return Failed("no_convergence", "intensity distribution", summary.message);
  }
  std::vector<double> polished = SolveWithZeros(lambda, x);
  const bool positive = std::ranges::all_of(polished, [](double c) { return c >= 0.0; });
  return positive ? polished : x;
}

std::vector<double> SurfaceProblem::SolveWithZeros(double lambda,
                                                   std::span<const double> zeros_of) const {
  const auto free = FreeOf(zeros_of);
  const Vector right = m_->right(free);
  const Vector x = Eigen::LLT<Matrix>(Matrix(m_->Normal(lambda)(free, free))).solve(right);
  std::vector<double> out(zeros_of.size(), 0.0);
  for (std::size_t i = 0; i < free.size(); ++i) {
    out[static_cast<std::size_t>(free[i])] = x(static_cast<Eigen::Index>(i));
  }
  return out;
}

double SurfaceProblem::Variance(double lambda, std::span<const double> zeros_of,
                                std::span<const double> functional) const {
  const auto free = FreeOf(zeros_of);
  const Eigen::Map<const Vector> all(functional.data(),
                                     static_cast<Eigen::Index>(functional.size()));
  const Vector g = all(free);
  const Vector h = Eigen::LLT<Matrix>(Matrix(m_->Normal(lambda)(free, free))).solve(g);
  return h.dot(m_->data(free, free) * h);
}

double SurfaceProblem::ReducedChi2(double lambda, std::span<const double> coefficients) const {
  const auto free = FreeOf(coefficients);
  const Matrix data = m_->data(free, free);
  const double trace =
      Eigen::LLT<Matrix>(Matrix(m_->Normal(lambda)(free, free))).solve(data).trace();
  const Eigen::Map<const Vector> x(coefficients.data(),
                                   static_cast<Eigen::Index>(coefficients.size()));
  return m_->SumOfSquares(x) / std::max(1.0, m_->samples - trace);
}

}  // namespace lightcal::fit
