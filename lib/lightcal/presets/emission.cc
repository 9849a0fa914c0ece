// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/emission.h"

#include <numbers>

#include "lightcal/presets/check/reader_parts.h"

namespace lightcal {
namespace {

// Its area seen along the axis, from the fields it has.
double SeenArea(const DerivedLight& light) {
  const double radius = NumberIn(light, "radius");
  if (light.Find("width") != nullptr) return NumberIn(light, "width") * NumberIn(light, "height");
  if (light.Find("length") != nullptr) return 2.0 * radius * NumberIn(light, "length");
  return std::numbers::pi * radius * radius;
}

AxialShape ShapeOf(const DerivedLight& light, LightKind kind) {
  using Outline = AxialShape::Outline;
  if (light.Find("width") != nullptr) {
    return {Outline::kRect, 0.5 * NumberIn(light, "width"), 0.5 * NumberIn(light, "height")};
  }
  if (light.Find("length") != nullptr) {
    return {Outline::kTube, 0.5 * NumberIn(light, "length"), 0.0};
  }
  return kind == LightKind::kDisk ? AxialShape{Outline::kDisk, NumberIn(light, "radius"), 0.0}
                                  : AxialShape{};
}

}  // namespace

double NumberIn(const DerivedLight& light, std::string_view field) {
  const DerivedField* found = light.Find(field);
  return found == nullptr ? 0.0 : found->values.front();
}

double LuminanceIn(const DerivedLight& light, std::string_view field) {
  return Rec709Luminance(light.Find(field)->values);
}

Emission EmittedByPathTracer(const DerivedLight& light, LightKind kind, double emitted,
                             const PathTracerNames& names) {
  Emission out;
  if (light.type == names.directional) {
    out.lux = emitted;
  } else if (light.type == names.dome) {
    out.lux = std::numbers::pi * emitted;
  } else if (light.type == names.area) {
    out.candela = emitted * SeenArea(light);
    out.shape = ShapeOf(light, kind);
  } else {
    out.candela = emitted;
  }
  return out;
}

}  // namespace lightcal
