// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/align_frames.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <variant>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/parallel.h"
#include "lightcal/imaging/bracket/frame_agreement.h"
#include "lightcal/imaging/bracket/frame_blocks.h"

namespace lightcal {
namespace {

constexpr double kCertainPixels = 0.5;
constexpr double kLeftAtMost = 0.25;
constexpr double kHalf = 0.5;

int WholePeriods(double pixels, int period) {
  return static_cast<int>(std::lround(pixels / period)) * period;
}

// How far b's picture lies from a's.
Result<FrameAlignment::Moved> MovedBetween(const Blocks& a, const Blocks& b,
                                           const std::string& name, const std::string& other,
                                           bool& evidence) {
  const Differences still = Compare(a, b, a.mean);
  if (!Worth(still)) return FrameAlignment::Moved{};
  evidence = true;
  const auto found = FindShift(a, b, still, kLeastShiftPixels);
  const bool certain = found && found->sd < kCertainPixels && found->left.share() < kLeftAtMost;
  if (certain) return FrameAlignment::Moved{-found->dx, -found->dy, found->sd, 0, 0};
  if (!found && still.share() < kHalf) return FrameAlignment::Moved{};
  return Refused("misaligned", name,
                 PercentText(still.share()) + " of it differs from " + other +
                     ", and no shift explains that for certain: the camera turned, zoomed, or the "
                     "scene changed. Leave this frame out, or shoot again on a tripod");
}

}  // namespace

bool FrameAlignment::any() const {
  return interpolated || std::any_of(moved.begin(), moved.end(), [](const Moved& m) {
           return m.taken_back_x != 0 || m.taken_back_y != 0;
         });
}

Result<FrameAlignment> MeasureAlignment(const BracketMerger& merger) {
  const std::size_t n = merger.frames().size();
  const SignalFrame& first = merger.frames()[0];
  std::vector<Blocks> blocks(n);
  ParallelFor(static_cast<int>(n), [&](int k) {
    blocks[static_cast<std::size_t>(k)] = BlocksOf(merger, static_cast<std::size_t>(k));
  });
  FrameAlignment alignment;
  alignment.moved.resize(n);
  const int columns = first.column_period, rows = first.row_period;
  int left = 0, top = 0, right = first.width, bottom = first.height;
  for (std::size_t k = 1; k < n; ++k) {
    const auto step = MovedBetween(blocks[k - 1], blocks[k], merger.frames()[k].name,
                                   merger.frames()[k - 1].name, alignment.evidence);
    if (!step) return tl::unexpected(step.error());
    FrameAlignment::Moved& moved = alignment.moved[k];
    const FrameAlignment::Moved& before = alignment.moved[k - 1];
    moved = {before.x + step->x, before.y + step->y, std::hypot(before.sd, step->sd), 0, 0};
    moved.taken_back_x = WholePeriods(moved.x, columns);
    moved.taken_back_y = WholePeriods(moved.y, rows);
    left = std::max(left, -moved.taken_back_x);
    top = std::max(top, -moved.taken_back_y);
    right = std::min(right, first.width - moved.taken_back_x);
    bottom = std::min(bottom, first.height - moved.taken_back_y);
  }
  alignment.x = left;
  alignment.y = top;
  alignment.width = right - left;
  alignment.height = bottom - top;
  const auto shared =
      CheckShared(alignment.width, alignment.height, first, merger.frames()[n - 1].name);
  if (!shared) return tl::unexpected(shared.error());
  return alignment;
}

Result<void> CheckShared(int width, int height, const SignalFrame& whole, const std::string& name) {
  if (width >= kHalf * whole.width && height >= kHalf * whole.height) return {};
  return Refused("misaligned", name,
                 "the camera moved so far that the frames share less than half of the picture");
}

void TakeBack(const FrameAlignment& alignment, std::vector<SignalFrame>& frames) {
  for (std::size_t k = 0; k < frames.size(); ++k) {
    SignalFrame& frame = frames[k];
    const FrameAlignment::Moved& moved = alignment.moved[k];
    frame.samples = std::visit(
        [&](const auto& view) -> SampleView {
          return view.Crop(alignment.x + moved.taken_back_x, alignment.y + moved.taken_back_y,
                           alignment.width, alignment.height);
        },
        frame.samples);
    frame.width = alignment.width;
    frame.height = alignment.height;
  }
}

}  // namespace lightcal
