// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/grey_scale.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/statistics.h"
#include "lightcal/imaging/panorama/ball_mirror.h"
#include "lightcal/imaging/scene/patches.h"

namespace lightcal {
namespace {

constexpr int kCellsAcross = 24, kCardCells = 6;
constexpr int kDomeColumns = 256;
constexpr double kInsideRim = 0.9;
constexpr double kMostHiddenOfGrey = 0.03;  // of what lights a cell from a uniform sphere
constexpr std::size_t kLeastGreyCells = 12;
constexpr double kMostGreyMisfit = 0.25;
constexpr double kIndependentParts = 6.0;
constexpr double kLeastScatter = 1e-3;
constexpr int kMeanRounds = 20;

// What blocks of a dome send through its middle, and what its holes would.
class Lighting {
 public:
  explicit Lighting(const DomeInput& input) {
    const Dome& dome = input.dome;
    const LatLongGrid grid = dome.grid();
    const int step = std::max(1, dome.width / kDomeColumns);
    const int columns = (dome.width + step - 1) / step, rows = (dome.height + step - 1) / step;
    const auto blocks = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    light_.assign(blocks, Vec3{});
    hidden_.assign(input.unseen.empty() ? 0 : blocks, Vec3{});
    for (int y = 0; y < dome.height; ++y) {
      for (int x = 0; x < dome.width; ++x) {
        const auto at = static_cast<std::size_t>(grid.Index(x, y));
        const auto block = static_cast<std::size_t>(y / step * columns + x / step);
        const Vec3 flow = grid.Flow(x, y);
        light_[block] = light_[block] + flow * double{dome.nits[at]};
        if (!hidden_.empty() && input.unseen[at] != 0) hidden_[block] = hidden_[block] + flow;
      }
    }
  }
  [[nodiscard]] double On(const Vec3& normal) const { return Sum(light_, normal); }
  [[nodiscard]] double HiddenShare(const Vec3& normal) const {
    return Sum(hidden_, normal) / std::numbers::pi;
  }

 private:
  static double Sum(const std::vector<Vec3>& flows, const Vec3& normal) {
    double sum = 0.0;
    for (const Vec3& flow : flows) sum += std::max(0.0, Dot(flow, normal));
    return sum;
  }
  std::vector<Vec3> light_, hidden_;
};

struct GreyCell {
  Vec3 normal;  // of the sphere
  double nits = 0.0;
};

// The mean of a cell's pixels; absent where one is no number.
std::optional<double> MeanInCell(View2d<const float> plate, const Region& cell) {
  const auto statistics = MeasureRegion(plate, cell);
  if (!statistics || !(statistics->mean.value() > 0.0)) return std::nullopt;
  return statistics->mean.value();
}

Region CellOf(const std::array<double, 4>& box, int column, int row, int across) {
  const auto edge = [&](std::size_t axis, int i) {
    return static_cast<int>(std::floor(box[axis] + box[axis + 2] * i / across));
  };
  const int x = edge(0, column), y = edge(1, row);
  return {x, y, std::max(1, edge(0, column + 1) - x), std::max(1, edge(1, row + 1) - y)};
}

Result<std::vector<GreyCell>> CellsOf(const GreyTarget& target, View2d<const float> plate) {
  BallView view;
  view.outline = target.box;
  view.field_of_view = target.field_of_view;
  std::vector<GreyCell> cells;
  if (!target.ball) {
    const auto& [x, y, w, h] = target.box;
    const Region whole{static_cast<int>(x), static_cast<int>(y), static_cast<int>(w),
                       static_cast<int>(h)};
    if (auto ok = CheckRegion(whole, plate.width(), plate.height()); !ok) {
      return Propagate(std::move(ok));
    }
    auto lens = PixelSolidAngles::Create({Projection::kRectilinear, plate.width(), plate.height(),
                                          target.field_of_view.value_or(RadiansFromDegrees(1.0))});
    if (!lens) return Propagate(std::move(lens));
    const AimedView camera(std::move(*lens), target.aim);
    const Vec3 normal = target.card_normal.value_or(camera.Outward({0.0, -1.0, 0.0}));
    for (int i = 0; i < kCardCells * kCardCells; ++i) {
      const auto mean =
          MeanInCell(plate, CellOf(target.box, i % kCardCells, i / kCardCells, kCardCells));
      if (mean) cells.push_back({normal, *mean});
    }
    return cells;
  }
  auto ball = BallMirror::Create(target.file, plate.width(), plate.height(), view);
  if (!ball) return Propagate(std::move(ball));
  const AimedView camera(ball->lens(), target.aim);
  for (int i = 0; i < kCellsAcross * kCellsAcross; ++i) {
    const Region cell = CellOf(target.box, i % kCellsAcross, i / kCellsAcross, kCellsAcross);
    const auto surface = ball->SurfaceAt(cell.x + cell.width / 2.0, cell.y + cell.height / 2.0);
    if (!surface || surface->rim_share > kInsideRim) continue;
    const auto mean = MeanInCell(plate, cell);
    if (mean) cells.push_back({camera.Outward(surface->normal), *mean});
  }
  return cells;
}

}  // namespace

Result<GreyScale> ScaleByGrey(const GreyTarget& target, View2d<const float> plate,
                              const DomeInput& dome) {
  const auto cells = CellsOf(target, plate);
  if (!cells) return tl::unexpected(cells.error());
  const Lighting lighting(dome);
  std::vector<double> ratio;
  double hidden = 0.0;
  bool any_lit = false;
  for (const GreyCell& cell : *cells) {
    const double lux = lighting.On(cell.normal), share = lighting.HiddenShare(cell.normal);
    any_lit = any_lit || lux > 0.0;
    if (share > kMostHiddenOfGrey || !(lux > 0.0)) continue;
    hidden = std::max(hidden, share);
    ratio.push_back(std::log(cell.nits * std::numbers::pi / target.reflectance / lux));
  }
  if (cells->empty() || !any_lit) {
    return Refused("grey_black", target.file,
                   "the grey ball or card in the plate, or all that lights it in the dome, is "
                   "black; check its box (x,y,width,height in pixels) and the plate's exposure");
  }
  if (ratio.size() < kLeastGreyCells) {
    return Refused("grey_beyond_view", target.file,
                   "what the dome does not show lights most of the grey surface; photograph both "
                   "from the same place, or add a view of the hole ({dome.aims})");
  }
  const double middle = UpperMedian(ratio);
  std::vector<double> off;
  for (const double q : ratio) off.push_back(std::abs(q - middle));
  GreyScale scale;
  scale.misfit_sd = std::max(kLeastScatter, kSdPerMad * UpperMedian(off));
  if (scale.misfit_sd > kMostGreyMisfit) {
    return Refused("grey_disagrees", target.file,
                   "the dome does not explain how the grey ball is shaded (" +
                       RoundedText(100.0 * scale.misfit_sd, 2) +
                       " % apart, 1 sigma): check the balls' boxes, that both were lit alike, and "
                       "where the plate's camera looked ({dome.plate_aim})");
  }
  double mean = middle;
  for (int round = 0; round < kMeanRounds; ++round) {
    double sum = 0.0, weights = 0.0;
    for (const double q : ratio) {
      const double t = (q - mean) / (kCauchyScale * scale.misfit_sd);
      sum += q / (1.0 + t * t);
      weights += 1.0 / (1.0 + t * t);
    }
    mean = sum / weights;
  }
  scale.factor = std::exp(mean);
  scale.sd_relative = std::hypot(scale.misfit_sd / std::sqrt(kIndependentParts),
                                 target.reflectance_sd / target.reflectance, hidden / 2.0);
  scale.cells = static_cast<int>(ratio.size());
  return scale;
}

}  // namespace lightcal
