// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/bright_bodies.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <unordered_set>

#include "lightcal/imaging/panorama/local_background.h"

namespace lightcal {
namespace {

constexpr double kPeakOverBackground = 6.0;
constexpr double kFloorOverBackground = 2.0;
constexpr double kFloorOfBrightest = 1e-9;  // of the picture's maximum: black is background
constexpr double kLeastPeakOverSaddle = 1.5;
// The edge: looked for below this part of the peak, where r grows by sqrt(kAreaStep) and the
// luminance does not fall below the fraction that r^-2.5 would leave.
constexpr double kEdgeFromPeak = 0.1;
constexpr double kAreaStep = 1.5;
constexpr double kSteepest = 2.5;
const double kGentle = std::pow(kAreaStep, -kSteepest / 2.0);
constexpr double kFloorOfPeak = 1e-4;
constexpr double kEdgePixels = 2.0;      // of blur, in pitches
constexpr double kMostBlur = 0.5;        // of the body's radius
constexpr double kFollowedExcess = 8.0;  // 2 ln 50: where a Gaussian's excess is 2 % of B

using Index = std::int32_t;
constexpr Index kNone = -1;

// A watershed basin while it grows.
struct Basin {
  Index parent;  // itself, or the basin it joined
  Index peak;    // pixel
  double flux = 0.0, solid_angle = 0.0;
};

class Watershed {
 public:
  Watershed(View2d<const float> nits, const LatLongGrid& grid, const LocalBackground& background,
            double least_flux)
      : nits_(nits), grid_(grid), background_(background), least_flux_(least_flux) {}

  // Pixels of each basin, brightest first; the first is its peak.
  std::vector<std::vector<Index>> Run() {
    Gather();
    label_.assign(static_cast<std::size_t>(grid_.width()) * grid_.height(), kNone);
    for (const Index pixel : order_) Flood(pixel);
    std::vector<std::vector<Index>> members(basins_.size());
    for (const Index pixel : order_) members[At(Root(Label(pixel)))].push_back(pixel);
    std::erase_if(members, [&](const std::vector<Index>& basin) {
      return basin.empty() || Nits(basin.front()) < kPeakOverBackground * B(basin.front());
    });
    return members;
  }

 private:
  static std::size_t At(Index i) { return static_cast<std::size_t>(i); }
  Index& Label(Index pixel) { return label_[At(pixel)]; }
  [[nodiscard]] double Nits(Index i) const { return nits_.data()[i]; }
  [[nodiscard]] double B(Index i) const { return background_.At(grid_.X(i), grid_.Y(i)); }

  void Gather() {
    double brightest = 0.0;
    for (int y = 0; y < grid_.height(); ++y) {
      for (const float v : nits_.row(y)) brightest = std::max(brightest, double{v});
    }
    const double least = kFloorOfBrightest * brightest;
    for (int y = 0; y < grid_.height(); ++y) {
      for (int x = 0; x < grid_.width(); ++x) {
        const double v = nits_(x, y);
        if (v > least && v > kFloorOverBackground * background_.At(x, y)) {
          order_.push_back(grid_.Index(x, y));
        }
      }
    }
    std::sort(order_.begin(), order_.end(), [&](Index a, Index b) {
      const double va = Nits(a), vb = Nits(b);
      return va != vb ? va > vb : a < b;
    });
  }

  Index Root(Index basin) {
    while (basins_[At(basin)].parent != basin) {
      basin = basins_[At(basin)].parent = basins_[At(basins_[At(basin)].parent)].parent;
    }
    return basin;
  }

  // Whether a basin stays a body of its own where it meets a brighter one at luminance `saddle`.
  [[nodiscard]] bool Stands(const Basin& basin, double saddle) const {
    return Nits(basin.peak) >= kLeastPeakOverSaddle * saddle &&
           basin.flux - saddle * basin.solid_angle >= least_flux_;
  }

  void Flood(Index pixel) {
    const int x = grid_.X(pixel), y = grid_.Y(pixel);
    const double level = nits_(x, y), omega = grid_.SolidAngle(y);
    Index home = kNone;
    Index uphill = kNone;
    grid_.ForNeighbours(x, y, [&](Index neighbour) {
      if (Label(neighbour) == kNone) return;
      const Index root = Root(Label(neighbour));
      if (home == kNone) {
        home = root;
        uphill = neighbour;
      } else if (root != home) {
        home = Meet(home, root, uphill, neighbour, level);
      }
      if (Nits(neighbour) > Nits(uphill)) uphill = neighbour;
    });
    if (home == kNone) {
      home = static_cast<Index>(basins_.size());
      basins_.push_back({home, pixel, 0.0, 0.0});
    }
    Label(pixel) = home;
    basins_[At(home)].flux += level * omega;
    basins_[At(home)].solid_angle += omega;
  }

  // Two basins touch: one of them swallows the other, or the pixel goes uphill.
  Index Meet(Index a, Index b, Index uphill_a, Index uphill_b, double saddle) {
    const auto brighter = [&](Index i, Index j) {
      return Nits(basins_[At(i)].peak) >= Nits(basins_[At(j)].peak);
    };
    const Index high = brighter(a, b) ? a : b, low = high == a ? b : a;
    if (Stands(basins_[At(low)], saddle)) return Nits(uphill_b) > Nits(uphill_a) ? b : a;
    basins_[At(low)].parent = high;
    basins_[At(high)].flux += basins_[At(low)].flux;
    basins_[At(high)].solid_angle += basins_[At(low)].solid_angle;
    return high;
  }

  View2d<const float> nits_;
  const LatLongGrid& grid_;
  const LocalBackground& background_;
  double least_flux_;
  std::vector<Index> order_;
  std::vector<Index> label_;
  std::vector<Basin> basins_;
};

// Where a basin's body ends, and how far its blur reaches beyond.
struct Edge {
  std::size_t count = 0;  // of the basin's pixels, brightest first
  double blur_rad = 0.0;
};

class BodyShape {
 public:
  BodyShape(View2d<const float> nits, const LatLongGrid& grid, const LocalBackground& background)
      : nits_(nits), grid_(grid), background_(background) {}

  // basin: brightest first.
  [[nodiscard]] Edge FindEdge(const std::vector<Index>& basin) const {
    std::vector<double> area(basin.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < basin.size(); ++i) {
      area[i] = sum += grid_.SolidAngle(grid_.Y(basin[i]));
    }
    const double peak = Nits(basin.front());
    const double blur = kEdgePixels * grid_.pitch().value();
    std::size_t ahead = 0;
    for (std::size_t i = 0; i < basin.size(); ++i) {
      const double level = Nits(basin[i]);
      if (level >= kEdgeFromPeak * peak) continue;
      if (level < kFloorOfPeak * peak) return {i, blur};
      while (ahead < basin.size() && area[ahead] < kAreaStep * area[i]) ++ahead;
      if (ahead == basin.size()) break;
      if (Nits(basin[ahead]) > kGentle * level) return {i, blur};
    }
    return {basin.size(), std::max(blur, BlurBeyondFloor(basin, area))};
  }

 private:
  [[nodiscard]] double Nits(Index i) const { return nits_.data()[i]; }

  // A body that still falls steeply at 2 B: a Gaussian there has the logarithmic slope s of its
  // excess between 6 B and 2 B, and is 2 % of B at r sqrt(1 + 8/s).
  [[nodiscard]] double BlurBeyondFloor(const std::vector<Index>& basin,
                                       const std::vector<double>& area) const {
    const double b = background_.At(grid_.X(basin.back()), grid_.Y(basin.back()));
    const auto inside = std::partition_point(
        basin.begin(), basin.end(), [&](Index i) { return Nits(i) > kPeakOverBackground * b; });
    if (inside == basin.begin()) return 0.0;
    const double inner = area[static_cast<std::size_t>(inside - basin.begin()) - 1];
    const double radius = std::sqrt(area.back() / std::numbers::pi);
    if (!(area.back() > inner)) return 0.0;
    const double slope = std::log(5.0) / (0.5 * std::log(area.back() / inner));
    return radius * std::min(kMostBlur, std::sqrt(1.0 + kFollowedExcess / slope) - 1.0);
  }

  View2d<const float> nits_;
  const LatLongGrid& grid_;
  const LocalBackground& background_;
};

// The pixels of `members` that hang together with the first.
std::vector<Index> ConnectedToFirst(const std::vector<Index>& members, const LatLongGrid& grid) {
  std::unordered_set<Index> left(members.begin(), members.end());
  std::vector<Index> connected = {members.front()};
  left.erase(members.front());
  for (std::size_t i = 0; i < connected.size(); ++i) {
    grid.ForNeighbours(grid.X(connected[i]), grid.Y(connected[i]), [&](Index neighbour) {
      if (left.erase(neighbour) > 0) connected.push_back(neighbour);
    });
  }
  return connected;
}

// Adds rings of pixels nobody owns until they are `blur` wide.
void Grow(std::vector<Index>& pixels, double blur, const LatLongGrid& grid,
          std::vector<Index>& owner, Index self) {
  const int rings = static_cast<int>(std::ceil(blur / grid.pitch().value() - 1e-9));
  std::size_t from = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const std::size_t to = pixels.size();
    for (std::size_t i = from; i < to; ++i) {
      grid.ForNeighbours(grid.X(pixels[i]), grid.Y(pixels[i]), [&](Index neighbour) {
        Index& of = owner[static_cast<std::size_t>(neighbour)];
        if (of != kNone) return;
        of = self;
        pixels.push_back(neighbour);
      });
    }
    from = to;
  }
}

struct Candidate {
  BrightBody body;
  double blur = 0.0;
  double flux = 0.0;
};

// What is clipped and belongs to no body yet, each piece that hangs together as one.
std::vector<Candidate> ClippedPieces(View2d<const float> nits, const LatLongGrid& grid,
                                     std::span<const std::uint8_t> clipped,
                                     const std::vector<Index>& owner) {
  std::vector<std::uint8_t> left(clipped.begin(), clipped.end());
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (owner[i] != kNone) left[i] = 0;
  }
  std::vector<Candidate> pieces;
  for (std::size_t first = 0; first < left.size(); ++first) {
    if (left[first] == 0) continue;
    left[first] = 0;
    BrightBody body;
    body.clipped = true;
    body.pixels = {static_cast<Index>(first)};
    for (std::size_t i = 0; i < body.pixels.size(); ++i) {
      const Index at = body.pixels[i];
      body.peak_nits = std::max(body.peak_nits, double{nits.data()[at]});
      grid.ForNeighbours(grid.X(at), grid.Y(at), [&](Index neighbour) {
        std::uint8_t& of = left[static_cast<std::size_t>(neighbour)];
        if (of != 0) body.pixels.push_back(neighbour);
        of = 0;
      });
    }
    for (const Index i : body.pixels) {
      if (double{nits.data()[i]} == body.peak_nits) ++body.plateau;
    }
    pieces.push_back({std::move(body), kEdgePixels * grid.pitch().value(), 0.0});
  }
  return pieces;
}

}  // namespace

std::vector<BrightBody> FindBrightBodies(View2d<const float> nits, const LatLongGrid& grid,
                                         const BodySearch& search) {
  double total = 0.0;
  for (int y = 0; y < grid.height(); ++y) {
    const auto row = nits.row(y);
    total += grid.SolidAngle(y) * std::accumulate(row.begin(), row.end(), 0.0);
  }
  const double least_flux = search.least_share * std::max(0.0, total);
  const LocalBackground background(nits, grid);
  const BodyShape shape(nits, grid, background);
  const auto value = [&](Index i) { return nits.data()[i]; };

  std::vector<Candidate> candidates;
  for (std::vector<Index>& basin : Watershed(nits, grid, background, least_flux).Run()) {
    const auto is_clipped = [&](Index i) {
      return !search.clipped.empty() && search.clipped[static_cast<std::size_t>(i)] != 0;
    };
    Candidate candidate;
    candidate.body.peak_nits = value(basin.front());
    candidate.body.clipped = std::any_of(basin.begin(), basin.end(), is_clipped);
    if (candidate.body.clipped) {
      std::erase_if(basin, [&](Index i) { return !is_clipped(i); });
      candidate.blur = kEdgePixels * grid.pitch().value();
    } else {
      const Edge edge = shape.FindEdge(basin);
      basin.resize(edge.count);
      candidate.blur = edge.blur_rad;
    }
    candidate.body.pixels = ConnectedToFirst(basin, grid);
    const double edge_level = background.At(grid.X(basin.front()), grid.Y(basin.front()));
    for (const Index i : candidate.body.pixels) {
      candidate.flux += grid.SolidAngle(grid.Y(i)) * (value(i) - edge_level);
      if (double{value(i)} == candidate.body.peak_nits) ++candidate.body.plateau;
    }
    const bool stays = search.clipped_always && candidate.body.clipped;
    if (stays || candidate.flux >= least_flux) candidates.push_back(std::move(candidate));
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.flux > b.flux; });

  std::vector<Index> owner(static_cast<std::size_t>(grid.width()) * grid.height(), kNone);
  const auto claim = [&](std::size_t k) {
    for (const Index i : candidates[k].body.pixels) {
      owner[static_cast<std::size_t>(i)] = static_cast<Index>(k);
    }
  };
  for (std::size_t k = 0; k < candidates.size(); ++k) claim(k);
  if (search.clipped_always && !search.clipped.empty()) {
    for (Candidate& piece : ClippedPieces(nits, grid, search.clipped, owner)) {
      candidates.push_back(std::move(piece));
      claim(candidates.size() - 1);
    }
  }
  std::vector<BrightBody> bodies;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    BrightBody& body = candidates[k].body;
    Grow(body.pixels, candidates[k].blur, grid, owner, static_cast<Index>(k));
    std::sort(body.pixels.begin(), body.pixels.end());
    bodies.push_back(std::move(body));
  }
  return bodies;
}

}  // namespace lightcal
