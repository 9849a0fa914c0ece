// SPDX-License-Identifier: Apache-2.0
#include "merge_truth.h"

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

}  // namespace lightcal::test
