// SPDX-License-Identifier: Apache-2.0
#include "gate_truth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lightcal::test {
namespace {

using std::numbers::pi;
constexpr double kDegree = pi / 180.0;

double ExponentOf(double beam_rad) { return std::log(0.5) / std::log(std::cos(0.5 * beam_rad)); }

class Draw {
 public:
  explicit Draw(std::mt19937_64& random) : random_(random) {}
  double Between(double low, double high) { return low + (high - low) * uniform_(random_); }
  double Ratio(double low, double high) { return low * std::pow(high / low, uniform_(random_)); }

 private:
  std::mt19937_64& random_;
  std::uniform_real_distribution<double> uniform_;
};

Place Direction(Draw& draw) {
  const double z = draw.Between(-1.0, 1.0);
  const double turn = draw.Between(0.0, 2.0 * pi);
  const double s = std::sqrt(1.0 - z * z);
  return {s * std::cos(turn), s * std::sin(turn), z};
}

// A unit vector square to `axis`.
Place Square(const Place& axis, Draw& draw) {
  for (;;) {
    const Place d = Direction(draw);
    const double along = d[0] * axis[0] + d[1] * axis[1] + d[2] * axis[2];
    Place out{};
    double length = 0.0;
    for (int k = 0; k < 3; ++k) {
      out[k] = d[k] - along * axis[k];
      length += out[k] * out[k];
    }
    if (length < 0.01) continue;
    for (double& x : out) x /= std::sqrt(length);
    return out;
  }
}

bool Inside(const Place& p, const GreyBox& box, double margin) {
  for (int k = 0; k < 3; ++k) {
    const double low = k == 2 ? 0.0 : -0.5 * box.size[k];
    if (p[k] < low + margin || p[k] > low + box.size[k] - margin) return false;
  }
  return true;
}

// Mean of the kernel over a disk by rings and spokes, for a meter at distance d, `emission` off the
// axis in the plane of x and z, tilted in any direction about the line to it.
double DiskMean(double radius, const TruthScene& scene, double exponent) {
  constexpr int kRings = 16;
  constexpr int kSpokes = 24;
  const double d = scene.distance_m;
  const double s = std::sin(scene.emission_rad);
  const double c = std::cos(scene.emission_rad);
  const double facing_part = std::cos(scene.tilt_rad);
  const double in_plane = std::sin(scene.tilt_rad) * std::cos(scene.tilt_turn_rad);
  const double across = std::sin(scene.tilt_rad) * std::sin(scene.tilt_turn_rad);
  const double nx = -s * facing_part + c * in_plane;
  const double ny = across;
  const double nz = -c * facing_part - s * in_plane;
  double sum = 0.0;
  for (int i = 0; i < kRings; ++i) {
    const double a = radius * std::sqrt((i + 0.5) / kRings);  // rings of one area
    for (int j = 0; j < kSpokes; ++j) {
      const double turn = 2.0 * pi * (j + 0.5) / kSpokes;
      const double vx = d * s - a * std::cos(turn);
      const double vy = -a * std::sin(turn);
      const double vz = d * c;
      const double r2 = vx * vx + vy * vy + vz * vz;
      const double r = std::sqrt(r2);
      const double facing = -(vx * nx + vy * ny + vz * nz) / r;
      if (facing > 0.0) sum += std::pow(vz / r, exponent) * facing / r2;
    }
  }
  return sum / (kRings * kSpokes);
}

// Mean over the meter's head of a point's light, over that at its middle.
double HeadMean(double head, double d) {
  constexpr int kRings = 64;
  double sum = 0.0;
  for (int i = 0; i < kRings; ++i) {
    const double a2 = head * head * (i + 0.5) / kRings;
    sum += d / std::pow(d * d + a2, 1.5);
  }
  return sum / kRings * d * d;
}

// Light gathered in a window over the mean's, pulse by pulse.
double PulsesSeen(double hz, double duty, double window, double phase) {
  double lit = 0.0;
  const double last = phase + window * hz;
  for (double k = -1.0; k <= last; k += 1.0) {
    lit += std::max(0.0, std::min(last, k + duty) - std::max(phase, k));
  }
  return lit / (duty * window * hz);
}

}  // namespace

TruthScene RandomTruthScene(std::mt19937_64& random) {
  Draw draw(random);
  TruthScene scene;
  for (;;) {
    scene.box.size = {draw.Ratio(3.0, 14.0), draw.Ratio(3.0, 10.0), draw.Between(2.4, 5.0)};
    scene.box.reflectance = draw.Between(0.02, 0.85);
    for (int k = 0; k < 3; ++k) {
      const double low = k == 2 ? 0.0 : -0.5 * scene.box.size[k];
      scene.lamp[k] = low + scene.box.size[k] * draw.Between(0.0, 1.0);
    }
    scene.distance_m = draw.Ratio(0.3, 4.0);
    const Place away = Direction(draw);
    for (int k = 0; k < 3; ++k) scene.meter[k] = scene.lamp[k] + scene.distance_m * away[k];
    if (!Inside(scene.lamp, scene.box, 0.3) || !Inside(scene.meter, scene.box, 0.3)) continue;
    scene.beam_rad = draw.Between(20.0, 150.0) * kDegree;
    scene.emission_rad =
        draw.Between(0.0, 1.0) < 0.5 ? 0.0 : draw.Between(0.002, 0.35 * scene.beam_rad);
    const Place side = Square(away, draw);
    for (int k = 0; k < 3; ++k) {
      scene.aim[k] =
          std::cos(scene.emission_rad) * away[k] + std::sin(scene.emission_rad) * side[k];
    }
    break;
  }
  scene.radius_m = draw.Ratio(0.005, 0.15);
  scene.tilt_rad = draw.Between(0.0, 1.0) < 0.5 ? 0.0 : draw.Between(1.0, 20.0) * kDegree;
  scene.head_radius_m = draw.Ratio(0.002, 0.015);
  scene.flicker_hz = draw.Ratio(100.0, 2000.0);
  scene.duty = draw.Between(0.1, 0.95);
  scene.window_s = draw.Between(0.1, 0.5);
  scene.on_for_s = draw.Between(600.0, 5400.0);
  scene.haze_per_metre = draw.Ratio(1e-4, 3e-2);
  scene.ambient_over_direct = draw.Ratio(1e-4, 0.2);
  scene.slip_m = draw.Between(-0.005, 0.005);
  scene.pointing_rad = draw.Between(-3.0, 3.0) * kDegree;
  scene.tilt_turn_rad = draw.Between(0.0, 2.0 * pi);
  scene.phase = draw.Between(0.0, 1.0);
  scene.warm_up_part = draw.Between(0.1, 0.2);
  scene.mains = draw.Between(-0.01, 0.01);
  return scene;
}

TruthParts BruteForce(const TruthScene& scene) {
  const double exponent = ExponentOf(scene.beam_rad);
  const double c = std::cos(scene.emission_rad);
  TruthParts parts;
  const double facing = 1.0 / (scene.distance_m * scene.distance_m);
  parts.point = std::pow(c, exponent) * facing;
  parts.lambert = DiskMean(scene.radius_m, scene, 1.0) / (c * std::cos(scene.tilt_rad) * facing);
  parts.beam = DiskMean(scene.radius_m, scene, exponent) / (parts.point * std::cos(scene.tilt_rad));
  parts.head = HeadMean(scene.head_radius_m, scene.distance_m);
  Place normal{};
  for (int k = 0; k < 3; ++k) normal[k] = (scene.lamp[k] - scene.meter[k]) / scene.distance_m;
  parts.bounce = IndirectIlluminance(scene.box, {scene.lamp, scene.aim, exponent}, scene.meter,
                                     normal, {6, 40});
  parts.flicker = PulsesSeen(scene.flicker_hz, scene.duty, scene.window_s, scene.phase);
  parts.warm_up = 1.0 + scene.warm_up_part * std::exp(-scene.on_for_s / 900.0);
  parts.mains = std::pow(1.0 + scene.mains, 3.45);
  return parts;
}

double Illuminance(const TruthScene& scene, const TruthParts& parts, unsigned effects) {
  const auto on = [effects](TruthEffect effect) { return (effects >> effect & 1U) != 0U; };
  double direct = parts.point;
  if (on(kNarrowBeam)) {
    direct *= parts.beam;
  } else if (on(kFiniteSource)) {
    direct *= parts.lambert;
  }
  if (on(kDetectorSize)) direct *= parts.head;
  double distance = scene.distance_m;
  if (on(kDistanceError)) {
    distance += scene.slip_m;
    direct *= scene.distance_m * scene.distance_m / (distance * distance);
  }
  if (on(kMeterTilt)) direct *= std::cos(scene.tilt_rad + scene.pointing_rad);
  if (on(kHaze)) direct *= std::exp(-scene.haze_per_metre * distance);
  double lamp = direct + (on(kRoomBounce) ? parts.bounce : 0.0);
  if (on(kFlicker)) lamp *= parts.flicker;
  if (on(kWarmUp)) lamp *= parts.warm_up;
  if (on(kMains)) lamp *= parts.mains;
  return lamp + (on(kAmbient) ? scene.ambient_over_direct * parts.point : 0.0);
}

}  // namespace lightcal::test
