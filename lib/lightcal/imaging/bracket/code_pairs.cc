// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/code_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace lightcal {
namespace {

constexpr double kHighestShare = 249.0 / 255.0;  // of the top code; above, the codes fill up
constexpr double kGamma = 2.2;                   // what most cameras' curves are near
constexpr double kStepSd = 1.0;
constexpr double kSmoothness = 2e3;
// Code below which curves may have a toe; sRGB's slope over ln(code) is 1 at 10, 1.6 at 32. Softer
// above, a curve follows what compression rounded plain parts to.
constexpr double kToeEnd = 32.0;
constexpr double kMovedLn = 0.25;    // a residual from which a pixel probably shows something else
constexpr double kLeastRise = 1e-4;  // of g a step: curves increase
constexpr double kLeastLnRatio = 0.1;  // of two frames that bend a curve

// The variance of ln(signal) that an uncertainty of one code means there.
double StepVariance(const Eigen::VectorXd& g, int step) {
  const int low = std::max(step - 2, 0), high = std::min(step + 2, kCodeSteps - 1);
  const double slope = std::max((g(high) - g(low)) / (high - low), kLeastRise);
  return slope * slope * kStepSd * kStepSd;
}

// Little change of slope over ln(step), so that any power law is free; by step, as in
// (g'' + g'/z)^2.
void AddSmoothness(const CodeSteps& steps, Eigen::MatrixXd& curve) {
  const double smooth = kSmoothness * curve.diagonal().mean();
  for (int step = 1; step + 1 < kCodeSteps; ++step) {
    const double before = 1.0 / (step * (LnStep(step) - LnStep(step - 1)));
    const double after = 1.0 / (step * (LnStep(step + 1) - LnStep(step)));
    const std::array<double, 3> k = {before, -before - after, after};
    const double weight = smooth * steps.Stiffness(step);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        curve(step - 1 + i, step - 1 + j) +=
            weight * k[static_cast<std::size_t>(i)] * k[static_cast<std::size_t>(j)];
      }
    }
  }
}

}  // namespace

double CodeSteps::At(double code) const {
  const double share = code / top_;
  return (kCodeSteps - 1) * (fine_ ? std::sqrt(share) : share);
}

double CodeSteps::Stiffness(int step) const {
  if (!fine_) return std::pow(std::min(1.0, step / kToeEnd), 3);
  return 1.0 / std::pow(std::max(1.0, 2.0 * step / (kCodeSteps - 1)), 3);
}

std::vector<int> CodeSteps::Nearest() const {
  std::vector<int> steps;
  for (int code = 0; code <= static_cast<int>(top_); ++code) {
    const int step = static_cast<int>(At(code) + 0.5);
    steps.push_back(step < kLowestStep || code > kHighestShare * top_ ? 0 : step);
  }
  return steps;
}

double LnStep(double step) { return std::log(std::max(step, kLeastStep)); }

CodePair CountPair(const CodeView& a, const CodeView& b, int channel,
                   const std::vector<int>& steps) {
  const auto step_of = [&](std::uint16_t code) {
    return steps[std::min<std::size_t>(code, steps.size() - 1)];
  };
  CodePair pair;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const int first = step_of(a(x, y, channel)), second = step_of(b(x, y, channel));
      if (first == 0 || second == 0) continue;
      pair.count[static_cast<std::size_t>(first * kCodeSteps + second)] += 1.0;
    }
  }
  return pair;
}

Eigen::VectorXd StartCurve() {
  Eigen::VectorXd g(kCodeSteps);
  for (int step = 0; step < kCodeSteps; ++step) {
    g(step) = kGamma * (LnStep(step) - LnStep(kCodeSteps - 1));
  }
  return g;
}

CurveEquations EquationsOf(std::span<const CodePair> pairs, std::span<const double> ln_exposure,
                           const CodeSteps& steps, const Eigen::VectorXd& so_far,
                           bool trust_residuals) {
  const auto frames = static_cast<Eigen::Index>(ln_exposure.size());
  CurveEquations e{Eigen::MatrixXd::Zero(kCodeSteps, kCodeSteps),
                   Eigen::MatrixXd::Zero(kCodeSteps, frames), Eigen::MatrixXd::Zero(frames, frames),
                   Eigen::VectorXd::Zero(kCodeSteps), Eigen::VectorXd::Zero(frames)};
  for (const CodePair& pair : pairs) {
    const double ln_ratio = ln_exposure[pair.second] - ln_exposure[pair.first];
    const auto i = static_cast<Eigen::Index>(pair.first);
    const auto j = static_cast<Eigen::Index>(pair.second);
    double all = 0.0;
    for (int a = kLowestStep; a < kCodeSteps; ++a) {
      const double variance_a = StepVariance(so_far, a);
      for (int b = kLowestStep; b < kCodeSteps; ++b) {
        const double count = pair.count[static_cast<std::size_t>(a * kCodeSteps + b)];
        if (count == 0.0) continue;
        double weight = count / (variance_a + StepVariance(so_far, b));
        if (trust_residuals) {
          const double residual = (so_far(b) - so_far(a) - ln_ratio) / kMovedLn;
          weight /= (1.0 + residual * residual) * (1.0 + residual * residual);
        }
        e.curve(a, a) += weight;
        e.curve(b, b) += weight;
        e.curve(a, b) -= weight;
        e.curve(b, a) -= weight;
        e.right(b) += weight * ln_ratio;
        e.right(a) -= weight * ln_ratio;
        e.mixed(b, j) -= weight;
        e.mixed(b, i) += weight;
        e.mixed(a, j) += weight;
        e.mixed(a, i) -= weight;
        all += weight;
      }
    }
    e.exposures(i, i) += all;
    e.exposures(j, j) += all;
    e.exposures(i, j) -= all;
    e.exposures(j, i) -= all;
    e.exposures_right(j) -= all * ln_ratio;
    e.exposures_right(i) += all * ln_ratio;
  }
  AddSmoothness(steps, e.curve);
  // Gauge: the top step is signal 1.
  e.curve(kCodeSteps - 1, kCodeSteps - 1) += e.curve.diagonal().maxCoeff();
  return e;
}

void MakeIncreasing(Eigen::VectorXd& g) {
  struct Block {
    double mean;
    int count;
  };
  std::vector<Block> blocks;
  for (int step = 0; step < kCodeSteps; ++step) {
    blocks.push_back({g(step) - kLeastRise * step, 1});
    while (blocks.size() > 1 && blocks[blocks.size() - 2].mean > blocks.back().mean) {
      const Block last = blocks.back();
      blocks.pop_back();
      Block& merged = blocks.back();
      merged.mean =
          (merged.mean * merged.count + last.mean * last.count) / (merged.count + last.count);
      merged.count += last.count;
    }
  }
  int step = 0;
  for (const Block& block : blocks) {
    for (int i = 0; i < block.count; ++i, ++step) g(step) = block.mean + kLeastRise * step;
  }
}

std::vector<CodePair> Neighbours(std::span<const CodePair> pairs,
                                 std::span<const double> ln_exposure, bool bending) {
  std::vector<std::size_t> order(ln_exposure.size()), rank(order.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return ln_exposure[i]; });
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = i;
  std::vector<CodePair> chosen;
  for (const CodePair& pair : pairs) {
    const double ln_ratio = ln_exposure[pair.second] - ln_exposure[pair.first];
    const bool neighbours =
        rank[pair.first] + 1 == rank[pair.second] || rank[pair.second] + 1 == rank[pair.first];
    if (neighbours && (!bending || std::abs(ln_ratio) >= kLeastLnRatio)) chosen.push_back(pair);
  }
  return chosen;
}

Eigen::VectorXd CurveOf(std::span<const CodePair> pairs, std::span<const double> ln_exposure,
                        const CodeSteps& steps) {
  Eigen::VectorXd g = StartCurve();
  for (int turn = 0; turn < kCurveTurns; ++turn) {
    const auto e = EquationsOf(pairs, ln_exposure, steps, g, turn >= kCurveTurns / 2);
    g = e.curve.ldlt().solve(e.right);
    MakeIncreasing(g);
  }
  return g;
}

}  // namespace lightcal
