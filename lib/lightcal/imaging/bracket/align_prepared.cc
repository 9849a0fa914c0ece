// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/align_prepared.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/core/units.h"
#include "lightcal/imaging/bracket/code_motion.h"
#include "lightcal/imaging/bracket/frame_motions.h"
#include "lightcal/imaging/bracket/resample_frame.h"

namespace lightcal {
namespace {

constexpr double kStillPixels = 0.15;  // root mean square: of a frame that stays where it is

// The plan of frames that are in a plan's order already and were aligned since.
Result<void> PlanAgain(MergeRequest merge, PreparedFrames& prepared) {
  const std::vector<std::size_t> before = prepared.planned.order;
  const MergeRequest given = merge;
  merge.label_exposure.clear();
  merge.noise_in_file.clear();
  for (const std::size_t i : before) {
    merge.label_exposure.push_back(given.label_exposure[i]);
    merge.noise_in_file.push_back(given.noise_in_file[i]);
  }
  merge.done = [&](std::size_t i) { given.done(before[i]); };
  auto planned = PlanMerge(prepared.signals, merge);
  if (!planned) return Propagate(std::move(planned));
  FrameAlignment& alignment = *prepared.alignment;
  const std::vector<FrameAlignment::Moved> moved = alignment.moved;
  const std::size_t reference = alignment.reference;
  for (std::size_t i = 0; i < planned->order.size(); ++i) {
    const std::size_t was = planned->order[i];
    if (was == reference) alignment.reference = i;
    alignment.moved[i] = moved[was];
    planned->order[i] = before[was];
  }
  prepared.planned = std::move(*planned);
  return {};
}

bool IsEncoded(const PreparedFrames& prepared) {
  return prepared.signals.front().response != nullptr;
}

MovedCodes CodesOf(const PreparedFrames& prepared, std::span<const double> labels) {
  MovedCodes codes{prepared.signals, {}, {}};
  for (const std::size_t at : prepared.planned.order) {
    codes.frames.push_back(&prepared.frames[at]);
    codes.exposure.push_back(labels[at]);
  }
  return codes;
}

// How the middle of the picture moved and turned.
FrameAlignment::Moved MovedBy(const FrameMotion& motion, double width, double height) {
  const Homography& h = motion.from_reference;
  const double x = 0.5 * width, y = 0.5 * height, arm = 0.25 * width;
  const auto [u, v] = h(x, y);
  const auto [left_u, left_v] = h(x - arm, y);
  const auto [right_u, right_v] = h(x + arm, y);
  FrameAlignment::Moved moved{u - x, v - y, motion.sd_pixels, 0, 0, h, 0.0};
  moved.turned_deg = DegreesFromRadians(Radians(std::atan2(right_v - left_v, right_u - left_u)));
  return moved;
}

// Takes the frames out that nothing can be told of.
Warnings LeaveOut(BracketMotion& motion, PreparedFrames& prepared) {
  Warnings warnings;
  for (std::size_t k = motion.frames.size(); k-- > 0;) {
    if (!motion.frames[k].left_out) continue;
    warnings.push_back({"frame_left_out", prepared.signals[k].name,
                        "how the camera moved is not known for certain: " + motion.frames[k].why +
                            "; the picture is made without it"});
    const auto at = static_cast<std::ptrdiff_t>(k);
    motion.frames.erase(motion.frames.begin() + at);
    prepared.signals.erase(prepared.signals.begin() + at);
    prepared.planned.order.erase(prepared.planned.order.begin() + at);
    if (k < motion.reference) --motion.reference;
  }
  return warnings;
}

// Response and exposures of frames that are in one place.
Result<void> FindAgain(const BracketMotion& motion, std::span<const double> labels,
                       const Region& region, MergeRequest& merge, PreparedFrames& prepared) {
  auto recovered = CurveInPlace(CodesOf(prepared, labels), motion, region);
  if (!recovered) return Propagate(std::move(recovered));
  prepared.response = std::move(recovered->curves);
  merge.power_sd = recovered->exposures.power_sd;
  merge.power_reach = recovered->exposures.power_reach;
  prepared.labels_certain = recovered->exposures.certain;
  prepared.label_errors.assign(prepared.frames.size(), 0.0);  // nothing of frames left out
  for (std::size_t k = 0; k < prepared.planned.order.size(); ++k) {
    const std::size_t frame = prepared.planned.order[k];
    merge.label_exposure[frame] = std::exp(recovered->exposures.ln_exposure[k]);
    prepared.label_errors[frame] = recovered->exposures.off[k];
  }
  return {};
}

Result<void> Interpolate(const BracketMotion& motion, std::span<const double> labels,
                         MergeRequest& merge, PreparedFrames& prepared) {
  const int width = prepared.signals.front().width, height = prepared.signals.front().height;
  FrameAlignment alignment;
  alignment.interpolated = alignment.evidence = true;
  alignment.reference = motion.reference;
  std::vector<Homography> from_reference;
  for (const FrameMotion& frame : motion.frames) {
    alignment.moved.push_back(MovedBy(frame, width, height));
    from_reference.push_back(frame.from_reference);
  }
  const Region region = RegionOf(motion, prepared.signals.front());
  auto shared = CheckShared(region.width, region.height, prepared.signals.front(),
                            prepared.signals.back().name);
  if (!shared) return shared;
  alignment.x = region.x;
  alignment.y = region.y;
  alignment.width = region.width;
  alignment.height = region.height;
  if (IsEncoded(prepared) && !merge.stated_response) {
    if (auto found = FindAgain(motion, labels, region, merge, prepared); !found) return found;
  }
  FindClipping(prepared.signals);
  for (std::size_t k = 0; k < prepared.signals.size(); ++k) {
    auto done = ResampleFrame(from_reference[k], region, prepared.frames[prepared.planned.order[k]],
                              prepared.signals[k]);
    if (!done) return done;
  }
  prepared.alignment = std::move(alignment);
  return {};
}

bool IsStill(const BracketMotion& motion, double width, double height) {
  return std::ranges::all_of(motion.frames, [&](const FrameMotion& frame) {
    return !frame.left_out &&
           RmsBetween(frame.from_reference, Homography{}, width, height) <= kStillPixels;
  });
}

// The rms distance of each frame's motion from the whole periods that `whole` takes back.
bool IsWhole(const FrameAlignment& whole, const BracketMotion& motion, double width,
             double height) {
  if (motion.frames.front().left_out) return false;
  const auto to_reference = motion.frames.front().from_reference.Inverse();
  if (!to_reference) return false;
  for (std::size_t k = 0; k < motion.frames.size(); ++k) {
    if (motion.frames[k].left_out) continue;
    const FrameAlignment::Moved& moved = whole.moved[k];
    const Homography shift{
        {1.0, 0.0, 1.0 * moved.taken_back_x, 0.0, 1.0, 1.0 * moved.taken_back_y, 0.0, 0.0, 1.0}};
    const Homography from_first = motion.frames[k].from_reference.After(*to_reference);
    if (RmsBetween(from_first, shift, width, height) > kStillPixels) return false;
  }
  return true;
}

}  // namespace

Result<void> AlignPrepared(MergeRequest merge, std::span<const double> labels,
                           PreparedFrames& prepared) {
  MergePlan plan = prepared.planned.plan;
  // Frames that moved scatter, which is no noise to excuse their differences by.
  if (prepared.planned.noise_source == NoiseSource::kEstimated) {
    plan.noise.assign(plan.noise.size(), kMiddlingNoise);
  }
  const auto merger = BracketMerger::Make(prepared.signals, plan);
  if (!merger) return tl::unexpected(merger.error());
  auto whole = MeasureAlignment(*merger);
  if (whole && !whole->evidence) {
    prepared.alignment = std::move(*whole);
    return {};
  }
  const double width = prepared.signals.front().width, height = prepared.signals.front().height;
  auto motion = IsEncoded(prepared) ? MotionOfCodes(CodesOf(prepared, labels))
                                    : MeasureMotion(prepared.signals, plan.noise, 0.0);
  // A whole shift that explains most of what differs may hide a turn: it does not stand alone.
  if (!motion) return tl::unexpected(motion.error());
  if (IsStill(*motion, width, height)) {
    FrameAlignment nowhere;
    nowhere.moved.resize(prepared.signals.size());
    nowhere.width = prepared.signals.front().width;
    nowhere.height = prepared.signals.front().height;
    nowhere.evidence = true;
    prepared.alignment = std::move(nowhere);
    return {};
  }
  const bool by_whole = whole && IsWhole(*whole, *motion, width, height);
  if (by_whole) {
    prepared.alignment = std::move(*whole);
    if (!prepared.alignment->any()) return {};
    TakeBack(*prepared.alignment, prepared.signals);
    return PlanAgain(std::move(merge), prepared);
  }
  const Warnings left_out = LeaveOut(*motion, prepared);
  if (auto done = Interpolate(*motion, labels, merge, prepared); !done) return done;
  if (auto planned = PlanAgain(std::move(merge), prepared); !planned) return planned;
  Append(left_out, prepared.planned.warnings);
  return {};
}

}  // namespace lightcal
