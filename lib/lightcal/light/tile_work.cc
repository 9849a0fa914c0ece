// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/tile_work.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace lightcal {
namespace {

constexpr int kSmallest = 8;           // points along a side of a region that is not cut further
constexpr double kUnevenDoubt = 0.05;  // relative, of u95/E at a region's middle against corners

// One lamp over one tile.
class TileWork {
 public:
  using Output = TileOutput;
  TileWork(const PredictedLamp& lamp, const LampOverPlane& over, const MapSettings& settings,
           const Output& out)
      : lamp_(lamp), over_(over), settings_(settings), out_(out) {}

  void Do(const PixelTile& tile, BounceChoice choice) {
    EffectChoice bounce = choice.choice;
    double left_off = choice.left_off;
    if (bounce == EffectChoice::kGate) {
      // The plane's largest bound first: it costs no look at the walls.
      const auto points = BoundPoints(lamp_, out_.plane, tile);
      const double most = kOffShare * settings_.tolerance;
      double bound = kFieldMargin * lamp_.OverDirect(choice.most_lx, points);
      if (bound > most) bound = kFieldMargin * lamp_.BounceOverDirect(points);
      bounce = bound <= most ? EffectChoice::kNever : EffectChoice::kGate;
      left_off = bound <= most ? bound : 0.0;
    }
    out_.account.bounce_left_off = std::max(out_.account.bounce_left_off, left_off);
    const bool on = bounce != EffectChoice::kNever;
    const double spent = on ? kBetweenShare * settings_.tolerance : left_off;
    Direct(tile, settings_.tolerance - spent, left_off);
    if (bounce == EffectChoice::kAlways) BounceAtEach(tile);
    if (bounce == EffectChoice::kGate) BounceBetween(tile);
  }

 private:
  [[nodiscard]] SurfacePoint PixelAt(int i, int j) const {
    return out_.plane.At(i * out_.plane.step_x, j * out_.plane.step_y);
  }
  // Between the outermost pixels, s, t 0..1.
  [[nodiscard]] SurfacePoint Inside(const PixelTile& r, double s, double t) const {
    return out_.plane.At((r.left + s * (r.width() - 1)) * out_.plane.step_x,
                         (r.top + t * (r.height() - 1)) * out_.plane.step_y);
  }
  [[nodiscard]] std::array<SurfacePoint, 5> FivePoints(const PixelTile& r) const {
    return {Inside(r, 0.0, 0.0), Inside(r, 1.0, 0.0), Inside(r, 0.0, 1.0), Inside(r, 1.0, 1.0),
            Inside(r, 0.5, 0.5)};
  }
  static bool CanSplit(const PixelTile& r) {
    return r.width() > kSmallest || r.height() > kSmallest;
  }
  template <class Each>
  static void Split(const PixelTile& r, const Each& each) {
    const int x = r.width() > kSmallest ? r.left + r.width() / 2 : r.right;
    const int y = r.height() > kSmallest ? r.top + r.height() / 2 : r.bottom;
    each({r.left, r.top, x, y});
    if (x < r.right) each({x, r.top, r.right, y});
    if (y < r.bottom) each({r.left, y, x, r.bottom});
    if (x < r.right && y < r.bottom) each({x, y, r.right, r.bottom});
  }

  // The coordinates that kernels run over.
  class TileOf {
   public:
    TileOf(const PixelTile& r, const Output& out) {
      Fill(r.left, r.width(), out.plane.step_x, x_, s_);
      Fill(r.top, r.height(), out.plane.step_y, y_, t_);
      const std::ptrdiff_t at = std::ptrdiff_t{r.top} * out.map.width + r.left;
      const auto width = static_cast<std::size_t>(r.width());
      const auto height = static_cast<std::size_t>(r.height());
      tile_ = {{x_.data(), width},  {y_.data(), height},     {s_.data(), width},
               {t_.data(), height}, out.map.lux.data() + at, out.map.u95.data() + at,
               out.map.width};
    }
    [[nodiscard]] const kernels::Tile& get() const { return tile_; }

   private:
    static void Fill(int from, int count, double step, std::array<double, kTile>& at,
                     std::array<double, kTile>& part) {
      const double per = count > 1 ? 1.0 / (count - 1) : 0.0;
      for (int i = 0; i < count; ++i) {
        at[static_cast<std::size_t>(i)] = (from + i) * step;
        part[static_cast<std::size_t>(i)] = i * per;
      }
    }
    std::array<double, kTile> x_, y_, s_, t_;
    kernels::Tile tile_{};
  };

  // u95/E at the corners; absent where it is too uneven to lie between them.
  std::optional<kernels::Corners> RelativeDoubt(const PixelTile& r, const SourceDetail& detail,
                                                double left_off) const {
    std::array<double, 5> relative{};
    double known = 0.0, sum = 0.0;
    const auto points = FivePoints(r);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double lux = LuxOf(lamp_.lamp(), points[k], detail);
      const double u95 = lamp_.DirectU95(points[k], lux, detail, left_off);
      relative[k] = lux > 0.0 ? u95 / lux : -1.0;
      if (lux > 0.0) known += 1.0, sum += relative[k];
    }
    const bool dark = known < 4.5;
    if (dark && (lamp_.shape_unsure() || !CanSplit(r))) return std::nullopt;
    for (double& value : relative) {
      if (value < 0.0)
        value = known > 0.0 ? sum / known : std::sqrt(lamp_.lamp().doubt.variance_ln);
    }
    const double mean = 0.25 * (relative[0] + relative[1] + relative[2] + relative[3]);
    if (std::abs(mean - relative[4]) > kUnevenDoubt * relative[4]) return std::nullopt;
    return kernels::Corners{relative[0], relative[1], relative[2], relative[3]};
  }

  void Direct(const PixelTile& r, double tolerance, double left_off) {
    const DirectForm form = over_.FormOver(r, settings_.finite_source, tolerance);
    if (form.form == MapForm::kDark && !lamp_.shape_unsure()) {
      out_.account.points[static_cast<std::size_t>(form.form)] += r.points();
      return;
    }
    const SourceDetail detail = DetailOf(settings_.finite_source, tolerance);
    const bool cut = form.mixed && CanSplit(r);
    const auto relative = cut ? std::nullopt : RelativeDoubt(r, detail, left_off);
    if (!relative && CanSplit(r)) {
      return Split(r, [&](const PixelTile& part) { Direct(part, tolerance, left_off); });
    }
    out_.account.points[static_cast<std::size_t>(form.form)] += r.points();
    const kernels::Corners corners = relative.value_or(kernels::Corners{});
    if (form.form == MapForm::kExact) {
      AtEach(r, [&](const SurfacePoint& at, double s, double t) {
        const double lux = LuxOf(lamp_.lamp(), at, detail);
        const double from = corners.at00 + t * (corners.at01 - corners.at00);
        const double to = corners.at10 + t * (corners.at11 - corners.at10);
        return std::pair(lux, lux * (from + s * (to - from)));
      });
    } else {
      const TileOf tile(r, out_);
      over_.Add(form.form, tile.get(), corners);
    }
    if (relative) return;
    AtEach(r, [&](const SurfacePoint& at, double, double) {
      const double lux = LuxOf(lamp_.lamp(), at, detail);
      return std::pair(0.0, lamp_.DirectU95(at, lux, detail, left_off));
    });
  }

  // each(at, s, t) -> lux and u95 to add.
  template <class Each>
  void AtEach(const PixelTile& r, const Each& each) {
    const double per_s = r.width() > 1 ? 1.0 / (r.width() - 1) : 0.0;
    const double per_t = r.height() > 1 ? 1.0 / (r.height() - 1) : 0.0;
    for (int j = r.top; j < r.bottom; ++j) {
      const std::size_t row = static_cast<std::size_t>(j) * out_.map.width;
      for (int i = r.left; i < r.right; ++i) {
        const auto [lux, u95] = each(PixelAt(i, j), (i - r.left) * per_s, (j - r.top) * per_t);
        out_.map.lux[row + i] += static_cast<float>(lux);
        out_.map.u95[row + i] += static_cast<float>(u95);
      }
    }
  }

  void BounceAtEach(const PixelTile& r) {
    const WallLight& walls = lamp_.Walls();
    out_.account.points[static_cast<std::size_t>(MapForm::kBounce)] += r.points();
    out_.account.bounce_evaluated += r.points();
    AtEach(r, [&, u95 = lamp_.WallsU95Relative()](const SurfacePoint& at, double, double) {
      const double lux = walls.At(at);
      return std::pair(lux, lux * u95);
    });
  }

  void BounceBetween(const PixelTile& r) {
    if (r.width() < 3 || r.height() < 3) return BounceAtEach(r);
    if (BendsWithin(r)) return Split(r, [&](const PixelTile& part) { BounceBetween(part); });
    const WallLight& walls = lamp_.Walls();
    std::array<double, 9> lux{};
    for (std::size_t k = 0; k < 9; ++k) {
      lux[k] =
          walls.At(Inside(r, 0.5 * static_cast<double>(k % 3), 0.5 * static_cast<double>(k / 3)));
    }
    out_.account.bounce_evaluated += 9;
    if (!FitsBetween(r, walls, lux)) {
      if (CanSplit(r)) {
        return Split(r, [&](const PixelTile& part) { BounceBetween(part); });
      }
      return BounceAtEach(r);
    }
    out_.account.points[static_cast<std::size_t>(MapForm::kBounceBetween)] += r.points();
    const TileOf tile(r, out_);
    const double u95 = lamp_.WallsU95Relative();
    kernels::AddSmooth(tile.get(), lux.data(), {u95, u95, u95, u95});
  }

  // Whether the region is larger than the field's features: the walls' light varies over the
  // distance to a spot on them plus that spot's own size.
  [[nodiscard]] bool BendsWithin(const PixelTile& r) const {
    constexpr double kReach = 1.2;
    constexpr double kOnPlane = 1e-3;  // a spot on the plane itself does not light it
    if (!CanSplit(r)) return false;
    const Plane& plane = out_.plane;
    const double size = std::max(r.width() * plane.step_x, r.height() * plane.step_y);
    return std::ranges::any_of(lamp_.hot_spots(), [&](const HotSpot& spot) {
      if (Dot(spot.position_m - plane.first, plane.normal) < kOnPlane) return false;
      const double away = Length(spot.position_m - plane.Nearest(spot.position_m, r).position_m);
      return size > kReach * (away + spot.size_m);
    });
  }

  // Whether the biquadratic through 3 x 3 values meets the field at points off its nodes and off
  // its middle lines. Along the map's own border more of them: there it may touch a wall, whose
  // patches are steps to a point close by.
  bool FitsBetween(const PixelTile& r, const WallLight& walls, const std::array<double, 9>& v) {
    using Part = std::array<double, 2>;
    constexpr std::array<Part, 4> kChecks = {
        {{0.14, 0.31}, {0.69, 0.14}, {0.86, 0.69}, {0.31, 0.86}}};
    constexpr std::array<double, 4> kAlong = {0.14, 0.36, 0.64, 0.86};
    const auto fits = [&](const Part& part) { return Fits(r, walls, v, part[0], part[1]); };
    if (!std::ranges::all_of(kChecks, fits)) return false;
    return std::ranges::all_of(kAlong, [&](double at) {
      return (r.left > 0 || fits({0.0, at})) && (r.right < out_.map.width || fits({1.0, at})) &&
             (r.top > 0 || fits({at, 0.0})) && (r.bottom < out_.map.height || fits({at, 1.0}));
    });
  }
  bool Fits(const PixelTile& r, const WallLight& walls, const std::array<double, 9>& v, double s,
            double t) {
    constexpr double kMargin = 0.4;  // of the share: elsewhere it may err more
    const SurfacePoint at = Inside(r, s, t);
    const double truth = walls.At(at);
    ++out_.account.bounce_evaluated;
    const double total = truth + LuxOf(lamp_.lamp(), at, {false, 0.1});
    const double share = kMargin * kBetweenShare * settings_.tolerance;
    return std::abs(Biquadratic(v, s, t) - truth) <= share * total;
  }
  static double Biquadratic(const std::array<double, 9>& v, double s, double t) {
    const auto along = [](double a, double b, double c, double x) {
      return (1.0 - x) * (1.0 - 2.0 * x) * a + 4.0 * x * (1.0 - x) * b + x * (2.0 * x - 1.0) * c;
    };
    return along(along(v[0], v[1], v[2], s), along(v[3], v[4], v[5], s), along(v[6], v[7], v[8], s),
                 t);
  }

  const PredictedLamp& lamp_;
  const LampOverPlane& over_;
  const MapSettings& settings_;
  const Output& out_;
};

}  // namespace

std::vector<SurfacePoint> BoundPoints(const PredictedLamp& lamp, const Plane& plane,
                                      const PixelTile& region) {
  std::vector<SurfacePoint> points;
  for (const double s : {0.0, 0.5, 1.0}) {
    for (const double t : {0.0, 0.5, 1.0}) {
      points.push_back(plane.At((region.left + s * (region.width() - 1)) * plane.step_x,
                                (region.top + t * (region.height() - 1)) * plane.step_y));
    }
  }
  for (const HotSpot& spot : lamp.hot_spots()) {
    points.push_back(plane.Nearest(spot.position_m, region));
  }
  return points;
}

void WorkTile(const PredictedLamp& lamp, const LampOverPlane& over, const MapSettings& settings,
              const PixelTile& tile, BounceChoice bounce, const TileOutput& out) {
  TileWork(lamp, over, settings, out).Do(tile, bounce);
}

}  // namespace lightcal
