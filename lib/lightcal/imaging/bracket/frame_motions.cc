// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/frame_motions.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "lightcal/core/numbers_text.h"
#include "lightcal/imaging/bracket/motion_pyramid.h"
#include "lightcal/imaging/bracket/pair_motion.h"

namespace lightcal {
namespace {

constexpr int kLongest = 1200;        // cells of the finest level
constexpr double kMostSd = 0.1;       // pixels: .3 at three times what is told
constexpr double kMostRoughSd = 1.0;  // of a rough look
constexpr double kSureSd = 0.1;       // no other way is looked for
constexpr double kDarkestFrom = 1.1;  // times as much as all channels show
constexpr double kLeastSeen = 0.2;
constexpr double kMostApart = 0.6;   // pixels by which two ways to a frame may be
constexpr double kApartSds = 4.0;    // and at least so many standard deviations
constexpr double kMostUnlike = 0.6;  // of the evidence

class Finder {
 public:
  Finder(std::span<const SignalFrame> frames, std::span<const NoiseProfile> noise, double floor,
         const MotionLook& look)
      : frames_(frames), look_(look), width_(frames[0].width), height_(frames[0].height) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      MotionPyramids pyramids = MotionPyramidsOf(frames[i], noise[i], floor, kLongest);
      all_.push_back(std::move(pyramids.all));
      darkest_.push_back(std::move(pyramids.darkest));
      full_.push_back(pyramids.full);
    }
  }

  // `nearer`, whose motion is known, lies between the reference and `k`.
  Result<FrameMotion> Find(std::size_t reference, std::size_t nearer, std::size_t k,
                           const FrameMotion& known) const {
    const auto step = BothWays(nearer, k, Way(nearer, k));
    if (!step) {
      return Unsure("nothing in it can be followed to " + frames_[nearer].name);
    }
    const FrameMotion chained{step->to_other.After(known.from_reference),
                              std::hypot(step->sd_pixels, known.sd_pixels), step->unlike};
    if (nearer != reference) {
      const auto direct =
          BothWays(reference, k, Refine(reference, k, chained.from_reference, StartIs::kClose));
      if (direct && direct->sd_pixels < chained.sd_pixels) {
        const FrameMotion motion{direct->to_other, direct->sd_pixels, direct->unlike};
        const double apart =
            RmsBetween(motion.from_reference, chained.from_reference, width_, height_);
        const double sds = kApartSds * std::hypot(motion.sd_pixels, chained.sd_pixels);
        if (apart < std::max(kMostApart, sds) && WhyUnsure(motion).empty()) return motion;
      }
    }
    if (const std::string why = WhyUnsure(chained); !why.empty()) {
      return Unsure(why);
    }
    return chained;
  }

  // Share of a frame that is neither clipped nor dark.
  [[nodiscard]] double Seen(std::size_t k) const {
    return std::max(all_[k].seen, darkest_[k].seen);
  }

  // Whether a shorter frame may show what this one does not.
  [[nodiscard]] bool IsFullSomewhere(std::size_t k) const { return full_[k]; }

 private:
  // Those of which both frames show more.
  [[nodiscard]] const std::vector<MotionPyramid>& For(std::size_t a, std::size_t b) const {
    const double all = std::min(all_[a].seen, all_[b].seen);
    const double darkest = std::min(darkest_[a].seen, darkest_[b].seen);
    return darkest > kDarkestFrom * all ? darkest_ : all_;
  }
  [[nodiscard]] std::optional<PairMotion> Refine(std::size_t a, std::size_t b,
                                                 const Homography& start, StartIs start_is) const {
    const auto& pyramids = For(a, b);
    return RefineMotion(pyramids[a], pyramids[b], width_, height_, start, start_is);
  }
  [[nodiscard]] std::optional<PairMotion> Way(std::size_t a, std::size_t b) const {
    if (look_.known == nullptr || look_.known->frames[a].left_out ||
        look_.known->frames[b].left_out) {
      return FromAnywhere(a, b);
    }
    const auto to_reference = look_.known->frames[a].from_reference.Inverse();
    if (!to_reference) return FromAnywhere(a, b);
    const auto near =
        Refine(a, b, look_.known->frames[b].from_reference.After(*to_reference), StartIs::kClose);
    return near ? near : FromAnywhere(a, b);
  }
  [[nodiscard]] std::optional<PairMotion> FromAnywhere(std::size_t a, std::size_t b) const {
    const auto good = [](const PairMotion& motion) {
      return motion.sd_pixels < kSureSd && motion.unlike < kMostUnlike;
    };
    std::optional<PairMotion> best;
    const auto from = [&](const Homography& start) {
      const auto found = Refine(a, b, start, StartIs::kRough);
      if (!found) return;
      const bool better = !best || (good(*found) && !good(*best)) ||
                          (good(*found) == good(*best) && found->unlike < best->unlike);
      if (better) best = found;
    };
    for (const RoughMotion& rough : SearchMotion(For(a, b)[a], For(a, b)[b], width_, height_)) {
      from(rough.to_other);
      if (best && good(*best)) return best;
    }
    from(Homography{});
    return best;
  }

  // Empty where a motion can be relied on.
  [[nodiscard]] std::string WhyUnsure(const FrameMotion& motion) const {
    if (motion.sd_pixels > (look_.rough ? kMostRoughSd : kMostSd)) {
      return "its place is known to " + RoundedText(0.3 / kMostSd * motion.sd_pixels, 2) +
             " pixels only, and 0.3 are needed";
    }
    if (motion.unlike > kMostUnlike) {
      return PercentText(motion.unlike) + " of it does not fit where the rest does";
    }
    return {};
  }

  // The middle of the way there and the way back. What either misses the middle by is what noise
  // and compression that both pictures share hide from the tiles' scatter.
  [[nodiscard]] std::optional<PairMotion> BothWays(std::size_t a, std::size_t b,
                                                   const std::optional<PairMotion>& there) const {
    if (!there) return std::nullopt;
    const auto inverse = there->to_other.Inverse();
    if (!inverse) return std::nullopt;
    const auto back = Refine(b, a, *inverse, StartIs::kClose);
    if (!back) return std::nullopt;
    const auto returned = back->to_other.Inverse();
    if (!returned) return std::nullopt;
    const double open = RmsBetween(*returned, there->to_other, width_, height_);
    PairMotion middle;
    for (std::size_t i = 0; i < middle.to_other.m.size(); ++i) {
      middle.to_other.m[i] =
          0.5 * (there->to_other.m[i] / there->to_other.m[8] + returned->m[i] / returned->m[8]);
    }
    middle.sd_pixels = std::hypot(std::max(there->sd_pixels, back->sd_pixels), 0.5 * open);
    middle.unlike = std::max(there->unlike, back->unlike);
    return middle;
  }

  [[nodiscard]] static tl::unexpected<Error> Unsure(const std::string& why) {
    return Refused("misaligned", {}, why);
  }

  std::span<const SignalFrame> frames_;
  const MotionLook& look_;
  double width_, height_;
  std::vector<MotionPyramid> all_, darkest_;
  std::vector<bool> full_;
};

}  // namespace

Result<BracketMotion> MeasureMotion(std::span<const SignalFrame> frames,
                                    std::span<const NoiseProfile> noise, double floor,
                                    const MotionLook& look) {
  BracketMotion motion;
  motion.frames.resize(frames.size());
  motion.reference = frames.size() / 2;
  const Finder finder(frames, noise, floor, look);
  const auto along = [&](std::size_t nearer, std::size_t k) -> Result<std::size_t> {
    auto found = finder.Find(motion.reference, nearer, k, motion.frames[nearer]);
    if (found) {
      motion.frames[k] = *found;
      return k;
    }
    // Without a longer frame the dark is noisier and all else is as it was; a shorter one alone
    // shows what the next one clips, if it clips anything.
    const std::string& why = found.error().message;
    if (!look.rough && k < motion.reference && finder.Seen(k) >= kLeastSeen &&
        finder.IsFullSomewhere(nearer)) {
      return Refused("misaligned", frames[k].name,
                     "it cannot be aligned for certain: " + why +
                         ". Leave this frame out, or shoot again with frames nearer in exposure, "
                         "or on a tripod");
    }
    motion.frames[k].why = why;
    motion.frames[k].left_out = true;
    return nearer;
  };
  std::size_t nearer = motion.reference;
  for (std::size_t k = motion.reference + 1; k < frames.size(); ++k) {
    const auto next = along(nearer, k);
    if (!next) return tl::unexpected(next.error());
    nearer = *next;
  }
  nearer = motion.reference;
  for (std::size_t k = motion.reference; k-- > 0;) {
    const auto next = along(nearer, k);
    if (!next) return tl::unexpected(next.error());
    nearer = *next;
  }
  const auto kept = std::ranges::count(motion.frames, false, &FrameMotion::left_out);
  if (!look.rough && kept == 1 && frames.size() > 1) {
    const FrameMotion& other = motion.frames[motion.reference == 0 ? 1 : motion.reference - 1];
    return Refused("misaligned", frames[motion.reference].name,
                   "no other frame can be aligned to it for certain: " + other.why +
                       ". Leave it out, or shoot again on a tripod");
  }
  return motion;
}

}  // namespace lightcal
