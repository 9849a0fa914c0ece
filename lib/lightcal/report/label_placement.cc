// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/label_placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lightcal::report {
namespace {

constexpr double kAscent = 11.0;  // of the box over the baseline
constexpr double kDescent = 4.0;  // and below
constexpr double kBeside = 9.0;   // from the point to a label that needs no line
constexpr double kStep = 13.0;    // between rings of places around a point
constexpr int kRings = 30;
constexpr int kDirections = 16;
// Px of distance that avoiding a line under a label is worth, and a leader under or over another.
constexpr double kCrossing = 20.0, kLeaderCrossing = 60.0;
// Between boxes. Small type on a narrow page is hinted to whole pixels, which makes it wider.
constexpr double kGap = 2.0, kGapAlong = 5.0;

LabelBox WithGap(const LabelBox& box) {
  return {box.left - kGapAlong, box.top - kGap, box.right + kGapAlong, box.bottom + kGap};
}

bool Inside(const LabelBox& box, const LabelBox& area) {
  return box.left >= area.left && box.right <= area.right && box.top >= area.top &&
         box.bottom <= area.bottom;
}

PagePoint NearestIn(const LabelBox& box, const PagePoint& point) {
  return {std::clamp(point.first, box.left, box.right),
          std::clamp(point.second, box.top, box.bottom)};
}

// Liang and Barsky: whether some part of the segment lies inside the box.
bool Crosses(const PagePoint& from, const PagePoint& to, const LabelBox& box) {
  double enter = 0.0, leave = 1.0;
  const auto clip = [&](double start, double end, double low, double high) {
    const double along = end - start;
    if (along == 0.0) return start > low && start < high;
    const double a = (low - start) / along, b = (high - start) / along;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
    return enter < leave;
  };
  return clip(from.first, to.first, box.left, box.right) &&
         clip(from.second, to.second, box.top, box.bottom);
}

// The box whose edge or corner faces the point, `distance` away in direction `angle`.
LabelBox BoxAt(const PagePoint& point, double width, double distance, double angle) {
  const double x = point.first + distance * std::cos(angle);
  const double y = point.second - distance * std::sin(angle);
  const double c = std::cos(angle), s = std::sin(angle);
  const double left = x - width * (1.0 - std::clamp(1.5 * c, -1.0, 1.0)) / 2.0;
  const double top = y - (kAscent + kDescent) * (1.0 + std::clamp(1.5 * s, -1.0, 1.0)) / 2.0;
  return {left, top, left + width, top + kAscent + kDescent};
}

class Placing {
 public:
  explicit Placing(const LabelGround& ground) : ground_(ground) {}

  std::optional<PlacedLabel> Place(const LabelWish& wish, std::size_t index) {
    const double width = NoteWidth(wish.text);
    std::optional<PlacedLabel> best;
    double least = 0.0;
    for (int ring = 0; ring < (wish.must ? kRings : 1); ++ring) {
      if (best && ring * kStep > least) break;  // no place farther out costs less
      for (int k = 0; k < kDirections; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / kDirections;
        const LabelBox box = BoxAt(wish.point, width, kBeside + ring * kStep, angle);
        PlacedLabel label{index, box, {box.left, box.top + kAscent}, std::nullopt};
        if (ring > 0) label.leader = NearestIn(box, wish.point);
        if (!IsFree(box)) continue;
        const double disturbance = Disturbance(wish.point, label);
        if (!wish.must && disturbance > 0.0) continue;
        const double cost = ring * kStep + disturbance;
        if (best && cost >= least) continue;
        best = label;
        least = cost;
      }
    }
    if (best) Take(wish, *best);
    return best;
  }

 private:
  [[nodiscard]] bool IsFree(const LabelBox& box) const {
    const LabelBox wide = WithGap(box);
    const auto on_it = [&](const LabelBox& other) { return Overlap(wide, other); };
    return Inside(box, ground_.area) && std::ranges::none_of(ground_.taken, on_it) &&
           std::ranges::none_of(boxes_, on_it);
  }

  [[nodiscard]] std::ptrdiff_t OnLeaders(const LabelBox& box) const {
    return std::ranges::count_if(leaders_, [&](const auto& leader) {
      return Crosses(leader.first, leader.second, WithGap(box));
    });
  }

  // What a free place still spoils, in px of distance.
  [[nodiscard]] double Disturbance(const PagePoint& point, const PlacedLabel& label) const {
    std::ptrdiff_t lines = 0, leaders = OnLeaders(label.box);
    const LabelBox wide = WithGap(label.box);
    for (const auto& line : ground_.lines) {
      for (std::size_t i = 1; i < line.size(); ++i) lines += Crosses(line[i - 1], line[i], wide);
    }
    if (label.leader) {
      lines += MarksUnder(point, *label.leader);
      leaders += std::ranges::count_if(
          boxes_, [&](const LabelBox& box) { return Crosses(point, *label.leader, box); });
    }
    return kCrossing * static_cast<double>(lines) + kLeaderCrossing * static_cast<double>(leaders);
  }

  // Marks and text that a leader runs over, its own point's aside.
  [[nodiscard]] std::ptrdiff_t MarksUnder(const PagePoint& point, const PagePoint& end) const {
    return std::ranges::count_if(ground_.taken, [&](const LabelBox& mark) {
      return NearestIn(mark, point) != point && Crosses(point, end, mark);
    });
  }

  void Take(const LabelWish& wish, const PlacedLabel& label) {
    boxes_.push_back(label.box);
    if (label.leader) leaders_.emplace_back(wish.point, *label.leader);
  }

  const LabelGround& ground_;
  std::vector<LabelBox> boxes_;
  std::vector<std::pair<PagePoint, PagePoint>> leaders_;
};

}  // namespace

bool Overlap(const LabelBox& a, const LabelBox& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

double NoteWidth(std::string_view text) {
  constexpr double kNarrow = 5.5, kUsual = 8.3, kWide = 12.8;
  double width = 0.0;
  for (const char c : text) {
    if ((static_cast<unsigned char>(c) & 0xC0U) == 0x80U) continue;  // the rest of a character
    const bool narrow = std::string_view(" .,:;'|!()[]/fijlrt").find(c) != std::string_view::npos;
    const bool wide = std::string_view("mwMW%@").find(c) != std::string_view::npos;
    width += narrow ? kNarrow : (wide ? kWide : kUsual);
  }
  return width;
}

std::vector<PlacedLabel> PlaceLabels(std::span<const LabelWish> wishes, const LabelGround& ground) {
  Placing placing(ground);
  std::vector<PlacedLabel> placed;
  for (const bool must : {true, false}) {
    for (std::size_t i = 0; i < wishes.size(); ++i) {
      if (wishes[i].must != must) continue;
      if (auto label = placing.Place(wishes[i], i)) placed.push_back(std::move(*label));
    }
  }
  return placed;
}

}  // namespace lightcal::report
