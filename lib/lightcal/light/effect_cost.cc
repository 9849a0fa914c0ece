// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/effect_cost.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <limits>
#include <utility>

#include "lightcal/light/axial_shape.h"
#include "lightcal/light/effects/ambient.h"
#include "lightcal/light/effects/detector_size.h"
#include "lightcal/light/effects/distance_error.h"
#include "lightcal/light/effects/haze.h"
#include "lightcal/light/effects/narrow_beam.h"
#include "lightcal/light/room_bounce.h"

namespace lightcal {
namespace {

using Factor = double (*)(const Scene& scene, const ScenePose& pose);

double SizeFactor(const Scene& scene, const ScenePose& pose) {
  return AxialShapeFactor(AxialShapeOf(scene.kind, scene.size), pose.distance_m);
}

double TiltFactor(const Scene& /*scene*/, const ScenePose& pose) { return std::cos(pose.tilt_rad); }

double WallsFactor(const Scene& scene, const ScenePose& pose) {
  const double d2 = pose.distance_m * pose.distance_m;
  if (!scene.walls.empty()) {
    return 1.0 + d2 * WallsPerCandela(scene.walls.front().prior, pose.distance_m);
  }
  return scene.room ? 1.0 + d2 * BounceAt(scene, pose).Estimate() : 1.0;
}

double AmbientFactor(const Scene& scene, const ScenePose& /*pose*/) {
  return 1.0 + scene.ambient_ratio.value_or(effects::kAmbientDefault);
}

double BeamRimFactor(const Scene& scene, const ScenePose& pose) {
  if (!scene.beam || scene.kind != LightKind::kSpot) return 1.0;
  const double ratio = SourceRadius(scene).value_or(effects::kRadiusDefault) / pose.distance_m;
  return effects::BeamFactor(effects::BeamExponent(0.5 * scene.beam->value()), ratio * ratio);
}

double HeadFactor(const Scene& scene, const ScenePose& pose) {
  const double head = scene.head_radius ? scene.head_radius->value() : effects::kHeadRadiusDefault;
  return effects::DetectorFactor(head, pose.distance_m);
}

double AirFactor(const Scene& scene, const ScenePose& pose) {
  return effects::HazeFactor(scene.time.haze_per_metre.value_or(effects::kClearAirPerMetre),
                             pose.distance_m);
}

double OffsetBy(double offset_m, const ScenePose& pose) {
  const double ratio = pose.distance_m / (pose.distance_m + offset_m);
  return ratio * ratio;
}
double OffsetFactor(const Scene& scene, const ScenePose& pose) {
  return OffsetBy(scene.offsets.empty() ? 0.0 : scene.offsets.front().mean_m, pose);
}
double DistanceFactor(const Scene& /*scene*/, const ScenePose& pose) {
  return OffsetBy(effects::kDistanceErrorMetres, pose);
}
double SurfaceFactor(const Scene& scene, const ScenePose& pose) {
  const bool to_surface = scene.size.diameter && !pose.from_center;
  return OffsetBy(to_surface ? 0.5 * scene.size.diameter->value() : 0.0, pose);
}

constexpr std::array<std::pair<std::string_view, Factor>, 10> kFactors = {{
    {"distance_offset", OffsetFactor},
    {"ambient", AmbientFactor},
    {"finite_source", SizeFactor},
    {"sphere_surface", SurfaceFactor},
    {"meter_tilt", TiltFactor},
    {"distance_error", DistanceFactor},
    {"room_bounce", WallsFactor},
    {"detector_size", HeadFactor},
    {"haze", AirFactor},
    {"narrow_beam", BeamRimFactor},
}};

Factor FactorNamed(std::string_view name) {
  const auto at = std::ranges::find(kFactors, name, [](const auto& one) { return one.first; });
  return at == kFactors.end() ? nullptr : at->second;
}

// Of one that only widens: its row of the interval.
double Widened(const Scene& /*scene*/, const ScenePose& pose) {
  return 0.01 * std::pow(pose.distance_m, 2.0);
}

double ProcessorTime_ns() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

double Nothing(const Scene& /*scene*/, const ScenePose& pose) { return pose.distance_m; }

// Of one call, the least of several batches.
double CallCost_ns(Factor factor, const Scene& scene) {
  constexpr int kBatches = 15;
  constexpr double kBatch_ns = 1e5;
  volatile double sink = 0.0;
  volatile Factor called = factor;  // not known to the compiler
  double least = std::numeric_limits<double>::infinity();
  for (int batch = 0; batch < kBatches; ++batch) {
    int calls = 0;
    const double from = ProcessorTime_ns();
    double took = 0.0;
    do {
      double sum = 0.0;
      for (int i = 0; i < 64; ++i) {
        for (const ScenePose& pose : scene.poses) sum += called(scene, pose);
      }
      calls += 64 * static_cast<int>(scene.poses.size());
      sink = sink + sum;
      took = ProcessorTime_ns() - from;
    } while (took < kBatch_ns);
    least = std::min(least, took / calls);
  }
  return least;
}

}  // namespace

double FactorOfEffect(std::string_view name, const Scene& scene, const ScenePose& pose) {
  const Factor factor = FactorNamed(name);
  return factor == nullptr ? 1.0 : factor(scene, pose);
}

double MeasuredCost_ns(std::string_view name, const Scene& scene) {
  if (scene.poses.empty()) return 0.0;
  const Factor factor = FactorNamed(name);
  constexpr double kLeast_ns = 0.5;  // what no clock tells from nothing
  return std::max(kLeast_ns, CallCost_ns(factor == nullptr ? Widened : factor, scene) -
                                 CallCost_ns(Nothing, scene));
}

}  // namespace lightcal
