// SPDX-License-Identifier: Apache-2.0
// A simulated lamp at a place nobody tells, and meters at places that are known. It shares no code
// with the fit: a ball of 400 small emitters summed one by one, and air that the fit does not
// model.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "lightcal/records/session.h"

namespace lightcal::test {

struct PlacedLamp {
  double intensity_cd = 1000.0;
  Vec3 position_m{};
  double radius_m = 0.02;
  double ambient_lx = 0.0;
  double extinction_per_m = 2e-4;
};

// Lux at a meter with this normal (any length); facing the lamp's middle where it is null.
[[nodiscard]] double TrueLux(const PlacedLamp& lamp, const Vec3& meter, const Vec3* normal);

// A session with one point light "lamp" without position; readings carry log-normal noise.
class LocatedTwin {
 public:
  LocatedTwin(const PlacedLamp& lamp, double sigma, std::uint64_t seed);
  Reading& Flat(const Vec3& meter, const Vec3& normal = {0, 0, 1}, double times = 1.0);
  Reading& Facing(const Vec3& meter);
  Reading& Distance(const Vec3& meter);  // facing, its distance told, not its place
  Reading& Off();
  [[nodiscard]] const Session& session() const { return session_; }
  [[nodiscard]] Session& session() { return session_; }

 private:
  Reading& Add(double lux);
  PlacedLamp lamp_;
  double sigma_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Session session_;
};

// The corners of a square of this side about the origin, at z = 0.
[[nodiscard]] std::vector<Vec3> SquareCorners(double side_m);

}  // namespace lightcal::test
