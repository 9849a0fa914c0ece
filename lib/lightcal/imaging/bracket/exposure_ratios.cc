// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/exposure_ratios.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/statistics.h"
#include "lightcal/imaging/bracket/encoded_errors.h"
#include "lightcal/imaging/bracket/label_choices.h"
#include "lightcal/imaging/bracket/pair_ratios.h"

namespace lightcal {
namespace {

constexpr double kModelSd = 2e-4;       // what no residual shows: black levels, slow bends
constexpr double kLabelRatioSd = 0.06;  // of a label's ln ratio: third-stop rounding, 3 % shutter
constexpr double kWarnEv = 0.25;
constexpr double kRefuseEv = 1.0;

// Ratios once more, up to where the sensor is straight; `model_sd` of what no residual shows.
void SumUp(std::span<PairRatio> pairs, double linear_to, double model_sd) {
  for (PairRatio& pair : pairs) {
    const double to = std::min(kBelievedTo, linear_to);
    const auto total = TellingLevels(pair.sums, to);
    const LevelSums sum = total ? *total : SumLevels(pair.sums, 0.002, kBelievedTo);
    pair.ln_ratio = std::log(sum.b / sum.a);
    pair.sd = std::hypot(std::sqrt(sum.d2) / sum.b, model_sd);
  }
}

// Where light changed, a pair whose regions agree may see nothing but what changed: it is as unsure
// as the widest. The labels come beside; each frame's errs by kLabelSd about a common gauge: pairs
// of all, sqrt(n) less sure.
void WeighRegions(std::span<const double> label, std::vector<PairRatio>& pairs) {
  double widest = 0.0;
  for (const PairRatio& pair : pairs) {
    if (pair.regions) widest = std::max(widest, pair.regions->width());
  }
  const double together = 0.5 * std::sqrt(static_cast<double>(pairs.size()));
  for (PairRatio& pair : pairs) {
    if (pair.regions) pair.ln_ratio = pair.regions->middle();
    pair.sd = std::hypot(pair.sd, together * (pair.regions ? pair.regions->width() : widest));
  }
  const double sd = kLabelSd * std::sqrt(static_cast<double>(label.size()));
  for (std::size_t a = 0; a < label.size(); ++a) {
    for (std::size_t b = a + 1; b < label.size(); ++b) {
      pairs.push_back({.a = a, .b = b, .ln_ratio = std::log(label[b] / label[a]), .sd = sd});
    }
  }
}

// The covariance about the mean of all, of one to the first frame.
std::vector<double> AboutMean(const Eigen::MatrixXd& covariance) {
  const Eigen::Index n = covariance.rows();
  const Eigen::MatrixXd centre =
      Eigen::MatrixXd::Identity(n, n) - Eigen::MatrixXd::Constant(n, n, 1.0 / double(n));
  const Eigen::MatrixXd about = centre * covariance * centre;
  return {about.data(), about.data() + about.size()};
}

// min sum ((e_b - e_a - ln_ratio)/sd)^2 with e of the first frame 0.
void SolveNetwork(std::span<const PairRatio> pairs, ExposureRatios& answer) {
  const auto n = static_cast<Eigen::Index>(answer.ln_exposure.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  for (const PairRatio& pair : pairs) {
    const double weight = 1.0 / (pair.sd * pair.sd);
    const auto a = static_cast<Eigen::Index>(pair.a);
    const auto b = static_cast<Eigen::Index>(pair.b);
    normal(a, a) += weight;
    normal(b, b) += weight;
    normal(a, b) -= weight;
    normal(b, a) -= weight;
    right(b) += weight * pair.ln_ratio;
    right(a) -= weight * pair.ln_ratio;
  }
  normal.row(0).setZero();
  normal.col(0).setZero();
  normal(0, 0) = 1.0;
  right(0) = 0.0;
  const Eigen::LDLT<Eigen::MatrixXd> solver(normal);
  const Eigen::VectorXd solution = solver.solve(right);
  Eigen::MatrixXd covariance = solver.solve(Eigen::MatrixXd::Identity(n, n));
  covariance(0, 0) = 0.0;
  const auto changed = [](const PairRatio& pair) { return pair.regions.has_value(); };
  if (std::ranges::any_of(pairs, changed)) answer.covariance = AboutMean(covariance);
  for (Eigen::Index i = 0; i < n; ++i) {
    answer.ln_exposure[static_cast<std::size_t>(i)] = solution(i);
    answer.sd_ln[static_cast<std::size_t>(i)] = i == 0 ? 0.0 : std::sqrt(covariance(i, i));
  }
}

// Neighbours that share nothing are joined by their labels.
void AddLabelPairs(std::span<const std::size_t> order, std::span<const double> label,
                   std::vector<PairRatio>& pairs) {
  const std::size_t measured = pairs.size();
  for (std::size_t i = 1; i < order.size(); ++i) {
    const bool bridged =
        std::any_of(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(measured),
                    [&](const PairRatio& p) { return p.a == order[i - 1] && p.b == order[i]; });
    if (bridged) continue;
    PairRatio pair{.a = order[i - 1], .b = order[i]};
    pair.ln_ratio = std::log(label[pair.b] / label[pair.a]);
    pair.sd = kLabelRatioSd;
    pairs.push_back(pair);
  }
}

std::string EvText(double ln) {
  const double ev = ln / std::numbers::ln2;
  return (ev > 0.0 ? "+" : "") + RoundedText(ev, 2) + " EV";
}

// The pair whose regions lie farthest apart, and the other frames.
Warning LightChanged(std::span<const PairRatio> pairs, std::span<const std::string> names) {
  const PairRatio* worst = nullptr;
  std::vector<bool> seen(names.size(), false);
  for (const PairRatio& pair : pairs) {
    if (!pair.regions) continue;
    seen[pair.a] = seen[pair.b] = true;
    if (!worst || pair.regions->width() > worst->regions->width()) worst = &pair;
  }
  seen[worst->a] = seen[worst->b] = false;
  std::string others;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (seen[i]) others += (others.empty() ? " So, less, in " : ", ") + names[i];
  }
  return {
      "light_changed", names[worst->b],
      "from " + names[worst->a] + " to this frame the light changed in part of the picture, by " +
          PercentText(std::expm1(worst->regions->width())) +
          " against the rest, and nothing tells in which part: exposures are weighed with their "
          "tags, and sigma holds what that leaves open. Keep the light steady (clouds, lamps "
          "that warm up), or take the frames faster." +
          others};
}

Result<void> CompareWithLabels(std::span<const double> label, std::span<const std::string> names,
                               ExposureRatios& answer) {
  std::vector<double> off;
  std::vector<double> joined;
  for (std::size_t i = 0; i < label.size(); ++i) {
    off.push_back(answer.ln_exposure[i] - std::log(label[i]));
    if (answer.measured[i]) joined.push_back(off.back());
  }
  const std::vector<double>& trusted = joined.empty() ? off : joined;
  std::vector<double> ranked = trusted;
  const double median = UpperMedian(ranked);
  double sum = 0.0, count = 0.0;
  for (const double o : trusted) {
    if (std::abs(o - median) > kWarnEv * std::numbers::ln2) continue;
    sum += o;
    count += 1.0;
  }
  const double gauge = sum / count;
  for (std::size_t i = 0; i < label.size(); ++i) {
    answer.ln_exposure[i] -= gauge;
    if (auto named = NameOddLabel(off[i] - gauge, names[i], answer.warnings); !named) return named;
  }
  return {};
}

// As CompareWithLabels, where a curve stands between codes and light.
Result<void> WeighCurve(std::span<const double> label, std::span<const std::string> names,
                        const CurvePower& curve, ExposureRatios& answer) {
  std::vector<double> ln_label;
  for (const double l : label) ln_label.push_back(std::log(l));
  const WeighedLabels weighed = WeighLabels(ln_label, answer.ln_exposure, answer.measured, curve);
  for (std::size_t i = 0; i < label.size(); ++i) {
    answer.ln_exposure[i] = ln_label[i] + weighed.off[i];
    if (!weighed.certain) continue;
    auto named = NameOddLabel(weighed.off[i], names[i], answer.warnings);
    if (!named) return named;
  }
  answer.gauge_sd = weighed.gauge_sd;
  answer.power_sd = weighed.power_sd;
  if (weighed.certain) return {};
  answer.warnings.push_back(
      {"labels_disagree", names.front(),
       "under the stated response the frames were not exposed as their tags or {merge.exposures} "
       "say, and which exposure is wrong, or whether the response is another camera's, they do not "
       "tell: sigma holds each of these; take three frames and more, or check the exposures"});
  return {};
}

}  // namespace

Result<void> NameOddLabel(double off, const std::string& name, Warnings& warnings) {
  const double ev = std::abs(off) / std::numbers::ln2;
  if (ev > kRefuseEv) {
    return Refused(
        "exposures_disagree", name,
        "its picture was exposed " + EvText(off) +
            " from what its tags or {merge.exposures} say, beside the other frames; give "
            "the exposures in the order of the files, or leave this frame out");
  }
  if (ev > kWarnEv) {
    warnings.push_back({"exposure_off", name,
                        "its picture was exposed " + EvText(off) +
                            " from what its tags say; the measured exposure is used"});
  }
  return {};
}

Result<ExposureRatios> MeasureExposureRatios(const SampledSignals& signals,
                                             std::span<const double> label,
                                             std::span<const std::string> names,
                                             const std::optional<CurvePower>& curve,
                                             const ShiftTest& shift) {
  const std::size_t n = label.size();
  ExposureRatios answer;
  answer.ln_exposure.assign(n, 0.0);
  answer.sd_ln.assign(n, 0.0);
  answer.measured.assign(n, false);
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return label[i] < label[j]; });
  std::vector<PairRatio> pairs = MeasurePairs(signals, order);
  if (!curve) answer.linear_to = LinearTo(pairs);
  SumUp(pairs, answer.linear_to, curve ? std::numbers::sqrt2 * kLeastStatedMisfit : kModelSd);
  for (const PairRatio& pair : pairs) answer.measured[pair.a] = answer.measured[pair.b] = true;
  for (PairRatio& pair : pairs) {
    const bool explained =
        curve || (pair.regions && shift && shift(pair.a, pair.b, std::exp(pair.ln_ratio)));
    if (explained) pair.regions.reset();
  }
  if (std::ranges::any_of(pairs, [](const auto& pair) { return pair.regions.has_value(); })) {
    answer.warnings.push_back(LightChanged(pairs, names));
    WeighRegions(label, pairs);
  }
  AddLabelPairs(order, label, pairs);
  SolveNetwork(pairs, answer);
  auto compared =
      curve ? WeighCurve(label, names, *curve, answer) : CompareWithLabels(label, names, answer);
  if (!compared) {
    return Propagate(std::move(compared));
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (n > 1 && !answer.measured[i]) {
      answer.warnings.push_back(
          {"ratio_from_label", names[i],
           "it shares no well exposed part with another frame, so its exposure is its label's, "
           "good to 6 %; take frames 1 to 2 EV apart"});
    }
  }
  return answer;
}

}  // namespace lightcal
