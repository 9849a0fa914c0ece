// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "lightcal/core/parallel.h"
#include "lightcal/core/units.h"
#include "lightcal/imaging/bracket/pair_motion.h"

namespace lightcal {
namespace {

constexpr int kLocalCells = 6;        // radius of the mean that is taken out
constexpr double kShiftShare = 0.13;  // of the longer side, each way
constexpr double kTurnStep_deg = 0.75;
constexpr int kTurnsEachWay = 4;      // each way
constexpr double kNearerWins = 0.15;  // of the likeness, at the end of the search: windows repeat
constexpr std::size_t kCandidates = 5;
constexpr double kLeastOverlap = 0.3;

// ln(signal) less its mean around, 0 where nothing is seen; `seen` says where.
struct Detail {
  std::vector<float> value;
  std::vector<unsigned char> seen;
};

Detail DetailOf(const MotionPicture& picture) {
  Detail detail;
  detail.value.resize(picture.ln.size());
  detail.seen.resize(picture.ln.size());
  ParallelFor(picture.height, [&](int y) {
    for (int x = 0; x < picture.width; ++x) {
      const std::size_t at = picture.At(x, y);
      if (picture.variance[at] < 0.0F) continue;
      double sum = 0.0, count = 0.0;
      for (int v = std::max(0, y - kLocalCells); v <= std::min(picture.height - 1, y + kLocalCells);
           ++v) {
        for (int u = std::max(0, x - kLocalCells);
             u <= std::min(picture.width - 1, x + kLocalCells); ++u) {
          if (picture.variance[picture.At(u, v)] < 0.0F) continue;
          sum += picture.ln[picture.At(u, v)];
          count += 1.0;
        }
      }
      // Bounded: a lamp's edge must not outvote the room.
      detail.value[at] = static_cast<float>(std::tanh(2.0 * (picture.ln[at] - sum / count)));
      detail.seen[at] = 1;
    }
  });
  return detail;
}

struct ShiftCandidate {
  double alike = -1.0, turn = 0.0;
  int dx = 0, dy = 0;
};

// The best few, none next to a better one.
std::vector<ShiftCandidate> Apart(std::vector<ShiftCandidate> all) {
  std::ranges::sort(all, std::ranges::greater{}, &ShiftCandidate::alike);
  std::vector<ShiftCandidate> kept;
  for (const ShiftCandidate& candidate : all) {
    if (kept.size() == kCandidates) break;
    const bool next_to = std::ranges::any_of(kept, [&](const ShiftCandidate& better) {
      return std::abs(better.dx - candidate.dx) <= 1 && std::abs(better.dy - candidate.dy) <= 1;
    });
    if (!next_to) kept.push_back(candidate);
  }
  return kept;
}

// The best whole shifts of one turn, best first.
std::vector<ShiftCandidate> BestShifts(const MotionPicture& size, const Detail& a, const Detail& b,
                                       const MotionPicture& other, double turn, int most) {
  const double c = std::cos(turn), s = std::sin(turn);
  const double cx = 0.5 * size.width, cy = 0.5 * size.height;
  struct Place {
    int x, y;
    float value;
  };
  std::vector<Place> places;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const std::size_t at = size.At(x, y);
      if (a.seen[at] == 0) continue;
      const double u = x + 0.5 - cx, v = y + 0.5 - cy;
      places.push_back({static_cast<int>(std::floor(c * u - s * v + cx)),
                        static_cast<int>(std::floor(s * u + c * v + cy)), a.value[at]});
    }
  }
  const auto both = std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(places.size()),
                                             std::count(b.seen.begin(), b.seen.end(), 1));
  std::vector<ShiftCandidate> all;
  for (int dy = -most; dy <= most; ++dy) {
    for (int dx = -most; dx <= most; ++dx) {
      double ab = 0.0, aa = 0.0, bb = 0.0, count = 0.0;
      for (const Place& place : places) {
        const int x = place.x + dx, y = place.y + dy;
        if (x < 0 || y < 0 || x >= other.width || y >= other.height) continue;
        const std::size_t at = other.At(x, y);
        if (b.seen[at] == 0) continue;
        ab += double{place.value} * b.value[at];
        aa += double{place.value} * place.value;
        bb += double{b.value[at]} * b.value[at];
        count += 1.0;
      }
      if (count < kLeastOverlap * static_cast<double>(both) || count < 40.0) continue;
      if (!(aa > 0.0) || !(bb > 0.0)) continue;
      const double reach = std::hypot(dx, dy) / most;
      const double alike = ab / std::sqrt(aa * bb) * (1.0 - kNearerWins * reach * reach);
      all.push_back({alike, turn, dx, dy});
    }
  }
  return Apart(std::move(all));
}

}  // namespace

std::vector<RoughMotion> SearchMotion(const MotionPyramid& frame, const MotionPyramid& other,
                                      double width, double height) {
  const MotionPicture& a = frame.levels.back();
  const MotionPicture& b = other.levels.back();
  const Detail of_a = DetailOf(a), of_b = DetailOf(b);
  const int most = static_cast<int>(std::ceil(kShiftShare * std::max(a.width, a.height)));
  std::vector<std::vector<ShiftCandidate>> found(2 * kTurnsEachWay + 1);
  ParallelFor(static_cast<int>(found.size()), [&](int i) {
    const double turn = (i - kTurnsEachWay) * kTurnStep_deg * kRadiansPerDegree;
    found[static_cast<std::size_t>(i)] = BestShifts(a, of_a, of_b, b, turn, most);
  });
  std::vector<ShiftCandidate> all;
  for (const auto& of_turn : found) all.insert(all.end(), of_turn.begin(), of_turn.end());
  std::vector<RoughMotion> rough;
  for (const ShiftCandidate& best : Apart(std::move(all))) {
    const double c = std::cos(best.turn), s = std::sin(best.turn);
    const double x = 0.5 * width, y = 0.5 * height;
    RoughMotion& motion = rough.emplace_back();
    motion.alike = best.alike;
    motion.to_other.m = {c,   -s,  x - c * x + s * y + best.dx * a.cell,
                         s,   c,   y - s * x - c * y + best.dy * a.cell,
                         0.0, 0.0, 1.0};
  }
  return rough;
}

}  // namespace lightcal
