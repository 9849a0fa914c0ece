// SPDX-License-Identifier: Apache-2.0
// One lamp as a plane sees it, and the form its light takes over a region of that plane. Used by
// illuminance_map.cc alone.
#pragma once

#include "lightcal/light/illuminance_kernels.h"
#include "lightcal/light/illuminance_map.h"

namespace lightcal {

// Pixels [left, right) x [top, bottom).
struct PixelTile {
  int left, top, right, bottom;
  [[nodiscard]] int width() const { return right - left; }
  [[nodiscard]] int height() const { return bottom - top; }
  [[nodiscard]] std::int64_t points() const { return std::int64_t{width()} * height(); }
};

// Points first + x along + y across the plane's own axes [m]; pixels stand step_x, step_y apart.
struct Plane {
  Vec3 first, along_x, along_y, normal;
  double step_x, step_y;

  explicit Plane(const PlaneGrid& grid);
  [[nodiscard]] SurfacePoint At(double x, double y) const {
    return {first + along_x * x + along_y * y, normal};
  }
  // The pixel centres' point nearest to p, of a region.
  [[nodiscard]] SurfacePoint Nearest(const Vec3& p, const PixelTile& region) const;
};

// Direct light over a region: `mixed` where its parts call for different forms.
struct DirectForm {
  MapForm form = MapForm::kExact;
  bool mixed = false;
};

class LampOverPlane {
 public:
  // lamp: with its offset in place (Settled).
  LampOverPlane(const PlacedLamp& lamp, const Plane& plane);

  [[nodiscard]] DirectForm FormOver(const PixelTile& region, EffectChoice finite_source,
                                    double tolerance) const;
  // Adds a form that a kernel has: all but kDark and kExact.
  void Add(MapForm form, const kernels::Tile& tile, const kernels::Corners& relative_u95) const;

 private:
  struct Span;  // of a region, in metres
  [[nodiscard]] Span SpanOf(const PixelTile& region) const;
  [[nodiscard]] DirectForm BeamOver(const Span& span, const SpotCone& cone) const;
  template <class Source>
  [[nodiscard]] DirectForm FlatOver(const Span& span, const Source& source, double radius,
                                    EffectChoice finite_source, double tolerance) const;
  [[nodiscard]] double ZAt(double x, double y) const { return z_ + zx_ * x + zy_ * y; }
  template <int N>
  void AddRect(const RectSource& source, const kernels::Tile& tile,
               const kernels::Corners& relative_u95) const;

  const PlacedLamp& lamp_;
  const Plane& plane_;
  double x_, y_, height_;  // of the lamp, in the plane's axes
  double z_, zx_, zy_;     // how far before the lamp's own plane a point stands
};

// The lamp with its offset moved into its position, where that is what the offset does.
[[nodiscard]] PlacedLamp Settled(PlacedLamp lamp);

}  // namespace lightcal
