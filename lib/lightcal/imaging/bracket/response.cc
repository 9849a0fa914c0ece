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
#include "lightcal/imaging/bracket/code_pairs.h"

namespace lightcal {
namespace {

constexpr double kLeastCodeShare = 1.0 / 3.0;

bool SharesEnough(std::span<const CodePair> pairs) {
  std::vector<bool> seen(kCodeSteps, false);
  for (const CodePair& pair : pairs) {
    for (int a = 0; a < kCodeSteps; ++a) {
      for (int b = 0; b < kCodeSteps; ++b) {
        if (pair.count[static_cast<std::size_t>(a * kCodeSteps + b)] == 0.0) continue;
        seen[static_cast<std::size_t>(a)] = seen[static_cast<std::size_t>(b)] = true;
      }
    }
  }
  const auto shared = static_cast<double>(std::count(seen.begin(), seen.end(), true));
  return shared >= kLeastCodeShare * kCodeSteps;
}

// Signals of all codes, between the steps a power law.
std::vector<float> SignalsOf(const Eigen::VectorXd& g, const CodeSteps& steps) {
  std::vector<float> signals;
  for (int code = 0; code <= static_cast<int>(steps.top()); ++code) {
    const double at = steps.At(std::max(kLeastStep, static_cast<double>(code)));
    const int low = std::clamp(static_cast<int>(at), 1, kCodeSteps - 2);
    const double share = (std::log(at) - LnStep(low)) / (LnStep(low + 1) - LnStep(low));
    const double ln = g(low) + share * (g(low + 1) - g(low)) - g(kCodeSteps - 1);
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

// Neighbours in exposure and next neighbours, of every channel.
using ChannelPairs = std::vector<std::vector<CodePair>>;

Result<ChannelPairs> CountPairs(std::span<const Frame> frames, std::span<const std::size_t> order,
                                const CodeSteps& steps) {
  const FrameInfo& info = frames[0].info;
  const std::vector<int> nearest = steps.Nearest();
  ChannelPairs pairs(static_cast<std::size_t>(std::min(info.channels, 3)));
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    for (std::size_t i = 0; i < order.size(); ++i) {
      for (std::size_t j = i + 1; j < std::min(i + 3, order.size()); ++j) {
        const auto* a = std::get_if<CodeView>(&frames[order[i]].samples);
        const auto* b = std::get_if<CodeView>(&frames[order[j]].samples);
        if (a == nullptr || b == nullptr) return NoResponse(info.file, "its samples are no codes");
        pairs[c].push_back(CountPair(*a, *b, static_cast<int>(c), nearest));
        pairs[c].back().first = order[i];
        pairs[c].back().second = order[j];
      }
    }
  }
  return pairs;
}

}  // namespace

double HighestCode(const FrameInfo& info) {
  return info.levels ? double{info.levels->white[0]} : 255.0;
}

Result<RecoveredResponse> RecoverResponse(std::span<const Frame> frames,
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
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return exposure[i]; });
  const FrameInfo& info = frames[0].info;
  const CodeSteps steps(HighestCode(info));
  if (auto ordered = CheckOrder(frames, exposure, order, steps.top()); !ordered) {
    return Propagate(std::move(ordered));
  }
  const auto pairs = CountPairs(frames, order, steps);
  if (!pairs) return tl::unexpected(pairs.error());
  RecoveredResponse recovered;
  recovered.exposures = MeasureCodeExposures(*pairs, steps, exposure);
  const std::vector<double>& ln_exposure = recovered.exposures.ln_exposure;
  for (std::size_t c = 0; c < pairs->size(); ++c) {
    const std::vector<CodePair> neighbours = Neighbours((*pairs)[c], ln_exposure, true);
    if (!SharesEnough(neighbours)) {
      return NoResponse(info.file, "the frames share too few codes to tell the camera's curve");
    }
    recovered.curves.signal_of_code[c] = SignalsOf(CurveOf(neighbours, ln_exposure, steps), steps);
  }
  return recovered;
}

}  // namespace lightcal
