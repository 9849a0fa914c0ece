// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/align_prepared.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/imaging/bracket/frame_motions.h"
#include "lightcal/imaging/bracket/resample_frame.h"

namespace lightcal {
namespace {

constexpr double kStillPixels = 0.15;  // root mean square: of a frame that stays where it is
constexpr double kBorderPeriods = 2.0;
// Codes before their response is known: most cameras' curves are near this.
constexpr double kNominalGamma = 2.2;
constexpr double kLowestCode = 12.0 / 255.0, kHighestCode = 247.0 / 255.0;
constexpr NoiseProfile kNominalNoise{6e-5, 2e-8};  // of about a code
// Of 16 bit, which no code's width hides.
constexpr double kLowestShare = 0.001;
constexpr NoiseProfile kNominalFineNoise{2e-6, 1e-14};

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

ResponseCurves NominalCurves(const ResponseCurves& like) {
  ResponseCurves curves = like;
  for (auto& curve : curves.signal_of_code) {
    for (std::size_t code = 0; code < curve.size(); ++code) {
      curve[code] = static_cast<float>(std::pow(
          static_cast<double>(code) / static_cast<double>(curve.size() - 1), kNominalGamma));
    }
  }
  return curves;
}

Result<BracketMotion> MotionOf(const PreparedFrames& prepared,
                               std::span<const NoiseProfile> noise) {
  if (!IsEncoded(prepared)) return MeasureMotion(prepared.signals, noise, 0.0);
  // The recovered curve is of frames that may have moved.
  const ResponseCurves nominal = NominalCurves(prepared.response);
  std::vector<SignalFrame> signals = prepared.signals;
  for (SignalFrame& signal : signals) {
    signal.response = &nominal;
    signal.clip.fill(static_cast<float>(std::pow(kHighestCode, kNominalGamma)));
  }
  const bool fine = nominal.signal_of_code[0].size() > 256;
  return MeasureMotion(
      signals, std::vector<NoiseProfile>(signals.size(), fine ? kNominalFineNoise : kNominalNoise),
      std::pow(fine ? kLowestShare : kLowestCode, kNominalGamma));
}

// How the middle of the picture moved and turned.
FrameAlignment::Moved MovedBy(const FrameMotion& motion, double width, double height) {
  const Homography& h = motion.from_reference;
  const double x = 0.5 * width, y = 0.5 * height, arm = 0.25 * width;
  const auto [u, v] = h(x, y);
  const auto [left_u, left_v] = h(x - arm, y);
  const auto [right_u, right_v] = h(x + arm, y);
  FrameAlignment::Moved moved{u - x, v - y, motion.sd_pixels, 0, 0, h, 0.0};
  moved.turned_deg = std::atan2(right_v - left_v, right_u - left_u) * 180.0 / std::numbers::pi;
  return moved;
}

// Codes as they would be had the camera stood still, for their curve alone.
Result<Frame> CodesInPlace(const Homography& h, const Region& region, const Frame& frame) {
  FrameInfo plain = frame.info;
  const float top = plain.levels ? plain.levels->white[0] : 255.0F;
  plain.meaning = SampleMeaning::kSensor;
  Frame codes{plain, frame.samples, frame.owner, false};
  auto signals = SignalOf(codes);
  if (!signals) return Propagate(std::move(signals));
  if (auto done = ResampleFrame(h, region, codes, *signals); !done) {
    return Propagate(std::move(done));
  }
  const auto values = std::get<View2d<const float>>(codes.samples);
  auto rounded = std::make_shared<std::vector<std::uint16_t>>();
  for (int y = 0; y < region.height; ++y) {
    for (const float value : values.row(y)) {
      rounded->push_back(
          static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * top)));
    }
  }
  codes.info.meaning = SampleMeaning::kEncoded;
  codes.samples = View2d<const std::uint16_t>(rounded->data(), region.width, region.height,
                                              codes.info.channels);
  codes.owner = std::move(rounded);
  return codes;
}

// The curve of codes that lie in one place.
Result<void> RecoverAgain(const FrameAlignment& alignment, const Region& region,
                          std::span<const double> labels, PreparedFrames& prepared) {
  std::vector<Frame> in_place;
  std::vector<double> exposure;
  for (std::size_t k = 0; k < prepared.signals.size(); ++k) {
    const std::size_t at = prepared.planned.order[k];
    auto codes = CodesInPlace(*alignment.moved[k].from_reference, region, prepared.frames[at]);
    if (!codes) return Propagate(std::move(codes));
    in_place.push_back(std::move(*codes));
    exposure.push_back(labels[at]);
  }
  auto response = RecoverResponse(in_place, exposure);
  if (!response) return Propagate(std::move(response));
  prepared.response = std::move(*response);
  return {};
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

Result<void> Interpolate(const BracketMotion& motion, std::span<const double> labels,
                         PreparedFrames& prepared) {
  const int width = prepared.signals.front().width, height = prepared.signals.front().height;
  FrameAlignment alignment;
  alignment.interpolated = alignment.evidence = true;
  alignment.reference = motion.reference;
  std::vector<Homography> from_reference;
  for (const FrameMotion& frame : motion.frames) {
    alignment.moved.push_back(MovedBy(frame, width, height));
    from_reference.push_back(frame.from_reference);
  }
  const Region region = SharedRegion(from_reference, width, height,
                                     kBorderPeriods * ColorPeriod(prepared.signals.front()));
  auto shared = CheckShared(region.width, region.height, prepared.signals.front(),
                            prepared.signals.back().name);
  if (!shared) return shared;
  alignment.x = region.x;
  alignment.y = region.y;
  alignment.width = region.width;
  alignment.height = region.height;
  if (IsEncoded(prepared)) {
    if (auto done = RecoverAgain(alignment, region, labels, prepared); !done) return done;
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
  auto motion = MotionOf(prepared, plan.noise);
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
  if (auto done = Interpolate(*motion, labels, prepared); !done) return done;
  if (auto planned = PlanAgain(std::move(merge), prepared); !planned) return planned;
  Append(left_out, prepared.planned.warnings);
  return {};
}

}  // namespace lightcal
