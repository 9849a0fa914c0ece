// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/states/control_curve.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

namespace lightcal::fit {
namespace {

using Labels = std::vector<double>;

// Colour against a level: the logarithm's zero, so that a label of 0 has a place.
constexpr double kLevelFloor = 0.03;
constexpr double kConstantVariance = 25.0;
// Of exp(mean of ln evidence): a hypothesis that makes the readings less probable is left out.
constexpr double kLeastEvidence = 7.0;
constexpr std::size_t kFormsKept = 8;

// How far each target may go for one unit of the rests' sizes, and by the slopes' priors.
struct TargetScale {
  double level_rest, other_rest, joint_rest;
  double level_slope, other_slope;
};
constexpr std::array<TargetScale, 3> kScales = {
    {{1.0, 1.0, 1.0, 0.0, 0.5}, {0.2, 0.4, 0.3, 0.3, 0.3}, {0.05, 0.03, 0.05, 0.002, 0.004}}};
constexpr double kOtherLength = 0.45;  // of a control's range

}  // namespace

// Of ControlCurve alone; named, since what is not may not stand in a class.
namespace control_curve {

// ln E = power ln(x + zero) of one level; the zero within step, the power within power_sd.
struct LevelForm {
  int control = -1;
  double zero = kLevelFloor;
  double step = 0.0;
  double power = 0.0, power_sd = 0.0;
  double weight = 1.0;
};

struct Rests {
  double level = 0.0, level_length = 1.0;
  bool by_label = false;  // along the label itself, not its logarithm; of light, kinks
  double other = 0.0;
  double joint = 0.0;
  double weight = 1.0;
};

inline double Matern(double distance, double length) {
  const double r = std::sqrt(3.0) * std::abs(distance) / length;
  return (1.0 + r) * std::exp(-r);
}

// A driver's output in pieces of straight line: its slope walks at random from label 0 (integrated
// Brownian motion, Rasmussen and Williams 6.3), by this many times the rest's size up to full; over
// the output itself, which turns it into a part of it.
constexpr double kSlopeOfRest = 6.5;
inline double Kinks(double a, double b, double output_a, double output_b) {
  const double s = std::min(a, b);
  const double t = std::max(a, b);
  return kSlopeOfRest * kSlopeOfRest * s * s * (3.0 * t - s) / 6.0 / (output_a * output_b);
}

// A point's labels as one hypothesis sees them.
struct Seen {
  std::vector<double> along;   // one coordinate a control
  std::vector<double> labels;  // as they were said
  double mean = 0.0;
  double ln_level = 0.0, by_zero = 0.0;  // of the formed level
};

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
using control_curve::Kinks;
using control_curve::LevelForm;
using control_curve::Matern;
using control_curve::Rests;
using control_curve::Seen;

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

  std::vector<ControlKind> kinds;
  CurveTarget target = CurveTarget::kLnLight;
  std::vector<CurvePoint> points;
  std::vector<double> middle, span;  // of each control's coordinate, over the points
  std::vector<One> all;              // evidence holds their shares, which make 1

  [[nodiscard]] const TargetScale& scale() const {
    return kScales[static_cast<std::size_t>(target)];
  }

  [[nodiscard]] double Plain(std::size_t control, double label) const {
    switch (kinds[control]) {
      case ControlKind::kLevel:
        return std::log(label + kLevelFloor);
      case ControlKind::kTemperature:
        return std::log(1e6 / label);
      case ControlKind::kOther:
        break;
    }
    return label;
  }

  [[nodiscard]] Seen See(const Labels& labels, const LevelForm& form) const {
    Seen out;
    out.labels = labels;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      const bool formed = static_cast<int>(i) == form.control;
      double along = Plain(i, labels[i]);
      if (formed) {
        const double above = std::max(1e-6, labels[i] + form.zero);
        along = out.ln_level = std::log(above);
        out.by_zero = form.power / above;
        out.mean += form.power * out.ln_level;
      } else if (kinds[i] == ControlKind::kLevel) {
        if (target == CurveTarget::kLnLight) out.mean += along;
      } else {
        if (kinds[i] == ControlKind::kTemperature && target == CurveTarget::kLnMired) {
          out.mean += along;
        }
        along = (along - middle[i]) / span[i];
      }
      out.along.push_back(along);
    }
    return out;
  }

  // Of size 1, of the level i.
  [[nodiscard]] static double LevelRest(const LevelForm& form, const Rests& rests, const Seen& a,
                                        const Seen& b, std::size_t i) {
    if (!rests.by_label) return Matern(a.along[i] - b.along[i], rests.level_length);
    if (static_cast<int>(i) != form.control) {
      return Matern(a.labels[i] - b.labels[i], rests.level_length);
    }
    return Kinks(a.labels[i], b.labels[i], std::exp(a.ln_level), std::exp(b.ln_level));
  }

  // Of size 1, of all controls but levels.
  [[nodiscard]] double OtherRest(const Seen& a, const Seen& b) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      if (kinds[i] != ControlKind::kLevel) sum += Matern(a.along[i] - b.along[i], kOtherLength);
    }
    return scale().other_rest * scale().other_rest * sum;
  }
  // Of size 1, of all controls together.
  [[nodiscard]] double JointRest(const Seen& a, const Seen& b) const {
    double product = scale().joint_rest * scale().joint_rest;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      const double length = kinds[i] == ControlKind::kLevel ? 1.5 : 0.7;
      product *= Matern(a.along[i] - b.along[i], length);
    }
    return product;
  }

  [[nodiscard]] double Covariance(const One& one, const Seen& a, const Seen& b) const {
    const TargetScale& by = scale();
    const double level = by.level_rest * one.rests.level;
    double sum = kConstantVariance;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      const double u = a.along[i];
      const double v = b.along[i];
      const bool is_level = kinds[i] == ControlKind::kLevel;
      if (!is_level) {
        sum += by.other_slope * by.other_slope * u * v;
      } else if (static_cast<int>(i) == one.form.control) {
        sum += one.form.power_sd * one.form.power_sd * a.ln_level * b.ln_level +
               one.form.step * one.form.step * a.by_zero * b.by_zero;
      } else {
        sum += by.level_slope * by.level_slope * u * v;
      }
      if (is_level && level > 0.0) sum += level * level * LevelRest(one.form, one.rests, a, b, i);
    }
    const Rests& rests = one.rests;
    if (rests.other > 0.0) sum += rests.other * rests.other * OtherRest(a, b);
    if (rests.joint > 0.0) sum += rests.joint * rests.joint * JointRest(a, b);
    return sum;
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
    for (const CurvePoint& point : points) seen.push_back(See(point.at, form));
    One none;
    none.form = form;
    kernels.base =
        Pairs(seen, [&](const Seen& a, const Seen& b) { return Covariance(none, a, b); });
    kernels.other = kernels.joint = Eigen::MatrixXd::Zero(kernels.base.rows(), kernels.base.cols());
    const auto other = [&](const Seen& a, const Seen& b) { return OtherRest(a, b); };
    const auto joint = [&](const Seen& a, const Seen& b) { return JointRest(a, b); };
    if (HasOthers()) kernels.other = Pairs(seen, other);
    if (kinds.size() > 1) kernels.joint = Pairs(seen, joint);
    kernels.seen = std::make_shared<const std::vector<Seen>>(std::move(seen));
    return kernels;
  }

  [[nodiscard]] const Eigen::MatrixXd& LevelKernel(Kernels& kernels, const Rests& rests) const {
    for (const Kernels::OfLevel& known : kernels.levels) {
      const bool same = known.length == rests.level_length && known.by_label == rests.by_label;
      if (same) return known.matrix;
    }
    const double scaled = scale().level_rest * scale().level_rest;
    Eigen::MatrixXd matrix = Pairs(*kernels.seen, [&](const Seen& a, const Seen& b) {
      double sum = 0.0;
      for (std::size_t i = 0; i < kinds.size(); ++i) {
        if (kinds[i] != ControlKind::kLevel) continue;
        sum += scaled * LevelRest(kernels.form, rests, a, b, i);
      }
      return sum;
    });
    kernels.levels.push_back({rests.level_length, rests.by_label, std::move(matrix)});
    return kernels.levels.back().matrix;
  }

  [[nodiscard]] bool HasOthers() const {
    return std::ranges::any_of(kinds, [](ControlKind kind) { return kind != ControlKind::kLevel; });
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

  // Zeros a fifth of (x_min + zero) apart; within a step the likeliest is found by the solve.
  [[nodiscard]] std::vector<LevelForm> Forms() const {
    const auto level = std::ranges::find(kinds, ControlKind::kLevel);
    if (target != CurveTarget::kLnLight || level == kinds.end()) return {LevelForm{}};
    const auto control = static_cast<std::size_t>(level - kinds.begin());
    double least = std::numeric_limits<double>::infinity();
    for (const CurvePoint& point : points) least = std::min(least, point.at[control]);
    constexpr double kStep = 0.2;
    const double smallest = std::max(least, 0.01);
    const double end = std::log(12.0 * smallest + 0.3);
    std::vector<LevelForm> forms;
    for (double ln = std::log(std::max(0.04 * smallest, 2e-3)); ln < end; ln += kStep) {
      const double above = std::exp(ln);
      LevelForm form{static_cast<int>(control), above - least, 0.5 * kStep * above, 1.0, 0.02, 1.0};
      forms.push_back(form);
      form.power = 2.0;
      form.power_sd = 1.2;
      form.weight = 0.5;
      forms.push_back(form);
    }
    return forms;
  }

  [[nodiscard]] std::vector<Rests> AllRests() const {
    using Sized = std::pair<double, double>;  // size, weight
    const bool level = std::ranges::count(kinds, ControlKind::kLevel) > 0;
    struct Level {
      double length = 1.0;
      bool by_label = false;
    };
    const std::vector<Sized> none = {{0.0, 1.0}};
    const std::vector<Sized> level_sizes =
        level ? std::vector<Sized>{{0.003, 0.7}, {0.012, 1.5}, {0.03, 3.0}} : none;
    const std::vector<Sized> other_sizes =
        HasOthers() ? std::vector<Sized>{{0.008, 1.0}, {0.04, 2.0}, {0.16, 2.0}} : none;
    const std::vector<Sized> joint_sizes =
        kinds.size() > 1 ? std::vector<Sized>{{0.002, 1.5}, {0.015, 1.0}} : none;
    // Drivers bend at labels; what lamps do goes with the logarithm.
    const std::vector<Level> levels =
        level ? std::vector<Level>{{0.25, false}, {1.5, false}, {0.3, true}}
              : std::vector<Level>{Level{}};
    std::vector<Rests> out;
    for (const auto& [a, by_a] : level_sizes) {
      for (const Level& one : levels) {
        for (const auto& [b, by_b] : other_sizes) {
          for (const auto& [c, by_c] : joint_sizes) {
            out.push_back({a, one.length, one.by_label, b, c, by_a * by_b * by_c});
          }
        }
      }
    }
    return out;
  }

  void FindMiddles() {
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      double least = std::numeric_limits<double>::infinity();
      double most = -least;
      double sum = 0.0;
      for (const CurvePoint& point : points) {
        const double along = Plain(i, point.at[i]);
        least = std::min(least, along);
        most = std::max(most, along);
        sum += along;
      }
      middle.push_back(sum / static_cast<double>(points.size()));
      span.push_back(most > least ? most - least : 1.0);
    }
  }

  // The forms that the readings make likeliest under rests of middle size.
  [[nodiscard]] std::vector<LevelForm> LikelyForms() const {
    std::vector<LevelForm> forms = Forms();
    if (forms.size() <= kFormsKept) return forms;
    const Rests middling{0.02, 0.8, false, 0.05, 0.01, 1.0};
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < forms.size(); ++i) {
      Kernels kernels = KernelsOf(forms[i]);
      const auto one = Solve(kernels, middling);
      if (one) order.emplace_back(-one->evidence, i);
    }
    std::ranges::sort(order);
    std::vector<LevelForm> kept;
    for (std::size_t i = 0; i < std::min(kFormsKept, order.size()); ++i) {
      kept.push_back(forms[order[i].second]);
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
    FindMiddles();
    std::vector<Rests> rests = AllRests();
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
      const Seen at = See(a, one.form);
      const Seen from = b != nullptr ? See(*b, one.form) : Seen{};
      Eigen::VectorXd row(n);
      for (Eigen::Index i = 0; i < n; ++i) {
        const Seen& point = (*one.seen)[static_cast<std::size_t>(i)];
        row[i] = Covariance(one, point, at) - (b != nullptr ? Covariance(one, point, from) : 0.0);
      }
      double value = at.mean + row.dot(one.weights);
      double variance = Covariance(one, at, at);
      if (b != nullptr) {
        value -= from.mean;
        variance += Covariance(one, from, from) - 2.0 * Covariance(one, at, from);
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
    : hypotheses_(std::make_unique<Hypotheses>()) {
  hypotheses_->kinds = std::move(kinds);
  hypotheses_->target = target;
  hypotheses_->points = std::move(points);
  hypotheses_->Average();
}

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
