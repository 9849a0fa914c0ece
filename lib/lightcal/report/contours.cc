// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/contours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace lightcal::report {
namespace {

// An edge between two neighbouring samples; every piece of contour runs from edge to edge.
using Edge = std::int64_t;

class Tracer {
 public:
  Tracer(View2d<const float> field, double level) : field_(field), level_(level) {}

  std::vector<Contour> Trace() {
    for (int y = 0; y + 1 < field_.height(); ++y) {
      for (int x = 0; x + 1 < field_.width(); ++x) Cell(x, y);
    }
    return Joined();
  }

 private:
  [[nodiscard]] bool Above(int x, int y) const { return double{field_(x, y)} > level_; }
  [[nodiscard]] Edge Across(int x, int y) const {  // from (x, y) to (x + 1, y)
    return 2 * (Edge{y} * field_.width() + x);
  }
  [[nodiscard]] Edge Down(int x, int y) const { return Across(x, y) + 1; }

  void Cell(int x, int y) {
    const std::array<bool, 4> above = {Above(x, y), Above(x + 1, y), Above(x + 1, y + 1),
                                       Above(x, y + 1)};
    const std::array<Edge, 4> edge = {Across(x, y), Down(x + 1, y), Across(x, y + 1), Down(x, y)};
    std::array<Edge, 4> crossed{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (above[k] != above[(k + 1) % 4]) crossed[count++] = edge[k];
    }
    if (count == 2) Piece(crossed[0], crossed[1]);
    if (count != 4) return;
    const double mean = 0.25 * (double{field_(x, y)} + double{field_(x + 1, y)} +
                                double{field_(x + 1, y + 1)} + double{field_(x, y + 1)});
    // The middle belongs to the first corner's side: the lines cut off the second and the fourth.
    if ((mean > level_) == above[0]) {
      Piece(crossed[0], crossed[1]);
      Piece(crossed[2], crossed[3]);
    } else {
      Piece(crossed[3], crossed[0]);
      Piece(crossed[1], crossed[2]);
    }
  }

  void Piece(Edge a, Edge b) {
    const auto index = static_cast<int>(pieces_.size());
    pieces_.emplace_back(a, b);
    for (const Edge end : {a, b}) {
      auto& both = at_[end];
      (both.first < 0 ? both.first : both.second) = index;
    }
  }

  [[nodiscard]] PagePoint Crossing(Edge edge) const {
    const int x = static_cast<int>(edge / 2 % field_.width());
    const int y = static_cast<int>(edge / 2 / field_.width());
    const bool down = edge % 2 != 0;
    const double from = field_(x, y);
    const double to = down ? field_(x, y + 1) : field_(x + 1, y);
    const double part = (level_ - from) / (to - from);
    return {x + (down ? 0.0 : part), y + (down ? part : 0.0)};
  }

  // From `edge` along pieces not yet used.
  void Follow(Edge edge, Contour& line) {
    for (;;) {
      const auto [first, second] = at_.at(edge);
      const int next = first >= 0 && !used_[static_cast<std::size_t>(first)]     ? first
                       : second >= 0 && !used_[static_cast<std::size_t>(second)] ? second
                                                                                 : -1;
      if (next < 0) return;
      used_[static_cast<std::size_t>(next)] = true;
      const auto& [a, b] = pieces_[static_cast<std::size_t>(next)];
      edge = a == edge ? b : a;
      line.push_back(Crossing(edge));
    }
  }

  std::vector<Contour> Joined() {
    used_.assign(pieces_.size(), false);
    std::vector<Contour> lines;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (used_[i]) continue;
      Contour back;
      used_[i] = true;
      Contour line = {Crossing(pieces_[i].first), Crossing(pieces_[i].second)};
      Follow(pieces_[i].second, line);
      Follow(pieces_[i].first, back);
      std::reverse(back.begin(), back.end());
      back.insert(back.end(), line.begin(), line.end());
      lines.push_back(std::move(back));
    }
    std::stable_sort(lines.begin(), lines.end(),
                     [](const Contour& a, const Contour& b) { return a.size() > b.size(); });
    return lines;
  }

  View2d<const float> field_;
  double level_;
  std::vector<std::pair<Edge, Edge>> pieces_;
  struct Both {
    int first = -1, second = -1;
  };
  std::unordered_map<Edge, Both> at_;
  std::vector<bool> used_;
};

}  // namespace

std::vector<Contour> ContoursOf(View2d<const float> field, double level) {
  return Tracer(field, level).Trace();
}

ReducedField Reduce(View2d<const float> field, int most) {
  ReducedField out;
  out.block = std::max(1, (std::max(field.width(), field.height()) + most - 1) / most);
  out.width = std::max(1, field.width() / out.block);
  out.height = std::max(1, field.height() / out.block);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      double sum = 0.0;
      int count = 0;
      for (int j = y * out.block; j < std::min((y + 1) * out.block, field.height()); ++j) {
        for (int i = x * out.block; i < std::min((x + 1) * out.block, field.width()); ++i) {
          sum += double{field(i, j)};
          ++count;
        }
      }
      out.samples.push_back(static_cast<float>(sum / count));
    }
  }
  return out;
}

}  // namespace lightcal::report
