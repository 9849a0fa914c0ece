// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/label_choices.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>

#include "lightcal/imaging/bracket/exposure_ratios.h"

namespace lightcal {
namespace {

constexpr double kOddSd = std::numbers::ln2;  // of a label that is odd: a stop
constexpr double kOddShare = 0.03;            // of all labels: judgement

struct PowerPrior {
  double sd = 0.0;  // 0: any power is as good
  double ln_share = 0.0;
  bool odd = false;
};

using Vector = Eigen::Map<const Eigen::VectorXd>;

Vector VectorOf(std::span<const double> v) {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}

LabelChoice ChoiceOf(const Vector& x, const Vector& d, std::vector<std::size_t> odd,
                     const PowerPrior& power) {
  Eigen::VectorXd sd = Eigen::VectorXd::Constant(x.size(), kLabelSd);
  for (const std::size_t i : odd) sd(static_cast<Eigen::Index>(i)) = kOddSd;
  Eigen::MatrixXd rows(x.size(), 2);
  rows.col(0) = sd.cwiseInverse();
  rows.col(1) = x.cwiseQuotient(sd);
  const Eigen::VectorXd whitened = d.cwiseQuotient(sd);
  Eigen::Matrix2d normal = rows.transpose() * rows;
  double ln_power = power.ln_share;
  if (power.sd > 0.0) {
    normal(1, 1) += 1.0 / (power.sd * power.sd);
    ln_power -= std::log(power.sd);
  }
  const Eigen::Vector2d answer = normal.inverse() * (rows.transpose() * whitened);
  if (power.sd > 0.0) ln_power -= 0.5 * std::pow(answer(1) / power.sd, 2);
  const double ln_odd = static_cast<double>(odd.size()) * std::log(kOddShare);
  return {
      std::move(odd), power.odd, answer(0), answer(1),
      ln_power + ln_odd - sd.array().log().sum() - 0.5 * (whitened - rows * answer).squaredNorm()};
}

}  // namespace

std::vector<LabelChoice> LabelChoices(std::span<const double> labels,
                                      std::span<const double> differences,
                                      const std::optional<CurvePower>& power) {
  const Vector x = VectorOf(labels), d = VectorOf(differences);
  constexpr std::size_t kFramesForTwo = 5;  // three others agree
  std::vector<PowerPrior> powers = {{}};
  if (power) {
    powers = {{power->sd, std::log(1.0 - power->odd_share), false},
              {power->odd_sd, std::log(power->odd_share), true}};
  }
  std::vector<LabelChoice> choices;
  for (const PowerPrior& of : powers) {
    choices.push_back(ChoiceOf(x, d, {}, of));
    for (std::size_t i = 0; i < labels.size(); ++i) {
      choices.push_back(ChoiceOf(x, d, std::vector{i}, of));
      for (std::size_t j = i + 1; j < labels.size() && labels.size() >= kFramesForTwo; ++j) {
        choices.push_back(ChoiceOf(x, d, std::vector{i, j}, of));
      }
    }
  }
  return choices;
}

bool AreCertain(std::span<const LabelChoice> choices) {
  const double most =
      std::ranges::max_element(choices, {}, &LabelChoice::ln_probability)->ln_probability;
  double all = 0.0, none = 0.0;
  std::map<std::size_t, double> odd;
  for (const LabelChoice& choice : choices) {
    const double probability = std::exp(choice.ln_probability - most);
    all += probability;
    if (choice.odd.empty()) none += probability;
    for (const std::size_t i : choice.odd) odd[i] += probability;
  }
  const auto known = [&](double one) {
    return one < (1.0 - kCertainLabel) * all || one > kCertainLabel * all;
  };
  return known(none) && std::ranges::all_of(odd, [&](const auto& of) { return known(of.second); });
}

WeighedLabels WeighLabels(std::span<const double> ln_label, std::span<const double> ln_measured,
                          const std::vector<bool>& measured, const CurvePower& power) {
  WeighedLabels weighed;
  weighed.off.assign(ln_label.size(), 0.0);
  std::vector<Eigen::Index> joined;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (measured[i]) joined.push_back(static_cast<Eigen::Index>(i));
  }
  if (joined.size() < 2) return weighed;
  const auto n = static_cast<Eigen::Index>(ln_label.size());
  Eigen::VectorXd x = VectorOf(ln_label);
  const Eigen::VectorXd d = VectorOf(ln_measured) - x;
  x.array() -= x(joined).mean();
  const Eigen::VectorXd at = x(joined);
  const Eigen::VectorXd differ = d(joined);
  const std::vector<LabelChoice> choices =
      LabelChoices({at.data(), joined.size()}, {differ.data(), joined.size()}, power);
  const double most =
      std::ranges::max_element(choices, {}, &LabelChoice::ln_probability)->ln_probability;
  const auto probability = [&](const LabelChoice& choice) {
    return std::exp(choice.ln_probability - most);
  };
  double all = 0.0, of_odd_curve = 0.0;
  for (const LabelChoice& choice : choices) {
    all += probability(choice);
    of_odd_curve += choice.odd_curve ? probability(choice) : 0.0;
  }
  // Of the likelier curve the choices together: of two labels that are as odd, half of each.
  const bool odd_curve = of_odd_curve > 0.5 * all;
  const auto off_by = [&](const LabelChoice& choice) -> Eigen::VectorXd {
    return ((x + d).array() - choice.constant) / (1.0 + choice.factor) - x.array();
  };
  Eigen::VectorXd off = Eigen::VectorXd::Zero(n);
  double shares = 0.0;
  for (const LabelChoice& choice : choices) {
    if (choice.odd_curve != odd_curve) continue;
    off += probability(choice) * off_by(choice);
    shares += probability(choice);
  }
  off /= shares;
  const double spread = std::max(at.squaredNorm(), kLabelSd * kLabelSd);
  double gauge = 0.0, slope = 0.0;
  for (const LabelChoice& choice : choices) {
    const Eigen::VectorXd apart = (off_by(choice) - off)(joined);
    gauge += probability(choice) * std::pow(apart.mean(), 2);
    slope += probability(choice) * std::pow(apart.dot(at) / spread, 2);
  }
  weighed.gauge_sd = std::sqrt(gauge / all);
  weighed.power_sd = std::sqrt(slope / all);
  weighed.certain =
      AreCertain(choices) && std::abs(of_odd_curve - 0.5 * all) > (kCertainLabel - 0.5) * all;
  weighed.off.assign(off.data(), off.data() + n);
  return weighed;
}

}  // namespace lightcal
