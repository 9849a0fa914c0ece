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
constexpr double kMostSd = 0.15;      // pixels: .3 at two standard deviations
constexpr double kMostOpen = 0.4;     // pixels by which there and back, .3 each, may miss
constexpr double kOpenSds = 4.0;      // and at least so many standard deviations
constexpr double kDarkestFrom = 1.1;  // times as much as all channels show
constexpr double kLeastSeen = 0.05;
constexpr double kMostApart = 0.6;   // and by which two ways to a frame may
constexpr double kMostUnlike = 0.6;  // of the evidence

class Finder {
 public:
  Finder(std::span<const SignalFrame> frames, std::span<const NoiseProfile> noise, double floor)
      : frames_(frames), width_(frames[0].width), height_(frames[0].height) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      for (const MotionChannels channels : {MotionChannels::kAll, MotionChannels::kDarkest}) {
        auto& pyramids = channels == MotionChannels::kAll ? all_ : darkest_;
        pyramids.push_back(MotionPyramidOf(frames[i], noise[i], floor, kLongest, channels));
      }
    }
  }

  // `nearer`, whose motion is known, lies between the reference and `k`.
  Result<FrameMotion> Find(std::size_t reference, std::size_t nearer, std::size_t k,
                           const FrameMotion& known) const {
    const auto step = FromAnywhere(nearer, k);
    if (!step) {
      return Unsure(k, "nothing in it can be followed to " + frames_[nearer].name);
    }
    const FrameMotion chained{step->to_other.After(known.from_reference),
                              std::hypot(step->sd_pixels, known.sd_pixels), step->unlike};
    if (nearer != reference) {
      const auto direct = Refine(reference, k, chained.from_reference);
      if (direct && direct->sd_pixels < chained.sd_pixels) {
        const FrameMotion motion{direct->to_other, direct->sd_pixels, direct->unlike};
        const double apart =
            RmsBetween(motion.from_reference, chained.from_reference, width_, height_);
        const double sds = kOpenSds * std::hypot(motion.sd_pixels, chained.sd_pixels);
        if (apart < std::max(kMostApart, sds) && WhyUnsure(reference, k, *direct, motion).empty()) {
          return motion;
        }
      }
    }
    if (const std::string why = WhyUnsure(nearer, k, *step, chained); !why.empty()) {
      return Unsure(k, why);
    }
    return chained;
  }

  // Share of a frame that is neither clipped nor dark.
  [[nodiscard]] double Seen(std::size_t k) const {
    return std::max(all_[k].seen, darkest_[k].seen);
  }

 private:
  // Those of which both frames show more.
  [[nodiscard]] const std::vector<MotionPyramid>& For(std::size_t a, std::size_t b) const {
    const double all = std::min(all_[a].seen, all_[b].seen);
    const double darkest = std::min(darkest_[a].seen, darkest_[b].seen);
    return darkest > kDarkestFrom * all ? darkest_ : all_;
  }
  [[nodiscard]] std::optional<PairMotion> Refine(std::size_t a, std::size_t b,
                                                 const Homography& start) const {
    const auto& pyramids = For(a, b);
    return RefineMotion(pyramids[a], pyramids[b], width_, height_, start);
  }
  [[nodiscard]] static double Open(double sd) { return std::max(kMostOpen, kOpenSds * sd); }

  [[nodiscard]] std::optional<PairMotion> FromAnywhere(std::size_t a, std::size_t b) const {
    std::optional<PairMotion> best;
    const auto rough = SearchMotion(For(a, b)[a], For(a, b)[b], width_, height_);
    if (rough) best = Refine(a, b, rough->to_other);
    if (best && best->sd_pixels < kMostSd && best->unlike < kMostUnlike) return best;
    const auto still = Refine(a, b, Homography{});
    if (still && (!best || still->unlike < best->unlike)) best = still;
    return best;
  }

  // Empty where a motion, found as `pair` against `against`, can be relied on.
  [[nodiscard]] std::string WhyUnsure(std::size_t against, std::size_t k, const PairMotion& pair,
                                      const FrameMotion& motion) const {
    if (motion.sd_pixels > kMostSd) {
      return "its place is known to " + RoundedText(2.0 * motion.sd_pixels, 2) +
             " pixels only, and 0.3 are needed";
    }
    if (motion.unlike > kMostUnlike) {
      return PercentText(motion.unlike) + " of it does not fit where the rest does";
    }
    const double open = OpenBy(against, k, pair);
    if (open <= Open(pair.sd_pixels)) return {};
    return "there and back from " + frames_[against].name + " misses by " + RoundedText(open, 2) +
           " pixels";
  }

  // How far there and back misses.
  [[nodiscard]] double OpenBy(std::size_t a, std::size_t b, const PairMotion& pair) const {
    const auto inverse = pair.to_other.Inverse();
    if (!inverse) return HUGE_VAL;
    const auto back = Refine(b, a, *inverse);
    if (!back) return HUGE_VAL;
    return RmsBetween(back->to_other.After(pair.to_other), Homography{}, width_, height_);
  }

  [[nodiscard]] tl::unexpected<Error> Unsure(std::size_t k, const std::string& why) const {
    return Refused("misaligned", frames_[k].name,
                   "it cannot be aligned for certain: " + why +
                       ". Leave this frame out, or shoot again with frames nearer in exposure, or "
                       "on a tripod");
  }

  std::span<const SignalFrame> frames_;
  double width_, height_;
  std::vector<MotionPyramid> all_, darkest_;
};

}  // namespace

Result<BracketMotion> MeasureMotion(std::span<const SignalFrame> frames,
                                    std::span<const NoiseProfile> noise, double floor) {
  BracketMotion motion;
  motion.frames.resize(frames.size());
  motion.reference = frames.size() / 2;
  const Finder finder(frames, noise, floor);
  const auto along = [&](std::size_t nearer, std::size_t k) -> Result<std::size_t> {
    auto found = finder.Find(motion.reference, nearer, k, motion.frames[nearer]);
    if (found) {
      motion.frames[k] = *found;
      return k;
    }
    if (finder.Seen(k) >= kLeastSeen) return tl::unexpected(found.error());
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
  return motion;
}

}  // namespace lightcal
