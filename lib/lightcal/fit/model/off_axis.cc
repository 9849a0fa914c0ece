// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/off_axis.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lightcal::fit {
namespace {

// Of a spot's axis: below it the cone's edge decides all.
constexpr double kDarkShare = 0.05;

std::optional<SourceModel> ModelOf(const LightDescription& light) {
  if (light.kind == LightKind::kSphere && light.diameter) {
    return SphereSource{0.5 * light.diameter->value()};
  }
  if (light.kind == LightKind::kTube && light.length && (light.aim || light.axis)) {
    return TubeSource{0.5 * light.length->value(), light.radius.value_or(Metres(0.0)).value()};
  }
  if (!light.aim) return std::nullopt;
  if (light.kind == LightKind::kDisk && light.diameter) {
    return DiskSource{0.5 * light.diameter->value()};
  }
  if (light.kind == LightKind::kRect && light.width && light.height) {
    return RectSource{0.5 * light.width->value(), 0.5 * light.height->value()};
  }
  if (light.kind == LightKind::kSpot && light.outer) {
    return SpotSource{{light.inner.value_or(Radians(0.0)), *light.outer}};
  }
  return std::nullopt;
}

OffsetWay WayOf(LightKind kind) {
  if (kind == LightKind::kSphere) return OffsetWay::kAway;
  return kind == LightKind::kTube ? OffsetWay::kAwayFromAxis : OffsetWay::kAgainstAim;
}

}  // namespace

std::optional<PlacedSource> PlacedSourceOf(const LightDescription& light) {
  std::optional<SourceModel> model = ModelOf(light);
  if (!model || !light.position_m) return std::nullopt;
  const Vec3 along = light.axis.value_or(Vec3{});
  // A tube known by its axis alone: any direction square to it serves as z.
  const Vec3 z = light.aim ? *light.aim : SourceFrame::Facing(along).y;
  return PlacedSource{*model, *light.position_m, SourceFrame::Facing(z, along)};
}

int PlaceOnSource(const LightDescription& light, bool cone_found, Observations& observations) {
  const std::optional<PlacedSource> source = PlacedSourceOf(light);
  if (!source) return 0;
  const bool spot = light.kind == LightKind::kSpot;
  int dark = 0;
  std::vector<Observation> kept;
  for (Observation& row : observations.rows) {
    if (!row.lit || !row.position_m || !row.measured_from_center) {
      kept.push_back(std::move(row));
      continue;
    }
    const Vec3 from_lamp = *row.position_m - source->position_m;
    const double distance = Length(from_lamp);
    const Vec3 facing = from_lamp * (-1.0 / distance);
    OffAxisPose pose{source->model,
                     {source->frame.Of(from_lamp), source->frame.Of(row.normal.value_or(facing))},
                     WayOf(light.kind)};
    const double even = std::cos(row.normal ? row.tilt_rad : 0.0) / (distance * distance);
    row.emission = LuxPerCandela(pose, 0.0) / even;
    if (!(row.emission > (spot ? kDarkShare : 0.0))) {
      ++dark;
      if (cone_found) continue;
      observations.rejected.push_back(row.index);
      observations.warnings.push_back({"row_rejected",
                                       light.name + ", reading " + std::to_string(row.index),
                                       "the lamp does not shine there by its position_m, aim and "
                                       "size or cone; check them and the reading's position_m"});
      continue;
    }
    row.off_axis = pose;
    kept.push_back(std::move(row));
  }
  observations.rows = std::move(kept);
  std::sort(observations.rejected.begin(), observations.rejected.end());
  return dark;
}

}  // namespace lightcal::fit
