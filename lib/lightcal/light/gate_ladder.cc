// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/gate_ladder.h"

#include <algorithm>
#include <cmath>

#include "lightcal/light/effect_cost.h"
#include "lightcal/light/gate.h"

namespace lightcal {
namespace {

// I cos(t)/d^2 itself.
constexpr double kPointCost_ns = 1.3;

// A reading `distance` in front of a lamp in the middle of a room, by a good meter: f1' 0.1 %.
Scene InRoom(LightKind kind, const Vec3& room, double reflectance, double distance) {
  Scene scene;
  scene.kind = kind;
  scene.room = RoomBox{room, reflectance};
  ScenePose pose;
  pose.distance_m = distance;
  scene.poses.push_back(pose);
  scene.ambient_ratio = 1e-4;
  scene.head_radius = Metres(0.005);
  scene.spectral_f1 = 0.001;
  scene.cosine_f2 = 0.015;
  scene.time.filament = false;
  scene.time.on_for_s = 7200.0;
  scene.time.ripple = 0.05;
  return scene;
}

Scene Tilted(Scene scene, double tilt_deg) {
  scene.poses.front().tilt_rad = RadiansFromDegrees(tilt_deg).value();
  return scene;
}

Scene Bulb(const Vec3& room, double reflectance, double distance) {
  Scene scene = InRoom(LightKind::kSphere, room, reflectance, distance);
  scene.size.diameter = Metres(0.06);
  scene.poses.front().from_center = true;
  return scene;
}

Scene Disk(const Vec3& room, double reflectance, double distance, double diameter) {
  Scene scene = InRoom(LightKind::kDisk, room, reflectance, distance);
  scene.size.diameter = Metres(diameter);
  return scene;
}

Scene Panel(const Vec3& room, double reflectance, double distance, double width, double height) {
  Scene scene = InRoom(LightKind::kRect, room, reflectance, distance);
  scene.size.width = Metres(width);
  scene.size.height = Metres(height);
  return scene;
}

}  // namespace

std::vector<NamedScene> LadderScenes() {
  const Vec3 hall = {40.0, 30.0, 12.0};
  const Vec3 studio = {9.0, 7.0, 4.0};
  const Vec3 office = {6.0, 5.0, 2.8};
  const Vec3 room = {4.0, 3.5, 2.5};
  std::vector<NamedScene> out;
  // The last figure of each: what tests/tools/gate_truth/ladder_truth.py prints; a test holds it to
  // that.
  out.push_back({"bare bulb, dark hall", Bulb(hall, 0.03, 1.0), 1.00007});
  Scene stage = InRoom(LightKind::kSpot, hall, 0.03, 8.0);
  stage.beam = RadiansFromDegrees(20.0);
  stage.size.diameter = Metres(0.2);
  stage.time.haze_per_metre = 0.01;
  out.push_back({"spot through stage haze", stage, 0.92147});
  out.push_back({"softbox, dark hall", Disk(hall, 0.03, 2.0, 0.9), 0.95154});
  out.push_back(
      {"softbox aslant, black studio", Tilted(Disk(studio, 0.05, 2.0, 0.9), 30.0), 0.82690});
  out.push_back({"bare bulb, living room", Bulb(office, 0.4, 1.0), 1.09850});
  Scene tube = InRoom(LightKind::kTube, office, 0.4, 1.0);
  tube.size.length = Metres(1.2);
  tube.size.radius = Metres(0.013);
  out.push_back({"tube, garage", tube, 0.89799});
  Scene grey = Panel(office, 0.55, 1.2, 0.6, 0.6);
  grey.ambient_ratio = 0.02;
  out.push_back({"panel by daylight, office", grey, 0.97888});
  Scene white = Tilted(Panel(room, 0.85, 0.8, 1.2, 0.6), 25.0);
  white.ambient_ratio = 0.05;
  out.push_back({"panel aslant, white room", white, 0.82734});
  return out;
}

double GatedIlluminance(const Scene& scene, const std::vector<std::string>& on) {
  const ScenePose& pose = scene.poses.front();
  double direct = 1.0;
  double rest = 0.0;
  for (const std::string& effect : on) {
    const double factor = FactorOfEffect(effect, scene, pose);
    if (effect == "room_bounce" || effect == "ambient") {
      rest += factor - 1.0;
    } else if (effect != "distance_error") {  // an error, not a part of the scene
      direct *= factor;
    }
  }
  return (direct + rest) / (pose.distance_m * pose.distance_m);
}

GateStep StepOf(const NamedScene& named, double tolerance) {
  GateStep step;
  step.name = named.name;
  const auto gated = GateEffects(named.scene, tolerance, "auto");
  std::vector<std::string> all;
  std::vector<std::string> on;
  for (const GatedEffect& effect : *gated) {
    if (!effect.finding.applies) continue;
    all.emplace_back(effect.name);
    if (!effect.ignored) on.emplace_back(effect.name);
    step.cost_all_ns += effect.cost_ns;
  }
  step.cost_none_ns = kPointCost_ns;
  step.cost_all_ns += kPointCost_ns;
  step.cost_gate_ns = kPointCost_ns + CostOf(*gated);
  const double distance_m = named.scene.poses.front().distance_m;
  const auto error = [&](const std::vector<std::string>& effects) {
    const double answer = GatedIlluminance(named.scene, effects) * distance_m * distance_m;
    return std::abs(answer / named.truth - 1.0);
  };
  step.error_all = error(all);
  step.error_gate = error(on);
  step.error_none = error({});
  step.bound = LeftOffTogether(*gated);
  return step;
}

}  // namespace lightcal
