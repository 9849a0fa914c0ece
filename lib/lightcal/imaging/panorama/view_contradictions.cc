// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/view_contradictions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/parallel.h"

namespace lightcal {
namespace {

constexpr double kApart = 0.1;     // of ln L
constexpr int kParallaxCells = 3;  // 6 degrees
// Cells of the equator, 1 % of the sphere: a person near by fills a smaller overlap.
constexpr double kJudgedArea = 100.0;
// Measured on fisheyes and 22 ordinary views of three real panoramas and of textured rooms: right
// aims, from places 15 cm apart (1 sigma an axis) among furniture from one metre on, or with four
// people within three metres in every view, have at most .33 of one and .023 of all; views swapped,
// rolled by 90 degrees or turned the wrong way .3 to .85, or .08 to .26 of all.
constexpr double kMostContradicting = 0.5, kMostOfAll = 0.05;
constexpr double kMostApartShare = 0.25, kMostUnmatched = 0.15;

// What a view shows about each cell.
struct Ranges {
  std::vector<double> low, high;
};

Ranges RangesAbout(const std::vector<double>& values) {
  Ranges ranges{values, values};
  for (int y = 0; y < kOverlapRows; ++y) {
    for (int other = std::max(0, y - kParallaxCells);
         other <= std::min(kOverlapRows - 1, y + kParallaxCells); ++other) {
      const double sine = std::sin(std::numbers::pi * (other + 0.5) / kOverlapRows);
      const int aside =
          std::min(kOverlapColumns / 2, static_cast<int>(std::ceil(kParallaxCells / sine)));
      for (int x = 0; x < kOverlapColumns; ++x) {
        const auto at = static_cast<std::size_t>(y * kOverlapColumns + x);
        for (int step = -aside; step <= aside; ++step) {
          const int column = (x + step + kOverlapColumns) % kOverlapColumns;
          const double v = values[static_cast<std::size_t>(other * kOverlapColumns + column)];
          ranges.low[at] = std::fmin(ranges.low[at], v);  // of a number and NaN: the number
          ranges.high[at] = std::fmax(ranges.high[at], v);
        }
      }
    }
  }
  return ranges;
}

bool Shows(const Ranges& ranges, std::size_t at, double value) {
  return value <= ranges.high[at] + kApart && value >= ranges.low[at] - kApart;
}

// Views without which no overlap has more of that part than `most`, worst first.
std::vector<std::size_t> OddViews(const std::vector<ViewOverlap>& overlaps, std::size_t count,
                                  double ViewOverlap::* part, double most) {
  std::vector<std::size_t> odd;
  std::vector<bool> left(count, true);
  for (;;) {
    std::vector<double> against(count, 0.0);
    for (const ViewOverlap& pair : overlaps) {
      if (!left[pair.a] || !left[pair.b] || pair.*part <= most) continue;
      against[pair.a] += pair.area * pair.*part;
      against[pair.b] += pair.area * pair.*part;
    }
    const auto worst = std::ranges::max_element(against);
    if (!(*worst > 0.0)) return odd;
    odd.push_back(static_cast<std::size_t>(worst - against.begin()));
    left[odd.back()] = false;
  }
}

// "; without view 2 (b.exr) the others agree"
std::string WordsOfOdd(const std::vector<std::size_t>& odd, const std::vector<std::string>& names) {
  if (odd.empty() || 2 * odd.size() > names.size()) return "";
  std::string text = odd.size() == 1 ? "; without view " : "; without views ";
  for (std::size_t i = 0; i < odd.size(); ++i) {
    if (i > 0) text += i + 1 < odd.size() ? ", " : " and ";
    text += std::to_string(odd[i] + 1) + " (" + names[odd[i]] + ")";
  }
  return text + " the others agree";
}

}  // namespace

std::vector<ViewOverlap> OverlapsOf(const std::vector<std::vector<double>>& values) {
  std::vector<Ranges> ranges(values.size());
  ParallelFor(static_cast<int>(values.size()), [&](int i) {
    ranges[static_cast<std::size_t>(i)] = RangesAbout(values[static_cast<std::size_t>(i)]);
  });
  std::vector<ViewOverlap> overlaps;
  for (std::size_t a = 0; a < values.size(); ++a) {
    for (std::size_t b = a + 1; b < values.size(); ++b) {
      ViewOverlap pair{a, b};
      for (std::size_t at = 0; at < values[a].size(); ++at) {
        const double of_a = values[a][at], of_b = values[b][at];
        if (!std::isfinite(of_a) || !std::isfinite(of_b)) continue;
        const double area = OverlapCellArea(static_cast<int>(at) / kOverlapColumns);
        const bool b_shows = Shows(ranges[b], at, of_a), a_shows = Shows(ranges[a], at, of_b);
        pair.area += area;
        if (std::abs(of_a - of_b) > kApart) pair.apart += area;
        if (!a_shows || !b_shows) pair.unmatched += area;
        if (!a_shows && !b_shows) pair.contradicting += area;
      }
      if (!(pair.area > 0.0)) continue;
      for (double* part : {&pair.apart, &pair.unmatched, &pair.contradicting}) *part /= pair.area;
      overlaps.push_back(pair);
    }
  }
  return overlaps;
}

double ShareApart(const std::vector<ViewOverlap>& overlaps) {
  double apart = 0.0, all = 0.0;
  for (const ViewOverlap& pair : overlaps) {
    apart += pair.area * pair.apart;
    all += pair.area;
  }
  return all > 0.0 ? apart / all : 0.0;
}

Result<std::string> JudgeOverlaps(const std::vector<ViewOverlap>& overlaps,
                                  const std::vector<std::string>& names) {
  double contradicting = 0.0, all = 0.0;
  std::vector<ViewOverlap> judged;
  for (const ViewOverlap& pair : overlaps) {
    all += pair.area;
    contradicting += pair.area * pair.contradicting;
    if (pair.area >= kJudgedArea) judged.push_back(pair);
  }
  if (judged.empty()) return std::string();
  const ViewOverlap worst = *std::ranges::max_element(judged, {}, &ViewOverlap::contradicting);
  const auto odd = [&](double ViewOverlap::* part, double most) {
    return WordsOfOdd(OddViews(judged, names.size(), part, most), names);
  };
  if (worst.contradicting > kMostContradicting || contradicting > kMostOfAll * all) {
    return Refused("views_contradict", names[worst.b],
                   "view " + std::to_string(worst.b + 1) + " and view " +
                       std::to_string(worst.a + 1) + " (" + names[worst.a] +
                       ") do not show one place where their aims say they do: " +
                       PercentText(worst.contradicting, 2) +
                       " of what they share is not in the other, "
                       "even within 6 degrees, and " +
                       PercentText(worst.apart, 2) + " differs by more than 10 %" +
                       odd(&ViewOverlap::unmatched, kMostUnmatched));
  }
  const ViewOverlap& farthest = *std::ranges::max_element(judged, {}, &ViewOverlap::apart);
  if (farthest.apart <= kMostApartShare) return std::string();
  return "view " + std::to_string(farthest.a + 1) + " and view " + std::to_string(farthest.b + 1) +
         " differ by more than 10 % in " + PercentText(farthest.apart, 2) +
         " of what they share, as if an aim were off by some degrees" +
         odd(&ViewOverlap::apart, kMostApartShare);
}

}  // namespace lightcal
