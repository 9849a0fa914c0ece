// SPDX-License-Identifier: Apache-2.0
// Lamps of the traced rooms. Every lamp has intensity 1 towards the meter.
#pragma once

#include <string_view>

#include "vec3.h"

namespace traced_rooms {

enum class LampKind { kBulb, kPanel, kBeam };

std::string_view NameOf(LampKind kind);

// A lamp at `place` whose meter stands on the line along the unit vector `towards`.
//   bulb:  a sphere of uniform radiance (so, outside it, a point), seen from `base`:
//          I = (1 + slope cos psi) step(psi), psi from the direction away from the base; the base
//          takes all light within base_angle of it, and lets it through 15 degrees on.
//   panel: a Lambertian rectangle width x height that faces the meter and shines to one side.
//   beam:  I = cos^power of the angle to `towards`, from a point.
struct Lamp {
  LampKind kind = LampKind::kBulb;
  Vec3 place, towards;
  Vec3 base{0, 0, 1};
  double base_angle = 0.5;  // rad
  double slope = 0.0;
  double width = 0.3, height = 0.3;  // m
  double power = 3.0;

  // [cd per cd towards the meter] of the far field.
  double Intensity(const Vec3& direction) const;
  // All its light over its intensity towards the meter [sr].
  double FluxOverIntensity() const;
  // Illuminance [lx per cd] facing the lamp at a distance along `towards`: 1/d^2, a panel's
  // exactly.
  double Direct(double distance) const;
  // The same at any place, of a meter that faces `normal`; a panel's by 64 x 64 patches.
  double DirectAt(const Vec3& meter, const Vec3& normal) const;
  // A ray of its light: all carry the same flux.
  void Emit(Random& random, Vec3* origin, Vec3* direction) const;
  // Half the sides of a card half way to a meter that keeps all direct light from it, with a
  // margin.
  void CardHalfSides(double* along_u, double* along_v) const;

 private:
  double BulbPattern(double cosine_to_base) const;
};

// E / L of a rectangle a x b centred above, parallel and facing the receiver at distance d:
//   4 * 1/2 [ X/sqrt(1+X^2) atan(Y/sqrt(1+X^2)) + Y/sqrt(1+Y^2) atan(X/sqrt(1+Y^2)) ],
//   X = a/2d, Y = b/2d.
// Source: Howell, A Catalog of Radiation Configuration Factors, B-3 (there divided by pi).
double RectangleIlluminanceOverRadiance(double a, double b, double d);

}  // namespace traced_rooms
