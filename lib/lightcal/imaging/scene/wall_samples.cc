// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/scene/wall_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace lightcal {
namespace {

constexpr double kSaturated = 0.9;    // sigma over value
constexpr double kBoardMargin = 1.5;  // squares of paper around the chessboard
constexpr int kFewestBlocks = 100;
constexpr double kSmallestCosine = 0.17364817766693033;  // of 80 degrees

struct Picture {
  View2d<const float> nits, sigma;
};

bool Overlap(const Region& a, const Region& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

bool OnBoard(const std::array<double, 2>& wall, const CharucoBoard& board) {
  const double square = board.square.value(), margin = kBoardMargin * square;
  return wall[0] > -margin && wall[0] < board.columns * square + margin && wall[1] > -margin &&
         wall[1] < board.rows * square + margin;
}

// Whether some corner or the middle of these pixels lies on the board, or sees no wall.
bool BoardOrNothing(const Region& pixels, bool board_hangs, const WallCamera& camera,
                    const CharucoBoard& board) {
  const double left = pixels.x, top = pixels.y, w = pixels.width, h = pixels.height;
  const std::array<std::array<double, 2>, 5> places = {{{left, top},
                                                        {left + w, top},
                                                        {left, top + h},
                                                        {left + w, top + h},
                                                        {left + w / 2, top + h / 2}}};
  return std::ranges::any_of(places, [&](const std::array<double, 2>& pixel) {
    const auto wall = camera.WallPointOf(pixel);
    return !wall || (board_hangs && OnBoard(*wall, board));
  });
}

// Absent where a pixel is saturated.
std::optional<WallBlock> ReadBlock(const Picture& picture, const Region& pixels) {
  WallBlock block;
  double sum = 0.0, sum2 = 0.0, noise2 = 0.0;
  for (int y = pixels.y; y < pixels.y + pixels.height; ++y) {
    for (int x = pixels.x; x < pixels.x + pixels.width; ++x) {
      const double value = double{picture.nits(x, y)};
      if (!picture.sigma.empty()) {
        const double sigma = double{picture.sigma(x, y)};
        if (sigma > kSaturated * value && value > 0.0) return std::nullopt;
        noise2 += sigma * sigma;
      }
      sum += value;
      sum2 += value * value;
    }
  }
  const double count = static_cast<double>(pixels.width) * pixels.height;
  block.pixel = {pixels.x + 0.5 * pixels.width, pixels.y + 0.5 * pixels.height};
  block.nits = sum / count;
  const double scatter2 = std::max(0.0, sum2 / count - block.nits * block.nits);
  block.sigma_nits = std::sqrt(std::max(scatter2, noise2 / count) / count);
  return block;
}

struct SeenPoint {
  double x = 0.0, z = 0.0;  // of the wall, m
  Vec3 direction{};         // from the lamp
  double r = 0.0, cos_light = 0.0;
  double lux_per_nit = 0.0;
};

// Which point of the wall a pixel shows, and how.
class WallSight {
 public:
  explicit WallSight(const WallModel& model)
      : model_(model), camera_(model.camera), camera_m_(camera_.position_m() * model.board_scale) {}

  // Absent where the light grazes the wall, or the sight does.
  [[nodiscard]] std::optional<SeenPoint> PlaceOf(const std::array<double, 2>& pixel) const {
    const auto wall = camera_.WallPointOf(pixel);
    if (!wall) return std::nullopt;
    const Vec3 point = Vec3{(*wall)[0], 0.0, (*wall)[1]} * model_.board_scale;
    const Vec3 ray = point - model_.lamp_m, sight = point - camera_m_;
    const double r = Length(ray);
    const double cos_light = ray[1] / r, cos_view = sight[1] / Length(sight);
    if (!(cos_light > kSmallestCosine) || !(cos_view > kSmallestCosine)) return std::nullopt;
    const double seen = std::pow(camera_.CosineOffAxis(pixel), model_.vignetting) *
                        (1.0 - model_.gloss_view * (1.0 - cos_view));
    return SeenPoint{point[0], point[2],  ray * (1.0 / r),
                     r,        cos_light, std::numbers::pi / (model_.reflectance * seen)};
  }

 private:
  const WallModel& model_;
  WallCamera camera_;
  Vec3 camera_m_{};
};

}  // namespace

Result<WallBlocks> BlocksOfWall(View2d<const float> nits, View2d<const float> sigma,
                                const WallSelection& selection, const WallCamera& camera,
                                const CharucoBoard& board, int wanted) {
  const Region all = selection.wall.value_or(Region{0, 0, nits.width(), nits.height()});
  for (const Region& region : selection.masks) {
    if (auto inside = CheckRegion(region, nits.width(), nits.height()); !inside) {
      return Propagate(std::move(inside));
    }
  }
  if (auto inside = CheckRegion(all, nits.width(), nits.height()); !inside) {
    return Propagate(std::move(inside));
  }
  WallBlocks out;
  const double area = static_cast<double>(all.width) * all.height;
  out.side_px = std::max(1, static_cast<int>(std::lround(std::sqrt(area / wanted))));
  const Picture picture{nits, sigma};
  for (int y = all.y; y + out.side_px <= all.y + all.height; y += out.side_px) {
    for (int x = all.x; x + out.side_px <= all.x + all.width; x += out.side_px) {
      const Region pixels{x, y, out.side_px, out.side_px};
      const bool masked = std::ranges::any_of(
          selection.masks, [&](const Region& mask) { return Overlap(mask, pixels); });
      if (masked || BoardOrNothing(pixels, selection.board_hangs, camera, board)) continue;
      const auto block = ReadBlock(picture, pixels);
      if (block) {
        out.blocks.push_back(*block);
      } else {
        ++out.saturated;
      }
    }
  }
  if (out.blocks.size() < kFewestBlocks) {
    return Refused("wall_unreadable", "wall",
                   "after the board, masks and saturated pixels hardly any wall is left (" +
                       std::to_string(out.saturated) +
                       " blocks are saturated); show more of it, or expose shorter");
  }
  return out;
}

std::vector<IntensitySample> IntensitiesOf(const WallBlocks& blocks, const WallModel& model) {
  const WallSight sight(model);
  std::vector<IntensitySample> out;
  out.reserve(blocks.blocks.size());
  for (const WallBlock& block : blocks.blocks) {
    IntensitySample& sample = out.emplace_back();
    const auto place = sight.PlaceOf(block.pixel);
    if (!place) continue;
    const double matt = 1.0 - model.gloss_light * (1.0 - place->cos_light);
    const double candela_per_lux = place->r * place->r / (place->cos_light * matt);
    const double lux = place->lux_per_nit * block.nits - model.other.At(place->x, place->z);
    sample.direction = place->direction;
    sample.intensity_cd = candela_per_lux * lux;
    sample.sigma_cd = candela_per_lux * place->lux_per_nit * block.sigma_nits;
  }
  return out;
}

std::vector<SeenPlace> PlacesSeen(const WallBlocks& blocks, const WallModel& model) {
  const WallSight sight(model);
  std::vector<SeenPlace> out;
  for (const WallBlock& block : blocks.blocks) {
    const auto place = sight.PlaceOf(block.pixel);
    if (!place) continue;
    out.push_back({place->x, place->z, place->lux_per_nit * block.nits,
                   place->lux_per_nit * block.sigma_nits});
  }
  return out;
}

}  // namespace lightcal
