// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/moved_shape.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "lightcal/core/statistics.h"

namespace lightcal {
namespace {

constexpr std::size_t kLevels = 12, kLeastCellsOfLevel = 100;
constexpr float kMostBias = 0.08F;    // of a level, that a curve may be wrong by
constexpr float kLeastShape = 0.02F;  // relative
constexpr float kShapeSigmas = 5.0F;
constexpr float kLeastSpread = 0.002F;
constexpr auto kRobustSd = static_cast<float>(kSdPerMad);
constexpr int kLeastOfNine = 5, kLeastPiece = 9;
constexpr double kLeastPieceShare = 1.5e-3;

// Blocks that can be compared, darkest first, in levels of equal counts.
std::vector<std::vector<std::size_t>> BlocksByLevel(const Differences& found, const Blocks& a) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < found.relative.size(); ++i) {
    if (found.relative[i]) all.push_back(i);
  }
  std::ranges::sort(all, [&](std::size_t i, std::size_t j) {
    return a.mean[i] < a.mean[j] || (a.mean[i] == a.mean[j] && i < j);
  });
  const std::size_t levels = std::clamp<std::size_t>(all.size() / kLeastCellsOfLevel, 1, kLevels);
  std::vector<std::vector<std::size_t>> parts(levels);
  for (std::size_t k = 0; k < all.size(); ++k) parts[k * levels / all.size()].push_back(all[k]);
  return parts;
}

class ShapeFinder {
 public:
  ShapeFinder(const Differences& found, const Blocks& a)
      : width_(a.width), height_(a.height), levels_(BlocksByLevel(found, a)), out_(found) {}

  Differences Find() {
    TakeOffLevels();
    const std::vector<std::optional<float>> smooth = Smooth();
    std::vector<int> sign(smooth.size(), 0);
    for (const auto& level : levels_) Mark(level, smooth, sign);
    KeepPieces(Opened(sign));
    return std::move(out_);
  }

 private:
  [[nodiscard]] std::size_t At(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  void TakeOffLevels() {
    for (const auto& level : levels_) {
      std::vector<float> values;
      for (const std::size_t i : level) values.push_back(*out_.relative[i]);
      if (values.empty()) continue;
      const float bias = std::clamp(UpperMedian(values), -kMostBias, kMostBias);
      for (const std::size_t i : level) *out_.relative[i] -= bias;
    }
  }

  // Calls visit(i) for the blocks of the square of 3 x 3 around (x, y) that lie in the picture.
  template <class Visit>
  void Around(int x, int y, const Visit& visit) const {
    for (int v = std::max(0, y - 1); v <= std::min(height_ - 1, y + 1); ++v) {
      for (int u = std::max(0, x - 1); u <= std::min(width_ - 1, x + 1); ++u) visit(At(u, v));
    }
  }

  [[nodiscard]] std::vector<std::optional<float>> Smooth() const {
    std::vector<std::optional<float>> smooth(out_.relative.size());
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        if (!out_.relative[At(x, y)]) continue;
        std::vector<float> near;
        Around(x, y, [&](std::size_t i) {
          if (out_.relative[i]) near.push_back(*out_.relative[i]);
        });
        if (static_cast<int>(near.size()) >= kLeastOfNine) smooth[At(x, y)] = UpperMedian(near);
      }
    }
    return smooth;
  }

  // The sign of what stands out of a level's own spread.
  static void Mark(const std::vector<std::size_t>& level,
                   const std::vector<std::optional<float>>& smooth, std::vector<int>& sign) {
    std::vector<float> sizes;
    for (const std::size_t i : level) {
      if (smooth[i]) sizes.push_back(std::abs(*smooth[i]));
    }
    if (sizes.empty()) return;
    const float spread = std::max(kLeastSpread, kRobustSd * UpperMedian(sizes));
    const float least = std::max(kLeastShape, kShapeSigmas * spread);
    for (const std::size_t i : level) {
      if (smooth[i] && std::abs(*smooth[i]) > least) sign[i] = *smooth[i] > 0.0F ? 1 : -1;
    }
  }

  // Only what whole squares of 3 x 3 of one sign cover.
  [[nodiscard]] std::vector<int> Opened(const std::vector<int>& sign) const {
    std::vector<int> opened(sign.size(), 0);
    for (int y = 1; y + 1 < height_; ++y) {
      for (int x = 1; x + 1 < width_; ++x) {
        const int s = sign[At(x, y)];
        if (s == 0) continue;
        bool whole = true;
        Around(x, y, [&](std::size_t i) { whole = whole && sign[i] == s; });
        if (whole) Around(x, y, [&](std::size_t i) { opened[i] = s; });
      }
    }
    return opened;
  }

  void KeepPieces(std::vector<int> sign) {
    out_.disagrees.assign(sign.size(), false);
    out_.disagreeing = 0;
    const double least = std::max(double{kLeastPiece}, kLeastPieceShare * out_.comparable);
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        if (sign[At(x, y)] == 0) continue;
        const std::vector<std::size_t> piece = PieceAt(At(x, y), sign);
        if (static_cast<double>(piece.size()) < least) continue;
        for (const std::size_t i : piece) out_.disagrees[i] = true;
        out_.disagreeing += static_cast<int>(piece.size());
      }
    }
  }

  // The blocks that hang together with one; they are taken out of `sign`.
  [[nodiscard]] std::vector<std::size_t> PieceAt(std::size_t start, std::vector<int>& sign) const {
    const int s = sign[start];
    std::vector<std::size_t> piece = {start};
    sign[start] = 0;
    for (std::size_t k = 0; k < piece.size(); ++k) {
      const int x = static_cast<int>(piece[k] % static_cast<std::size_t>(width_));
      const int y = static_cast<int>(piece[k] / static_cast<std::size_t>(width_));
      Around(x, y, [&](std::size_t i) {
        if (sign[i] != s) return;
        sign[i] = 0;
        piece.push_back(i);
      });
    }
    return piece;
  }

  int width_, height_;
  std::vector<std::vector<std::size_t>> levels_;
  Differences out_;
};

}  // namespace

Differences WithShape(const Differences& found, const Blocks& a) {
  return ShapeFinder(found, a).Find();
}

}  // namespace lightcal
