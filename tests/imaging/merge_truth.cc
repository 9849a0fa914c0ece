// SPDX-License-Identifier: Apache-2.0
#include "merge_truth.h"

#include <cmath>
#include <utility>

namespace lightcal::test {

MergeRequest RequestOf(const std::vector<SyntheticExposure>& series) {
  MergeRequest request;
  for (const SyntheticExposure& exposure : series) {
    request.label_exposure.push_back(LabelExposure(exposure));
  }
  return request;
}

Result<MergedSamples> MergeSamples(const std::vector<Frame>& frames, const MergeRequest& request) {
  std::vector<SignalFrame> signals;
  for (const Frame& frame : frames) {
    auto signal = SignalOf(frame);
    if (!signal) return Propagate(std::move(signal));
    signals.push_back(std::move(*signal));
  }
  auto planned = PlanMerge(signals, request);
  if (!planned) return Propagate(std::move(planned));
  MergedSamples merged;
  merged.planned = *planned;
  const auto merger = BracketMerger::Make(signals, planned->plan);
  if (!merger) return tl::unexpected(merger.error());
  const auto width = static_cast<int>(signals[0].row_samples());
  const int height = signals[0].height;
  merged.value.resize(signals[0].row_samples() * static_cast<std::size_t>(height));
  merged.variance.resize(merged.value.size());
  merged.clipped = merger->MergeRows(0, height, View2d<float>(merged.value.data(), width, height),
                                     View2d<float>(merged.variance.data(), width, height));
  return merged;
}

std::vector<Patch> PatchesOf(const StepWedge& wedge, const MergedSamples& merged, double per_nit) {
  std::vector<Patch> patches(wedge.nits.size());
  const auto each_green = [&](const auto& visit) {
    for (int y = 0; y < wedge.height; ++y) {
      for (int x = 0; x < wedge.width; ++x) {
        if ((x & 1) == (y & 1)) continue;
        visit(patches[static_cast<std::size_t>(wedge.PatchAt(x, y))],
              static_cast<std::size_t>(y) * static_cast<std::size_t>(wedge.width) +
                  static_cast<std::size_t>(x));
      }
    }
  };
  each_green([&](Patch& patch, std::size_t i) {
    patch.count += 1.0;
    patch.mean += double{merged.value[i]} / per_nit;
    patch.claimed += double{merged.variance[i]} / (per_nit * per_nit);
  });
  for (std::size_t p = 0; p < patches.size(); ++p) {
    patches[p].nits = wedge.nits[p];
    patches[p].mean /= patches[p].count;
    patches[p].claimed /= patches[p].count;
  }
  each_green([&](Patch& patch, std::size_t i) {
    const double off = double{merged.value[i]} / per_nit - patch.mean;
    patch.variance += off * off / patch.count;
    const double error = double{merged.value[i]} / per_nit - patch.nits;
    const double sd = std::sqrt(double{merged.variance[i]}) / per_nit;
    patch.covered += std::abs(error) <= sd ? 1.0 / patch.count : 0.0;
  });
  return patches;
}

}  // namespace lightcal::test
