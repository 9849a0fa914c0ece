// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/code_exposures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "lightcal/imaging/bracket/code_pairs.h"
#include "lightcal/imaging/bracket/exposure_ratios.h"
#include "lightcal/imaging/bracket/label_choices.h"

namespace lightcal {
namespace {

// Labels stand unless neighbours differ under them by this share of ln(ratio), and by so many times
// more than under the exposures measured. Source: discs before a plain ground, patches, cloudy
// scenes and a room through sRGB, a power and two films, as PNG and JPEG 80: at most 2.2 times with
// true labels (where a disc's bend alone moves exposures by .4), of all but discs 3 to 300 times
// with one 1.33 times wrong.
constexpr double kLeastMisfit = 0.01, kContradicts = 3.0;
// A pair of frames that shares fewer pixels than this share of what another pair does tells of no
// exposure: few frames alike would have no scale.
constexpr double kLeastShared = 0.05;

using Frames = std::vector<Eigen::Index>;
using Channels = std::vector<std::vector<CodePair>>;

// Of each channel the pairs that share enough, and their frames.
Frames KeepShared(Channels& channels, std::size_t frames) {
  std::vector<double> pixels(channels.front().size(), 0.0);
  for (const auto& channel : channels) {
    for (std::size_t k = 0; k < channel.size(); ++k) {
      pixels[k] += std::reduce(channel[k].count.begin(), channel[k].count.end());
    }
  }
  const double enough = kLeastShared * std::ranges::max(pixels);
  std::vector<bool> joined(frames, false);
  for (auto& channel : channels) {
    std::size_t k = 0;
    std::erase_if(channel, [&](const CodePair&) { return !(pixels[k++] > enough); });
    for (const CodePair& pair : channel) joined[pair.first] = joined[pair.second] = true;
  }
  Frames kept;
  for (std::size_t i = 0; i < frames; ++i) {
    if (joined[i]) kept.push_back(static_cast<Eigen::Index>(i));
  }
  return kept;
}

// Directions in which exposures of those frames may differ from labels x without being a common
// factor of their ratios: columns orthogonal to 1 and to x.
Eigen::MatrixXd FreeDirections(const Eigen::VectorXd& x, const Frames& joined) {
  const auto n = static_cast<Eigen::Index>(joined.size());
  Eigen::MatrixXd fixed(n, 2);
  fixed.col(0).setOnes();
  fixed.col(1) = x(joined);
  const Eigen::MatrixXd all =
      Eigen::HouseholderQR<Eigen::MatrixXd>(fixed).householderQ() * Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd free = Eigen::MatrixXd::Zero(x.size(), n - 2);
  free(joined, Eigen::all) = all.rightCols(n - 2);
  return free;
}

// What exposures differ from labels by, in those directions.
Eigen::VectorXd SolveFree(const Channels& channels, const CodeSteps& steps,
                          const Eigen::VectorXd& x, const Frames& joined) {
  const Eigen::MatrixXd free = FreeDirections(x, joined);
  Eigen::VectorXd along = Eigen::VectorXd::Zero(free.cols());
  std::vector<Eigen::VectorXd> curves(channels.size(), StartCurve());
  for (int turn = 0; turn < kCurveTurns; ++turn) {
    const Eigen::VectorXd at = x + free * along;
    // A frame that shares nothing keeps its label.
    Eigen::MatrixXd normal =
        Eigen::MatrixXd::Identity(free.cols(), free.cols()) / (kLabelSd * kLabelSd);
    Eigen::VectorXd right = -normal * along;
    const std::span ln_exposure(at.data(), static_cast<std::size_t>(at.size()));
    const bool trust_residuals = turn >= kCurveTurns / 2;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const auto e = EquationsOf(channels[c], ln_exposure, steps, curves[c], trust_residuals);
      const Eigen::LDLT<Eigen::MatrixXd> solver(e.curve);
      const Eigen::MatrixXd mixed = e.mixed * free;
      curves[c] = solver.solve(e.right);
      normal += free.transpose() * e.exposures * free - mixed.transpose() * solver.solve(mixed);
      right += free.transpose() * e.exposures_right - mixed.transpose() * curves[c];
      MakeIncreasing(curves[c]);
    }
    along += normal.ldlt().solve(right);
  }
  return free * along;
}

// What neighbours differ by in ln(signal) under their best curve, as a share of ln(ratio), level by
// level: the mean of all pixels.
double MisfitOf(const Channels& channels, const CodeSteps& steps,
                std::span<const double> ln_exposure) {
  constexpr int kLowest = 12;             // step; below, noise is cut off at black
  constexpr double kLevel = 0.2;          // of ln(step)
  constexpr std::size_t kLevels = 16;     // up to the highest step
  constexpr double kLeastOfLevel = 50.0;  // pixels
  constexpr double kLeastLnRatio = 0.1;   // of frames whose labels are alike
  double sum = 0.0, all = 0.0;
  for (const auto& channel : channels) {
    const Eigen::VectorXd g = CurveOf(Neighbours(channel, ln_exposure, true), ln_exposure, steps);
    for (const CodePair& pair : Neighbours(channel, ln_exposure, false)) {
      const double ln_ratio = ln_exposure[pair.second] - ln_exposure[pair.first];
      const double of = std::max(std::abs(ln_ratio), kLeastLnRatio);
      std::array<double, kLevels> count{}, mean{};
      for (int a = kLowest; a < kCodeSteps; ++a) {
        for (int b = kLowest; b < kCodeSteps; ++b) {
          const double n = pair.count[static_cast<std::size_t>(a * kCodeSteps + b)];
          if (n == 0.0) continue;
          const double middle = 0.5 * (LnStep(a) + LnStep(b)) - LnStep(kLowest);
          const auto level = static_cast<std::size_t>(middle / kLevel);
          count[level] += n;
          mean[level] += n * (g(b) - g(a) - ln_ratio);
        }
      }
      for (std::size_t level = 0; level < kLevels; ++level) {
        if (count[level] < kLeastOfLevel) continue;
        sum += std::abs(mean[level] / of);
        all += count[level];
      }
    }
  }
  return all > 0.0 ? sum / all : 0.0;
}

// What labels alone leave open about a curve's power.
double PowerOfLabels(std::span<const double> ln_label) {
  const double apart = ln_label.empty() ? 0.0 : ln_label.back() - ln_label.front();
  return apart == 0.0 ? 0.0 : std::numbers::sqrt2 * kLabelSd / std::abs(apart);
}

// How far the power may be from the best choice's: that of any choice that is not improbable.
double ReachOfChoices(std::span<const LabelChoice> choices, const LabelChoice& best) {
  constexpr double kImprobable = 0.01;
  double all = 0.0, farthest = 0.0;
  const auto probability = [&](const LabelChoice& choice) {
    return std::exp(choice.ln_probability - best.ln_probability);
  };
  for (const LabelChoice& choice : choices) all += probability(choice);
  for (const LabelChoice& choice : choices) {
    if (probability(choice) < kImprobable * all) continue;
    farthest = std::max(farthest, std::abs(choice.factor - best.factor));
  }
  return farthest;
}

}  // namespace

CodeExposures MeasureCodeExposures(std::span<const std::vector<CodePair>> channels,
                                   const CodeSteps& steps, std::span<const double> label) {
  CodeExposures answer;
  for (const double l : label) answer.ln_exposure.push_back(std::log(l));
  answer.off.assign(label.size(), 0.0);
  if (label.size() < 3) {
    answer.power_sd = PowerOfLabels(answer.ln_exposure);
    return answer;
  }
  Channels shared(channels.begin(), channels.end());
  const Frames joined = KeepShared(shared, label.size());
  if (joined.size() < 3) return answer;
  Eigen::VectorXd labels = Eigen::Map<const Eigen::VectorXd>(
      answer.ln_exposure.data(), static_cast<Eigen::Index>(label.size()));
  labels.array() -= labels(joined).mean();
  const Eigen::VectorXd x = labels(joined);
  if (x.cwiseAbs().maxCoeff() < kLabelSd) return answer;
  const Eigen::VectorXd moved = SolveFree(shared, steps, labels, joined);
  const Eigen::VectorXd measured = labels + moved, d = moved(joined);
  const double misfit = MisfitOf(shared, steps, answer.ln_exposure);
  const double least = MisfitOf(shared, steps, {measured.data(), label.size()});
  if (!(misfit > std::max(kLeastMisfit, kContradicts * least))) return answer;
  const std::vector<LabelChoice> choices =
      LabelChoices({x.data(), joined.size()}, {d.data(), joined.size()});
  const LabelChoice best = *std::ranges::max_element(choices, {}, &LabelChoice::ln_probability);
  answer.certain = AreCertain(choices);
  double all = 0.0, square = 0.0;
  for (const LabelChoice& choice : choices) {
    const double probability = std::exp(choice.ln_probability - best.ln_probability);
    all += probability;
    square += probability * (choice.factor - best.factor) * (choice.factor - best.factor);
  }
  if (!answer.certain || best.odd.empty()) {
    answer.power_reach = ReachOfChoices(choices, best) / (1.0 + best.factor);
  }
  double scatter = 0.0, spread = 0.0, kept = 0.0;
  for (Eigen::Index at = 0; at < x.size(); ++at) {
    const auto frame = static_cast<std::size_t>(joined[static_cast<std::size_t>(at)]);
    const double off = (x(at) + d(at) - best.constant) / (1.0 + best.factor) - x(at);
    answer.off[frame] = off;
    answer.ln_exposure[frame] += off;
    if (std::ranges::find(best.odd, static_cast<std::size_t>(at)) != best.odd.end()) continue;
    scatter += off * off;
    spread += x(at) * x(at);
    kept += 1.0;
  }
  const double of_rest = scatter / std::max(1.0, kept - 2.0) / spread;
  answer.power_sd = std::sqrt(square / all + of_rest) / (1.0 + best.factor);
  return answer;
}

}  // namespace lightcal
