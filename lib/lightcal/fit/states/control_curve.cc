// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/states/control_curve.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "lightcal/fit/states/control_prior.h"

namespace lightcal::fit {
namespace {

using Labels = std::vector<double>;

// Of exp(mean of ln evidence): a hypothesis that makes the readings less probable is left out.
constexpr double kLeastEvidence = 7.0;
// Forms are kept until no more than this part of the evidence is left out: few states leave many.
constexpr double kShareLeftOut = 0.005;
constexpr std::size_t kFewestForms = 8, kMostForms = 40;

}  // namespace

// Of ControlCurve alone; named, since what is not may not stand in a class.
namespace control_curve {

// What one form makes of many pairs of points, but for the rests' sizes: the sums over controls
// that every size scales. Matrix make(covariance of two points) is asked of each sum once.
template <class Matrix, class Make>
class Kernels {
 public:
  Kernels(const ControlPrior& prior, const LevelForm& form, Make make)
      : prior_(prior), form_(form), make_(std::move(make)) {
    base_ = make_([&](const Seen& a, const Seen& b) { return prior.Covariance(form, {}, a, b); });
    other_ = joint_ = Matrix::Zero(base_.rows(), base_.cols());
    const auto other = [&](const Seen& a, const Seen& b) { return prior.OtherRest(a, b); };
    const auto joint = [&](const Seen& a, const Seen& b) { return prior.JointRest(a, b); };
    if (prior.HasOthers()) other_ = make_(other);
    if (prior.HasMany()) joint_ = make_(joint);
  }

  [[nodiscard]] Matrix Under(const Rests& rests) {
    return base_ + rests.level * rests.level * Level(rests) + rests.other * rests.other * other_ +
           rests.joint * rests.joint * joint_;
  }

 private:
  struct OfLevel {
    double length = 1.0;
    bool by_label = false;
    Matrix matrix;
  };

  [[nodiscard]] const Matrix& Level(const Rests& rests) {
    for (const OfLevel& known : levels_) {
      const bool same = known.length == rests.level_length && known.by_label == rests.by_label;
      if (same) return known.matrix;
    }
    levels_.push_back({rests.level_length, rests.by_label, make_([&](const Seen& a, const Seen& b) {
                         return prior_.LevelRest(form_, rests, a, b);
                       })});
    return levels_.back().matrix;
  }

  const ControlPrior& prior_;
  LevelForm form_;
  Make make_;
  Matrix base_, other_, joint_;
  std::vector<OfLevel> levels_;  // those that were asked for
};

// of(a, b) over all pairs of the points that were read.
struct OfPairs {
  const std::vector<Seen>& seen;

  template <class Of>
  [[nodiscard]] Eigen::MatrixXd operator()(const Of& of) const {
    const auto n = static_cast<Eigen::Index>(seen.size());
    Eigen::MatrixXd matrix(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j <= i; ++j) {
        matrix(i, j) = matrix(j, i) =
            of(seen[static_cast<std::size_t>(i)], seen[static_cast<std::size_t>(j)]);
      }
    }
    return matrix;
  }
};

// What f(at), or f(at) - f(from), has in common with every point that was read; last its own
// variance.
struct OfContrast {
  const std::vector<Seen>& seen;
  Seen at;
  std::optional<Seen> from;

  template <class Of>
  [[nodiscard]] Eigen::VectorXd operator()(const Of& of) const {
    const auto n = static_cast<Eigen::Index>(seen.size());
    Eigen::VectorXd row(n + 1);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Seen& point = seen[static_cast<std::size_t>(i)];
      row[i] = of(point, at) - (from ? of(point, *from) : 0.0);
    }
    row[n] = of(at, at) + (from ? of(*from, *from) - 2.0 * of(at, *from) : 0.0);
    return row;
  }
};

using PairKernels = Kernels<Eigen::MatrixXd, OfPairs>;
using ContrastKernels = Kernels<Eigen::VectorXd, OfContrast>;

}  // namespace control_curve

using control_curve::ContrastKernels;
using control_curve::OfContrast;
using control_curve::PairKernels;

struct ControlCurve::Hypotheses {
  using AllSeen = std::shared_ptr<const std::vector<Seen>>;  // the points that were read
  struct One {
    LevelForm form;
    Rests rests;
    AllSeen seen;  // the same of all hypotheses of one form, which stand side by side
    double center = 0.0;
    Eigen::LLT<Eigen::MatrixXd> solver;
    Eigen::VectorXd weights;  // K^-1 (y - mean)
    double evidence = -std::numeric_limits<double>::infinity();
  };

  std::vector<CurvePoint> points;
  ControlPrior prior;
  std::vector<One> all;  // evidence holds their shares, which make 1

  Hypotheses(std::vector<ControlKind> kinds, CurveTarget target, std::vector<CurvePoint> read)
      : points(std::move(read)), prior(std::move(kinds), target, points) {
    Average();
  }

  [[nodiscard]] std::vector<Seen> SeenUnder(const LevelForm& form) const {
    std::vector<Seen> seen;
    for (const CurvePoint& point : points) seen.push_back(prior.See(point.at, form));
    return seen;
  }

  [[nodiscard]] std::optional<One> Solve(const LevelForm& form, const AllSeen& seen,
                                         PairKernels& kernels, const Rests& rests) const {
    One one;
    one.form = form;
    one.rests = rests;
    one.seen = seen;
    const auto n = static_cast<Eigen::Index>(points.size());
    Eigen::VectorXd off(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      off[i] = points[k].value - (*one.seen)[k].mean;
    }
    one.center = off.mean();
    off.array() -= one.center;
    Eigen::MatrixXd covariance = kernels.Under(rests);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double sd = points[static_cast<std::size_t>(i)].sd;
      covariance(i, i) += sd * sd;
    }
    one.solver.compute(covariance);
    if (one.solver.info() != Eigen::Success) return std::nullopt;
    one.weights = one.solver.solve(off);
    double ln_determinant = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      ln_determinant += std::log(one.solver.matrixLLT()(i, i));
    }
    one.evidence =
        -0.5 * off.dot(one.weights) - ln_determinant + std::log(one.form.weight * rests.weight);
    if (!std::isfinite(one.evidence)) return std::nullopt;
    return one;
  }

  // The forms that the readings make likeliest under rests of middle size, likeliest first.
  [[nodiscard]] std::vector<LevelForm> LikelyForms() const {
    const std::vector<LevelForm> forms = prior.Forms();
    if (forms.size() <= kFewestForms) return forms;
    const Rests middling{0.02, 0.8, false, 0.05, 0.01, 1.0};
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < forms.size(); ++i) {
      const auto seen = std::make_shared<const std::vector<Seen>>(SeenUnder(forms[i]));
      PairKernels kernels(prior, forms[i], {*seen});
      const auto one = Solve(forms[i], seen, kernels, middling);
      if (one) order.emplace_back(-one->evidence, i);
    }
    std::ranges::sort(order);
    double whole = 0.0;
    for (const auto& [cost, form] : order) whole += std::exp(order.front().first - cost);
    std::vector<LevelForm> kept;
    double left = whole;
    for (const auto& [cost, form] : order) {
      const bool enough = kept.size() >= kFewestForms && left < kShareLeftOut * whole;
      if (enough || kept.size() == kMostForms) break;
      kept.push_back(forms[form]);
      left -= std::exp(order.front().first - cost);
    }
    return kept;
  }

  // The rests that did not fall behind under the likeliest form, all of which `all` still holds in
  // their order.
  void KeepLikely(std::vector<Rests>& rests, double best) const {
    std::vector<Rests> kept;
    for (const One& one : all) {
      if (one.evidence >= best - kLeastEvidence) kept.push_back(one.rests);
    }
    rests = std::move(kept);
  }

  void Average() {
    std::vector<Rests> rests = prior.AllRests();
    double best = -std::numeric_limits<double>::infinity();
    const std::vector<LevelForm> forms = LikelyForms();
    for (std::size_t i = 0; i < forms.size(); ++i) {
      if (i == 1) KeepLikely(rests, best);
      const auto seen = std::make_shared<const std::vector<Seen>>(SeenUnder(forms[i]));
      PairKernels kernels(prior, forms[i], {*seen});
      for (const Rests& one : rests) {
        auto solved = Solve(forms[i], seen, kernels, one);
        if (!solved || solved->evidence < best - kLeastEvidence) continue;
        best = std::max(best, solved->evidence);
        all.push_back(*std::move(solved));
      }
    }
    std::erase_if(all, [&](const One& one) { return one.evidence < best - kLeastEvidence; });
    double sum = 0.0;
    for (One& one : all) sum += one.evidence = std::exp(one.evidence - best);
    for (One& one : all) one.evidence /= sum;
  }

  // The mean and the variance of f(a), or of f(a) - f(b).
  [[nodiscard]] CurveValue Of(const Labels& a, const Labels* b) const {
    const auto n = static_cast<Eigen::Index>(points.size());
    double mean = 0.0;
    double square = 0.0;
    std::optional<ContrastKernels> kernels;
    double expected = 0.0;
    const std::vector<Seen>* form = nullptr;
    for (const One& one : all) {
      if (one.seen.get() != form) {
        form = one.seen.get();
        Seen at = prior.See(a, one.form);
        std::optional<Seen> from;
        if (b != nullptr) from = prior.See(*b, one.form);
        expected = at.mean - (from ? from->mean : 0.0);
        kernels.emplace(prior, one.form, OfContrast{*form, std::move(at), std::move(from)});
      }
      const Eigen::VectorXd contrast = kernels->Under(one.rests);
      const auto row = contrast.head(n);
      const double value = expected + row.dot(one.weights) + (b == nullptr ? one.center : 0.0);
      double variance = contrast[n];
      variance -= one.solver.matrixL().solve(row).squaredNorm();
      mean += one.evidence * value;
      square += one.evidence * (std::max(0.0, variance) + value * value);
    }
    return {mean, std::sqrt(std::max(0.0, square - mean * mean))};
  }
};

ControlCurve::ControlCurve(std::vector<ControlKind> kinds, CurveTarget target,
                           std::vector<CurvePoint> points)
    : hypotheses_(std::make_unique<Hypotheses>(std::move(kinds), target, std::move(points))) {}

ControlCurve::~ControlCurve() = default;
ControlCurve::ControlCurve(ControlCurve&& other) noexcept = default;
ControlCurve& ControlCurve::operator=(ControlCurve&& other) noexcept = default;

CurveValue ControlCurve::At(const std::vector<double>& labels) const {
  return hypotheses_->Of(labels, nullptr);
}

CurveValue ControlCurve::Difference(const std::vector<double>& a,
                                    const std::vector<double>& b) const {
  return hypotheses_->Of(a, &b);
}

}  // namespace lightcal::fit
