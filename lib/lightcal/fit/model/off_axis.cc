// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/off_axis.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units.h"
#include "lightcal/fit/model/reading_geometry.h"
#include "lightcal/light/models/body_of.h"

namespace lightcal::fit {
namespace {

// Of a spot's axis: below it the cone's edge decides all.
constexpr double kDarkShare = 0.05;
// Of what was read, for an angle off by its 1 sigma: a reading that alone tells nothing.
constexpr double kAngleDecides = 0.3;

std::optional<SourceModel> BodyOf(const LightDescription& light) {
  return lightcal::BodyOf(light.kind,
                          {light.diameter, light.width, light.height, light.length, light.radius});
}

// What shines to one side, about an axis.
std::optional<SourceModel> AimedSourceOf(const LightDescription& light) {
  if (light.kind == LightKind::kDisk || light.kind == LightKind::kRect) return BodyOf(light);
  if (light.kind == LightKind::kSpot && light.outer) {
    return SpotSource{{light.inner.value_or(Radians(0.0)), *light.outer}};
  }
  return std::nullopt;
}

std::optional<SourceModel> ModelOf(const LightDescription& light) {
  const bool tube = light.kind == LightKind::kTube && (light.aim || light.axis);
  if (light.kind == LightKind::kSphere || tube) return BodyOf(light);
  return light.aim ? AimedSourceOf(light) : std::nullopt;
}

OffsetWay WayOf(LightKind kind) {
  if (kind == LightKind::kSphere) return OffsetWay::kAway;
  return kind == LightKind::kTube ? OffsetWay::kAwayFromAxis : OffsetWay::kAgainstAim;
}

bool ByAngle(const Observation& row) { return row.lit && row.off_axis_rad != 0.0; }

// Facing the lamp from where the two angles say, in its frame.
OffAxisPose PoseAt(const SourceModel& source, double distance_m, double off_axis_rad,
                   double round_rad) {
  const double s = std::sin(off_axis_rad);
  const Vec3 way = {s * std::cos(round_rad), s * std::sin(round_rad), std::cos(off_axis_rad)};
  return {source, {way * distance_m, way * -1.0}, OffsetWay::kAgainstAim};
}

OffAxisPose PoseOf(const PlacedSource& source, OffsetWay way, const Observation& row) {
  const Vec3 from_lamp = *row.position_m - source.position_m;
  const Vec3 facing = from_lamp * (-1.0 / Length(from_lamp));
  return {source.model,
          {source.frame.Of(from_lamp), source.frame.Of(row.normal.value_or(facing))},
          way};
}

// E/I in such a pose over that of a small source that shines alike all round.
double EmissionIn(const OffAxisPose& pose, const Observation& row) {
  const double even = std::cos(row.normal ? row.tilt_rad : 0.0) / (row.distance_m * row.distance_m);
  return LuxPerCandela(pose, 0.0) / even;
}

bool IsPosed(const Observation& row) {
  return row.lit && row.position_m && row.measured_from_center;
}

// Every reading stands where the lamp falls so steeply that the angle decides what was read.
void RejectAtEdge(const LightDescription& light, Observations& observations) {
  for (const Observation& row : observations.rows) {
    if (!row.lit) continue;
    observations.rejected.push_back(row.index);
    observations.warnings.push_back(
        {"row_rejected", light.name + ", reading " + std::to_string(row.index),
         "at " + RoundedText(DegreesFromRadians(Radians(std::abs(row.off_axis_rad))), 3) +
             " degrees off the axis the lamp as stated falls so steeply that its intensity hangs "
             "on the angle alone: read on the axis too"});
  }
  std::erase_if(observations.rows, [](const Observation& row) { return row.lit; });
  std::ranges::sort(observations.rejected);
}

PartRound PartRoundAbout(const LightDescription& light, const std::optional<SourceModel>& source,
                         double distance_m, double off_axis_rad) {
  return MeanRound([&](double round_rad) {
    if (!source) {
      return light.distribution
          ->At(Radians(round_rad), Radians(off_axis_rad), TableInterpolation::kCubic)
          .value();
    }
    return LuxPerCandela(PoseAt(*source, distance_m, off_axis_rad, round_rad), 0.0);
  });
}

// Each angle is as far off as the axis that all count from, which is sought or widens, and on
// which side of the lamp the meter went nobody says: one error of all such readings, no number of
// them brings the interval under it.
void WidenByAngle(const LightDescription& light, const std::optional<SourceModel>& source,
                  Observations& observations) {
  const double sigma = AngleSigma(light).value();
  std::ptrdiff_t decided = 0;
  const auto count = static_cast<double>(std::ranges::count_if(observations.rows, ByAngle));
  if (count == 0.0 || (!source && !light.distribution)) return;
  for (Observation& row : observations.rows) {
    if (!ByAngle(row)) continue;
    const auto part = [&](double off_axis_rad) {
      return PartRoundAbout(light, source, row.distance_m, std::abs(off_axis_rad));
    };
    const double angle = std::abs(row.off_axis_rad);
    const PartRound here = part(angle);
    if (!(here.mean > 0.0)) continue;
    const double steep = std::max(std::abs(part(angle + sigma).mean / here.mean - 1.0),
                                  std::abs(part(angle - sigma).mean / here.mean - 1.0));
    const double axis = AxisIsSought(light) ? 0.0 : count;
    const double relative =
        std::sqrt((1.0 + axis) * steep * steep + count * here.sd_relative * here.sd_relative);
    row.sigma_lx = std::hypot(row.sigma_lx, relative * row.measured_lx);
    decided += steep > kAngleDecides ? 1 : 0;
  }
  if (decided > 0 && decided == std::ranges::count_if(observations.rows, &Observation::lit)) {
    RejectAtEdge(light, observations);
  }
}

}  // namespace

Radians AngleSigma(const LightDescription& light) {
  return light.angle_sigma.value_or(RadiansFromDegrees(1.0));
}

std::optional<PlacedSource> PlacedSourceOf(const LightDescription& light) {
  std::optional<SourceModel> model = ModelOf(light);
  if (!model || !light.position_m) return std::nullopt;
  if (light.aim) {
    return PlacedSource{*model, *light.position_m,
                        SourceFrame::Facing(*light.aim, light.axis.value_or(Vec3{}))};
  }
  // A sphere shines alike all round; of a tube known by its axis any direction square to that
  // serves as z.
  constexpr Vec3 kDown = {0.0, 0.0, -1.0};
  if (!light.axis) return PlacedSource{*model, *light.position_m, SourceFrame::Facing(kDown)};
  const Vec3 z = SourceFrame::Facing(*light.axis).y;
  return PlacedSource{*model, *light.position_m, SourceFrame::Facing(z, *light.axis)};
}

double EmissionBefore(const PlacedSource& source, LightKind kind, const Observation& row) {
  return EmissionIn(PoseOf(source, WayOf(kind), row), row);
}

double LightRoundAbout(const LightDescription& light, double distance_m, double off_axis_rad) {
  return PartRoundAbout(light, AimedSourceOf(light), distance_m, off_axis_rad).mean;
}

void PoseBefore(const PlacedSource& source, LightKind kind, Observations& observations) {
  for (Observation& row : observations.rows) {
    if (!IsPosed(row)) continue;
    row.off_axis = PoseOf(source, WayOf(kind), row);
    row.emission = EmissionIn(*row.off_axis, row);
  }
}

int PlaceOnSource(const LightDescription& light, bool cone_found, Observations& observations) {
  // Half way between the two sides of a rect, for which a reading by its angle stands.
  constexpr double kBetweenSides = 0.25 * std::numbers::pi;
  const std::optional<PlacedSource> placed = PlacedSourceOf(light);
  const std::optional<SourceModel> aimed = AimedSourceOf(light);
  WidenByAngle(light, aimed, observations);
  if (!placed && !aimed) return 0;
  const bool spot = light.kind == LightKind::kSpot;
  int dark = 0;
  std::vector<Observation> kept;
  for (Observation& row : observations.rows) {
    std::optional<OffAxisPose> pose;
    if (placed && IsPosed(row)) {
      pose = PoseOf(*placed, WayOf(light.kind), row);
    } else if (aimed && ByAngle(row)) {
      pose = PoseAt(*aimed, row.distance_m, row.off_axis_rad, kBetweenSides);
    }
    if (!pose) {
      kept.push_back(std::move(row));
      continue;
    }
    row.emission = EmissionIn(*pose, row);
    if (!(row.emission > (spot ? kDarkShare : 0.0))) {
      ++dark;
      if (cone_found) continue;
      observations.rejected.push_back(row.index);
      observations.warnings.push_back(
          {"row_rejected", light.name + ", reading " + std::to_string(row.index),
           ByAngle(row) ? "the lamp does not shine there by its size or cone; check them and the "
                          "reading's off_axis_deg"
                        : "the lamp does not shine there by its position_m, aim and size or cone; "
                          "check them and the reading's position_m"});
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
