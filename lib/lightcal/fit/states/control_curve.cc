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

// What one form makes of all pairs of points, but for the rests' sizes: the sums over controls that
// every size scales.
struct Kernels {
  LevelForm form;
  std::shared_ptr<const std::vector<Seen>> seen;
  Eigen::MatrixXd base, other, joint;
  struct OfLevel {
    double length = 1.0;
    bool by_label = false;
    Eigen::MatrixXd matrix;
  };
  std::vector<OfLevel> levels;  // those that were asked for
};

}  // namespace control_curve

using control_curve::Kernels;

struct ControlCurve::Hypotheses {
  struct One {
    LevelForm form;
    Rests rests;
    std::shared_ptr<const std::vector<Seen>> seen;
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

  // of(a, b) over all pairs of points.
  template <class Of>
  [[nodiscard]] static Eigen::MatrixXd Pairs(const std::vector<Seen>& seen, const Of& of) {
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

  [[nodiscard]] Kernels KernelsOf(const LevelForm& form) const {
    Kernels kernels;
    kernels.form = form;
    std::vector<Seen> seen;
    for (const CurvePoint& point : points) seen.push_back(prior.See(point.at, form));
    kernels.base =
        Pairs(seen, [&](const Seen& a, const Seen& b) { return prior.Covariance(form, {}, a, b); });
    kernels.other = kernels.joint = Eigen::MatrixXd::Zero(kernels.base.rows(), kernels.base.cols());
    const auto other = [&](const Seen& a, const Seen& b) { return prior.OtherRest(a, b); };
    const auto joint = [&](const Seen& a, const Seen& b) { return prior.JointRest(a, b); };
    if (prior.HasOthers()) kernels.other = Pairs(seen, other);
    if (prior.HasMany()) kernels.joint = Pairs(seen, joint);
    kernels.seen = std::make_shared<const std::vector<Seen>>(std::move(seen));
    return kernels;
  }

  [[nodiscard]] const Eigen::MatrixXd& LevelKernel(Kernels& kernels, const Rests& rests) const {
    for (const Kernels::OfLevel& known : kernels.levels) {
      const bool same = known.length == rests.level_length && known.by_label == rests.by_label;
      if (same) return known.matrix;
    }
    Eigen::MatrixXd matrix = Pairs(*kernels.seen, [&](const Seen& a, const Seen& b) {
      return prior.LevelRest(kernels.form, rests, a, b);
    });
    kernels.levels.push_back({rests.level_length, rests.by_label, std::move(matrix)});
    return kernels.levels.back().matrix;
  }

  [[nodiscard]] std::optional<One> Solve(Kernels& kernels, const Rests& rests) const {
    One one;
    one.form = kernels.form;
    one.rests = rests;
    one.seen = kernels.seen;
    const auto n = static_cast<Eigen::Index>(points.size());
    Eigen::VectorXd off(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      off[i] = points[k].value - (*one.seen)[k].mean;
    }
    one.center = off.mean();
    off.array() -= one.center;
    Eigen::MatrixXd covariance =
        kernels.base + rests.level * rests.level * LevelKernel(kernels, rests) +
        rests.other * rests.other * kernels.other + rests.joint * rests.joint * kernels.joint;
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
      Kernels kernels = KernelsOf(forms[i]);
      const auto one = Solve(kernels, middling);
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
      Kernels kernels = KernelsOf(forms[i]);
      for (const Rests& one : rests) {
        auto solved = Solve(kernels, one);
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
    for (const One& one : all) {
      const Seen at = prior.See(a, one.form);
      const Seen from = b != nullptr ? prior.See(*b, one.form) : Seen{};
      const auto covariance = [&](const Seen& u, const Seen& v) {
        return prior.Covariance(one.form, one.rests, u, v);
      };
      Eigen::VectorXd row(n);
      for (Eigen::Index i = 0; i < n; ++i) {
        const Seen& point = (*one.seen)[static_cast<std::size_t>(i)];
        row[i] = covariance(point, at) - (b != nullptr ? covariance(point, from) : 0.0);
      }
      double value = at.mean + row.dot(one.weights);
      double variance = covariance(at, at);
      if (b != nullptr) {
        value -= from.mean;
        variance += covariance(from, from) - 2.0 * covariance(at, from);
      } else {
        value += one.center;
      }
      variance -= row.dot(one.solver.solve(row));
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
