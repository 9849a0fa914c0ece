// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/response.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/imaging/bracket/all_saturated.h"

namespace lightcal {
namespace {

constexpr int kSteps = 256;
constexpr double kLeastStep = 0.5;               // ln of a step has no end at 0
constexpr int kLowestStep = 3;                   // below, noise is cut off at black
constexpr double kHighestShare = 249.0 / 255.0;  // of the top code; above, the codes fill up
constexpr double kGamma = 2.2;                   // what most cameras' curves are near
constexpr double kStepSd = 1.0;
constexpr double kSmoothness = 2e3;
// Code below which curves may have a toe; sRGB's slope over ln(code) is 1 at 10, 1.6 at 32. Softer
// above, a curve follows what compression rounded plain parts to.
constexpr double kToeEnd = 32.0;
constexpr double kMovedLn = 0.25;  // a residual from which a pixel probably shows something else
constexpr int kTurns = 5;
constexpr double kLeastCodeShare = 1.0 / 3.0;
constexpr double kLeastRise = 1e-4;  // of g a step: curves increase

using CodeView = View2d<const std::uint16_t>;

// n(a, b): how often one pixel shows step a in the first and step b in the second frame.
struct PairCounts {
  double ln_ratio = 0.0;
  std::vector<double> count = std::vector<double>(kSteps * kSteps, 0.0);
};

// Where a code lies among the steps: codes of 8 bits are steps; of more, steps are finer in the
// dark, where linear codes have most of a scene.
class CodeSteps {
 public:
  explicit CodeSteps(double top) : top_(top), fine_(top > 255.0) {}
  [[nodiscard]] double At(double code) const {
    const double share = code / top_;
    return (kSteps - 1) * (fine_ ? std::sqrt(share) : share);
  }
  // Of each code, 0 where it does not count.
  [[nodiscard]] std::vector<int> Nearest() const {
    std::vector<int> steps;
    for (int code = 0; code <= static_cast<int>(top_); ++code) {
      const int step = static_cast<int>(At(code) + 0.5);
      steps.push_back(step < kLowestStep || code > kHighestShare * top_ ? 0 : step);
    }
    return steps;
  }
  // How little a curve's slope over ln(step) changes from this step to the next, 1 in the middle:
  // in the toe of 8 bit codes with every ln(step) alike; where steps are fine, by what they are of
  // 8 bit codes.
  [[nodiscard]] double Stiffness(int step) const {
    if (!fine_) return std::pow(std::min(1.0, step / kToeEnd), 3);
    return 1.0 / std::pow(std::max(1.0, 2.0 * step / (kSteps - 1)), 3);
  }
  [[nodiscard]] double top() const { return top_; }

 private:
  double top_;
  bool fine_;
};

// ln of a step; a power law's curve is straight over it.
double LnStep(double step) { return std::log(std::max(step, kLeastStep)); }

PairCounts CountPair(const CodeView& a, const CodeView& b, int channel,
                     const std::vector<int>& steps, double ln_ratio) {
  const auto step_of = [&](std::uint16_t code) {
    return steps[std::min<std::size_t>(code, steps.size() - 1)];
  };
  PairCounts pair;
  pair.ln_ratio = ln_ratio;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const int first = step_of(a(x, y, channel)), second = step_of(b(x, y, channel));
      if (first == 0 || second == 0) continue;
      pair.count[static_cast<std::size_t>(first * kSteps + second)] += 1.0;
    }
  }
  return pair;
}

// The variance of ln(signal) that an uncertainty of one code means there.
double StepVariance(const Eigen::VectorXd& g, int step) {
  const int low = std::max(step - 2, 0), high = std::min(step + 2, kSteps - 1);
  const double slope = std::max((g(high) - g(low)) / (high - low), kLeastRise);
  return slope * slope * kStepSd * kStepSd;
}

Eigen::VectorXd StartCurve() {
  Eigen::VectorXd g(kSteps);
  for (int step = 0; step < kSteps; ++step) {
    g(step) = kGamma * (LnStep(step) - LnStep(kSteps - 1));
  }
  return g;
}

// One weighted least squares solution, with weights of the curve so far.
Eigen::VectorXd Solve(std::span<const PairCounts> pairs, const CodeSteps& steps,
                      const Eigen::VectorXd& so_far, bool trust_residuals) {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(kSteps, kSteps);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(kSteps);
  for (const PairCounts& pair : pairs) {
    for (int a = kLowestStep; a < kSteps; ++a) {
      const double variance_a = StepVariance(so_far, a);
      for (int b = kLowestStep; b < kSteps; ++b) {
        const double count = pair.count[static_cast<std::size_t>(a * kSteps + b)];
        if (count == 0.0) continue;
        double weight = count / (variance_a + StepVariance(so_far, b));
        if (trust_residuals) {
          const double residual = (so_far(b) - so_far(a) - pair.ln_ratio) / kMovedLn;
          weight /= (1.0 + residual * residual) * (1.0 + residual * residual);
        }
        normal(a, a) += weight;
        normal(b, b) += weight;
        normal(a, b) -= weight;
        normal(b, a) -= weight;
        right(b) += weight * pair.ln_ratio;
        right(a) -= weight * pair.ln_ratio;
      }
    }
  }
  // Little change of slope over ln(step), so that any power law is free; by step, as in
  // (g'' + g'/z)^2.
  const double smooth = kSmoothness * normal.diagonal().mean();
  for (int step = 1; step + 1 < kSteps; ++step) {
    const double before = 1.0 / (step * (LnStep(step) - LnStep(step - 1)));
    const double after = 1.0 / (step * (LnStep(step + 1) - LnStep(step)));
    const std::array<double, 3> k = {before, -before - after, after};
    const double weight = smooth * steps.Stiffness(step);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        normal(step - 1 + i, step - 1 + j) +=
            weight * k[static_cast<std::size_t>(i)] * k[static_cast<std::size_t>(j)];
      }
    }
  }
  // Gauge: the top step is signal 1.
  normal(kSteps - 1, kSteps - 1) += normal.diagonal().maxCoeff();
  return normal.ldlt().solve(right);
}

// The nearest increasing curve: neighbours that fall are replaced by their mean.
void MakeIncreasing(Eigen::VectorXd& g) {
  struct Block {
    double mean;
    int count;
  };
  std::vector<Block> blocks;
  for (int step = 0; step < kSteps; ++step) {
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

bool SharesEnough(std::span<const PairCounts> pairs) {
  std::vector<bool> seen(kSteps, false);
  for (const PairCounts& pair : pairs) {
    for (int a = 0; a < kSteps; ++a) {
      for (int b = 0; b < kSteps; ++b) {
        if (pair.count[static_cast<std::size_t>(a * kSteps + b)] == 0.0) continue;
        seen[static_cast<std::size_t>(a)] = seen[static_cast<std::size_t>(b)] = true;
      }
    }
  }
  const auto shared = static_cast<double>(std::count(seen.begin(), seen.end(), true));
  return shared >= kLeastCodeShare * kSteps;
}

// Signals of all codes, between the steps a power law.
std::vector<float> SignalsOf(const Eigen::VectorXd& g, const CodeSteps& steps) {
  std::vector<float> signals;
  for (int code = 0; code <= static_cast<int>(steps.top()); ++code) {
    const double at = steps.At(std::max(kLeastStep, static_cast<double>(code)));
    const int low = std::clamp(static_cast<int>(at), 1, kSteps - 2);
    const double share = (std::log(at) - LnStep(low)) / (LnStep(low + 1) - LnStep(low));
    const double ln = g(low) + share * (g(low + 1) - g(low)) - g(kSteps - 1);
    signals.push_back(static_cast<float>(std::exp(ln)));
  }
  return signals;
}

// Codes of two frames, the second of which should be the brighter: how many fell, and rose, by two
// steps of 8 bits and more.
struct CodeMoves {
  double fell = 0.0, rose = 0.0;
};

CodeMoves MovesOf(const CodeView& a, const CodeView& b, double top) {
  const int least = std::max(1, static_cast<int>(2.0 * top / 255.0));
  constexpr std::size_t kEnough = 4'000'000;  // samples
  const std::size_t all = a.row(0).size() * static_cast<std::size_t>(a.height());
  const int step = static_cast<int>(all / kEnough) + 1;
  CodeMoves moves;
  for (int y = 0; y < a.height(); y += step) {
    const auto first = a.row(y), second = b.row(y);
    for (std::size_t i = 0; i < first.size(); ++i) {
      const int rise = int{second[i]} - int{first[i]};
      if (rise >= least) moves.rose += 1.0;
      if (rise <= -least) moves.fell += 1.0;
    }
  }
  return moves;
}

// A curve that rises cannot make codes fall where there was more light: any set of exposures would
// find some curve otherwise. Each frame beside the next that is longer by half a stop.
Result<void> CheckOrder(std::span<const Frame> frames, std::span<const double> exposure,
                        std::span<const std::size_t> order, double top) {
  constexpr double kLeastFell = 64.0, kMostFell = 0.75;
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    const auto longer = std::find_if(
        order.begin() + static_cast<std::ptrdiff_t>(i), order.end(),
        [&](std::size_t j) { return exposure[j] > std::numbers::sqrt2 * exposure[order[i]]; });
    if (longer == order.end()) break;
    const auto* a = std::get_if<CodeView>(&frames[order[i]].samples);
    const auto* b = std::get_if<CodeView>(&frames[*longer].samples);
    const bool alike = a != nullptr && b != nullptr && a->width() == b->width() &&
                       a->height() == b->height() && a->channels() == b->channels();
    if (!alike) continue;  // said elsewhere
    const CodeMoves moves = MovesOf(*a, *b, top);
    if (moves.fell < kLeastFell || moves.fell < kMostFell * (moves.fell + moves.rose)) continue;
    const double stops = std::log2(exposure[*longer] / exposure[order[i]]);
    return Refused("exposures_disagree", frames[*longer].info.file,
                   "it is darker than " + frames[order[i]].info.file +
                       ", though its tags or {merge.exposures} give it " + RoundedText(stops, 2) +
                       " EV more; give the exposures in the order of the files, or leave this "
                       "frame out (a lens cap? a flash that did not fire?)");
  }
  return {};
}

// Frames that show nothing tell of no curve, however many they are.
Result<void> CheckCodes(std::span<const Frame> frames, double top) {
  const double dark = 2.0 * top / 255.0;  // two steps of 8 bits: black, and its noise
  bool any_light = false, any_unsaturated = false;
  for (const Frame& frame : frames) {
    const auto* codes = std::get_if<CodeView>(&frame.samples);
    if (codes == nullptr) return {};
    for (int y = 0; y < codes->height() && !(any_light && any_unsaturated); ++y) {
      const auto [least, most] = std::ranges::minmax(codes->row(y));
      any_light = any_light || most > dark;
      any_unsaturated = any_unsaturated || least < top;
    }
  }
  const std::string& name = frames.front().info.file;
  if (!any_light) {
    return Refused("all_black", name,
                   "no frame shows more than black; expose longer, take the lens cap off");
  }
  if (any_unsaturated) return {};
  return AllSaturated(name);
}

tl::unexpected<Error> NoResponse(const std::string& file, const std::string& why) {
  return Refused("no_response", file,
                 why +
                     "; shoot RAW, or two to five frames 1 to 2 EV apart that show the same "
                     "parts well exposed, or state a curve that was kept from such a bracket "
                     "({merge.response}, or response in a [[capture]])");
}

}  // namespace

double HighestCode(const FrameInfo& info) {
  return info.levels ? double{info.levels->white[0]} : 255.0;
}

Result<ResponseCurves> RecoverResponse(std::span<const Frame> frames,
                                       std::span<const double> exposure) {
  if (!frames.empty()) {
    auto seen = CheckCodes(frames, HighestCode(frames[0].info));
    if (!seen) return Propagate(std::move(seen));
  }
  if (frames.size() < 2) {
    return NoResponse(frames.empty() ? "merge" : frames[0].info.file,
                      "one frame does not tell by which curve its codes were made");
  }
  std::vector<std::size_t> order(frames.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return exposure[i] < exposure[j]; });
  const FrameInfo& info = frames[0].info;
  const CodeSteps steps(HighestCode(info));
  const std::vector<int> nearest = steps.Nearest();
  if (auto ordered = CheckOrder(frames, exposure, order, steps.top()); !ordered) {
    return Propagate(std::move(ordered));
  }
  ResponseCurves curves;
  for (int channel = 0; channel < std::min(info.channels, 3); ++channel) {
    std::vector<PairCounts> pairs;
    for (std::size_t i = 1; i < order.size(); ++i) {
      const auto* a = std::get_if<CodeView>(&frames[order[i - 1]].samples);
      const auto* b = std::get_if<CodeView>(&frames[order[i]].samples);
      if (a == nullptr || b == nullptr) return NoResponse(info.file, "its samples are no codes");
      const double ln_ratio = std::log(exposure[order[i]] / exposure[order[i - 1]]);
      if (ln_ratio < 0.1) continue;
      pairs.push_back(CountPair(*a, *b, channel, nearest, ln_ratio));
    }
    if (!SharesEnough(pairs)) {
      return NoResponse(info.file, "the frames share too few codes to tell the camera's curve");
    }
    Eigen::VectorXd g = StartCurve();
    for (int turn = 0; turn < kTurns; ++turn) {
      g = Solve(pairs, steps, g, turn >= kTurns / 2);
      MakeIncreasing(g);
    }
    curves.signal_of_code[static_cast<std::size_t>(channel)] = SignalsOf(g, steps);
  }
  return curves;
}

}  // namespace lightcal
