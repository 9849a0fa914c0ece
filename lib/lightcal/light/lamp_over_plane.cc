// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/lamp_over_plane.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lightcal/light/models/ladder.h"

namespace lightcal {
namespace {

constexpr double kHardEdge = 1e12;  // of 1/(s_outer - s_inner) for a cone without penumbra

// A receiver at distance d of a source that stands `toward` over its horizon, for the ladder.
Receiver<double> WorstReceiver(double d, double toward) {
  const double cosine = std::clamp(toward / d, -1.0, 1.0);
  return {{d, 0.0, 0.0}, {-cosine, std::sqrt(1.0 - cosine * cosine), 0.0}};
}

MapForm FormOf(LadderLevel level) {
  switch (level) {
    case LadderLevel::kPoint:
      return MapForm::kPoint;
    case LadderLevel::kGauss2:
      return MapForm::kGauss2;
    case LadderLevel::kGauss3:
      return MapForm::kGauss3;
    case LadderLevel::kGauss4:
      return MapForm::kGauss4;
    default:
      return MapForm::kExact;
  }
}

}  // namespace

Plane::Plane(const PlaneGrid& grid)
    : first(grid.first_m),
      normal(grid.normal),
      step_x(Length(grid.across_m)),
      step_y(Length(grid.down_m)) {
  along_x = grid.across_m * (1.0 / step_x);
  along_y = grid.down_m * (1.0 / step_y);
}

SurfacePoint Plane::Nearest(const Vec3& p, const PixelTile& region) const {
  const Vec3 from = p - first;
  return At(std::clamp(Dot(from, along_x), region.left * step_x, (region.right - 1) * step_x),
            std::clamp(Dot(from, along_y), region.top * step_y, (region.bottom - 1) * step_y));
}

PlacedLamp Settled(PlacedLamp lamp) {
  if (std::holds_alternative<DiskSource>(lamp.source) ||
      std::holds_alternative<RectSource>(lamp.source) ||
      std::holds_alternative<SpotSource>(lamp.source)) {
    lamp.pose.position_m = lamp.pose.position_m - lamp.pose.frame.z * lamp.pose.offset_m;
    lamp.pose.offset_m = 0.0;
  }
  return lamp;
}

struct LampOverPlane::Span {
  double x0, x1, y0, y1;
  double nearest, farthest;  // from the lamp
};

LampOverPlane::LampOverPlane(const PlacedLamp& lamp, const Plane& plane)
    : lamp_(lamp), plane_(plane) {
  const Vec3 to_lamp = lamp.pose.position_m - plane.first;
  const Vec3& aim = lamp.pose.frame.z;
  x_ = Dot(to_lamp, plane.along_x);
  y_ = Dot(to_lamp, plane.along_y);
  height_ = Dot(to_lamp, plane.normal);
  z_ = -Dot(to_lamp, aim);
  zx_ = Dot(plane.along_x, aim);
  zy_ = Dot(plane.along_y, aim);
}

LampOverPlane::Span LampOverPlane::SpanOf(const PixelTile& region) const {
  Span span{region.left * plane_.step_x,
            (region.right - 1) * plane_.step_x,
            region.top * plane_.step_y,
            (region.bottom - 1) * plane_.step_y,
            0.0,
            0.0};
  const auto reach = [&](double to_x, double to_y) { return std::hypot(to_x, to_y, height_); };
  const double near_x = std::clamp(x_, span.x0, span.x1) - x_;
  const double near_y = std::clamp(y_, span.y0, span.y1) - y_;
  span.nearest = reach(near_x, near_y);
  span.farthest = reach(std::max(std::abs(span.x0 - x_), std::abs(span.x1 - x_)),
                        std::max(std::abs(span.y0 - y_), std::abs(span.y1 - y_)));
  return span;
}

// The region's corners seen from the lamp lie within a cone about the direction of its middle; so
// does the region, while that cone is narrower than a half turn.
DirectForm LampOverPlane::BeamOver(const Span& span, const SpotCone& cone) const {
  if (!(height_ > 0.0)) return {MapForm::kDark};
  const Vec3 middle = plane_.At(0.5 * (span.x0 + span.x1), 0.5 * (span.y0 + span.y1)).position_m -
                      lamp_.pose.position_m;
  double half = 0.0;
  for (const double x : {span.x0, span.x1}) {
    for (const double y : {span.y0, span.y1}) {
      const Vec3 corner = plane_.At(x, y).position_m - lamp_.pose.position_m;
      half = std::max(half, AngleFromAim(middle, corner).value());
    }
  }
  const double off_axis = AngleFromAim(lamp_.pose.frame.z, middle).value();
  if (off_axis - half > cone.outer.value()) return {MapForm::kDark};
  if (off_axis + half < cone.inner.value()) return {MapForm::kPoint};
  const bool whole = off_axis + half <= cone.outer.value() && off_axis - half >= cone.inner.value();
  return {MapForm::kCone, !whole};
}

template <class Source>
DirectForm LampOverPlane::FlatOver(const Span& span, const Source& source, double radius,
                                   EffectChoice finite_source, double tolerance) const {
  if (!(height_ > -radius)) return {MapForm::kDark};
  const std::array<double, 4> z = {ZAt(span.x0, span.y0), ZAt(span.x1, span.y0),
                                   ZAt(span.x0, span.y1), ZAt(span.x1, span.y1)};
  const bool behind = std::ranges::all_of(z, [](double v) { return !(v > 0.0); });
  if (behind) return {MapForm::kDark};
  if (finite_source == EffectChoice::kAlways) return {MapForm::kExact};
  if (finite_source == EffectChoice::kNever) {
    return {height_ > 0.0 ? MapForm::kPoint : MapForm::kDark};
  }
  const MapForm near = FormOf(ChooseLevel(source, WorstReceiver(span.nearest, height_), tolerance));
  const MapForm far = FormOf(ChooseLevel(source, WorstReceiver(span.farthest, height_), tolerance));
  return {near, near != far};
}

DirectForm LampOverPlane::FormOver(const PixelTile& region, EffectChoice finite_source,
                                   double tolerance) const {
  if (IsEverywhere(lamp_.source)) return {MapForm::kEven};
  const Span span = SpanOf(region);
  if (const auto* spot = std::get_if<SpotSource>(&lamp_.source)) {
    return BeamOver(span, spot->cone);
  }
  if (const auto* disk = std::get_if<DiskSource>(&lamp_.source)) {
    return FlatOver(span, *disk, disk->radius, finite_source, tolerance);
  }
  if (const auto* rect = std::get_if<RectSource>(&lamp_.source)) {
    return FlatOver(span, *rect, std::hypot(rect->half_width, rect->half_height), finite_source,
                    tolerance);
  }
  if (std::holds_alternative<TubeSource>(lamp_.source)) return {MapForm::kExact};
  const auto* sphere = std::get_if<SphereSource>(&lamp_.source);
  const double radius = sphere && finite_source != EffectChoice::kNever ? sphere->radius : 0.0;
  if (!(height_ > -radius) || (radius == 0.0 && !(height_ > 0.0))) return {MapForm::kDark};
  if (std::holds_alternative<TableSource>(lamp_.source)) return {MapForm::kExact};
  // Above the horizon a sphere is a point; a source moved by its offset stays above it.
  return {height_ > radius ? MapForm::kPoint : MapForm::kExact};
}

template <int N>
void LampOverPlane::AddRect(const RectSource& source, const kernels::Tile& tile,
                            const kernels::Corners& relative_u95) const {
  std::array<kernels::FlatNode, static_cast<std::size_t>(N) * N> nodes;
  const SourceFrame& frame = lamp_.pose.frame;
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < N; ++j) {
      const Vec3 from_center = frame.x * (source.half_width * GaussLegendre<N>::kNode[i]) +
                               frame.y * (source.half_height * GaussLegendre<N>::kNode[j]);
      nodes[static_cast<std::size_t>(i) * N + j] = {
          x_ + Dot(from_center, plane_.along_x), y_ + Dot(from_center, plane_.along_y),
          height_ + Dot(from_center, plane_.normal),
          lamp_.strength * GaussLegendre<N>::kWeight[i] * GaussLegendre<N>::kWeight[j]};
    }
  }
  kernels::AddFlat(tile, {nodes, z_, zx_, zy_}, relative_u95);
}

void LampOverPlane::Add(MapForm form, const kernels::Tile& tile,
                        const kernels::Corners& relative_u95) const {
  const kernels::PointOver point{x_, y_, height_, lamp_.strength, lamp_.pose.offset_m};
  const auto* rect = std::get_if<RectSource>(&lamp_.source);
  const bool flat = rect != nullptr || std::holds_alternative<DiskSource>(lamp_.source);
  switch (form) {
    case MapForm::kPoint:
      if (!flat) return kernels::AddPoint(tile, point, relative_u95);
      {
        const kernels::FlatNode node{x_, y_, height_, lamp_.strength};
        return kernels::AddFlat(tile, {{&node, 1}, z_, zx_, zy_}, relative_u95);
      }
    case MapForm::kGauss2:
      return AddRect<2>(*rect, tile, relative_u95);
    case MapForm::kGauss3:
      return AddRect<3>(*rect, tile, relative_u95);
    case MapForm::kGauss4:
      return AddRect<4>(*rect, tile, relative_u95);
    case MapForm::kCone: {
      const SpotSource& spot = std::get<SpotSource>(lamp_.source);
      const double s_outer = HalfVersine(spot.cone.outer.value());
      const double width = s_outer - HalfVersine(spot.cone.inner.value());
      const bool hard = spot.falloff == SpotFalloff::kHard || !(width * kHardEdge > 1.0);
      const bool smooth = spot.falloff == SpotFalloff::kSmoothstep;
      const bool linear = spot.falloff == SpotFalloff::kLinear;
      return kernels::AddSpot(
          tile,
          {point, z_, zx_, zy_, s_outer, hard ? kHardEdge : 1.0 / width, linear ? 1.0 : 0.0,
           smooth ? 3.0 : (linear ? 0.0 : 1.0), smooth ? -2.0 : 0.0},
          relative_u95);
    }
    case MapForm::kEven:
      return kernels::AddEven(tile, LuxOf(lamp_, plane_.At(0.0, 0.0)), relative_u95);
    default:
      return;
  }
}

}  // namespace lightcal
