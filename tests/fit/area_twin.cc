// SPDX-License-Identifier: Apache-2.0
#include "area_twin.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lightcal::test {
namespace {

using std::numbers::pi;
constexpr int kPieces = 40;

// cos at the source times cos at the meter over r^2; 0 behind either.
double Piece(const Vec3& at, const Vec3& source_normal, const Vec3& meter, const Vec3& normal) {
  const Vec3 v = at - meter;
  const double r2 = Dot(v, v);
  const double here = Dot(v, normal);
  const double there = -Dot(v, source_normal);
  return here > 0.0 && there > 0.0 ? here * there / (r2 * r2) : 0.0;
}

Vec3 Unit(const Vec3& v) { return v * (1.0 / Length(v)); }

// Sum over pieces of equal weight, relative to the axial far field.
double Rect(const AreaTwin& t, const Vec3& center, const Vec3& meter, const Vec3& normal) {
  const Vec3 up = Cross(*t.light.aim, t.width_axis);
  double sum = 0.0;
  for (int i = 0; i < kPieces; ++i) {
    for (int j = 0; j < kPieces; ++j) {
      const double u = ((i + 0.5) / kPieces - 0.5) * t.light.width->value();
      const double v = ((j + 0.5) / kPieces - 0.5) * t.light.height->value();
      sum += Piece(center + t.width_axis * u + up * v, *t.light.aim, meter, normal);
    }
  }
  return sum / (kPieces * kPieces);
}

double Disk(const AreaTwin& t, const Vec3& center, const Vec3& meter, const Vec3& normal) {
  const Vec3 up = Cross(*t.light.aim, t.width_axis);
  double sum = 0.0;
  for (int i = 0; i < kPieces; ++i) {
    const double r = std::sqrt((i + 0.5) / kPieces) * 0.5 * t.light.diameter->value();
    for (int j = 0; j < kPieces; ++j) {
      const double f = 2.0 * pi * (j + 0.5 * (i % 2)) / kPieces;
      sum += Piece(center + t.width_axis * (r * std::cos(f)) + up * (r * std::sin(f)), *t.light.aim,
                   meter, normal);
    }
  }
  return sum / (kPieces * kPieces);
}

// The surface's luminance fills pi R^2 of cross section, its area is 4 pi R^2.
double Sphere(const AreaTwin& t, const Vec3& center, const Vec3& meter, const Vec3& normal) {
  constexpr int kRings = 120;
  const double radius = 0.5 * t.light.diameter->value();
  const Vec3 toward = Unit(meter - center);
  const Vec3 side = Unit(Cross(toward, std::abs(toward[2]) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}));
  const Vec3 other = Cross(toward, side);
  double sum = 0.0;
  for (int i = 0; i < kRings; ++i) {
    const double z = -1.0 + 2.0 * (i + 0.5) / kRings;
    const double s = std::sqrt(1.0 - z * z);
    for (int j = 0; j < kPieces; ++j) {
      const double f = 2.0 * pi * j / kPieces;
      const Vec3 n = toward * z + side * (s * std::cos(f)) + other * (s * std::sin(f));
      sum += Piece(center + n * radius, n, meter, normal);
    }
  }
  return 4.0 * sum / (kRings * kPieces);
}

// Axial cross section 2 R l of a mantle 2 pi R l.
double Tube(const AreaTwin& t, const Vec3& center, const Vec3& meter, const Vec3& normal) {
  const Vec3& axis = t.width_axis;
  const Vec3 side = Unit(Cross(axis, std::abs(axis[2]) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}));
  const Vec3 other = Cross(axis, side);
  constexpr int kSlices = 120;
  double sum = 0.0;
  for (int i = 0; i < kSlices; ++i) {
    const double x = ((i + 0.5) / kSlices - 0.5) * t.light.length->value();
    for (int j = 0; j < kPieces; ++j) {
      const double f = 2.0 * pi * j / kPieces;
      const Vec3 n = side * std::cos(f) + other * std::sin(f);
      sum += Piece(center + axis * x + n * t.light.radius->value(), n, meter, normal);
    }
  }
  return pi * sum / (kSlices * kPieces);
}

double Spot(const AreaTwin& t, const Vec3& center, const Vec3& meter, const Vec3& normal) {
  const Vec3 v = meter - center;
  const double d = Length(v);
  const double here = -Dot(v, normal) / d;
  const double cosine = Dot(v, *t.light.aim) / d;
  const double co = std::cos(t.outer_rad);
  const double ci = std::cos(t.inner_rad);
  const double share = std::clamp((cosine - co) / std::max(1e-12, ci - co), 0.0, 1.0);
  return std::max(0.0, here) * share * share / (d * d);
}

Vec3 LightStart(const AreaTwin& t, const Vec3& meter) {
  const Vec3& p = *t.light.position_m;
  const bool aimed = t.light.kind == LightKind::kDisk || t.light.kind == LightKind::kRect ||
                     t.light.kind == LightKind::kSpot;
  if (aimed) return p - *t.light.aim * t.offset_m;
  Vec3 away = p - meter;
  if (t.light.kind == LightKind::kTube) away = away - t.width_axis * Dot(away, t.width_axis);
  return p + Unit(away) * t.offset_m;
}

}  // namespace

AreaTwin LampOfKind(LightKind kind) {
  AreaTwin twin;
  twin.light.name = "lamp";
  twin.light.kind = kind;
  twin.light.position_m = Vec3{0.0, 0.0, 0.0};
  twin.light.aim = Vec3{0.0, 1.0, 0.0};
  if (kind == LightKind::kSphere) twin.light.diameter = Metres(0.4);
  if (kind == LightKind::kDisk) twin.light.diameter = Metres(0.6);
  if (kind == LightKind::kRect) {
    twin.light.width = Metres(0.8);
    twin.light.height = Metres(0.4);
  }
  if (kind == LightKind::kTube) {
    twin.light.length = Metres(1.2);
    twin.light.radius = Metres(0.03);
  }
  if (kind == LightKind::kSpot) {
    twin.inner_rad = 0.3;
    twin.outer_rad = 0.7;
    twin.light.inner = Radians(twin.inner_rad);
    twin.light.outer = Radians(twin.outer_rad);
  }
  return twin;
}

double TrueLux(const AreaTwin& twin, const Vec3& meter, const Vec3& normal) {
  const Vec3 center = LightStart(twin, meter);
  switch (twin.light.kind) {
    case LightKind::kRect:
      return twin.intensity_cd * Rect(twin, center, meter, normal);
    case LightKind::kDisk:
      return twin.intensity_cd * Disk(twin, center, meter, normal);
    case LightKind::kSphere:
      return twin.intensity_cd * Sphere(twin, center, meter, normal);
    case LightKind::kTube:
      return twin.intensity_cd * Tube(twin, center, meter, normal);
    case LightKind::kSpot:
      return twin.intensity_cd * Spot(twin, center, meter, normal);
    default:
      break;
  }
  const Vec3 v = center - meter;
  const double d = Length(v);
  return twin.intensity_cd * std::max(0.0, Dot(v, normal)) / (d * d * d);
}

Session ReadAt(const AreaTwin& twin, const std::vector<Pose>& poses, double sigma,
               std::mt19937_64& random) {
  Session session;
  session.surroundings = Surroundings::kDark;
  session.name = "twin";
  session.lights = {twin.light};
  session.lights.back().lamp_class = LampClass::kWhiteLed;
  session.lights.back().in_time.minutes_on = 120.0;
  std::normal_distribution<double> normal;
  for (const Pose& pose : poses) {
    SessionReading row;
    row.reading.light = twin.light.name;
    row.reading.position_m = pose.position;
    row.reading.normal = pose.normal;
    row.reading.illuminance =
        Lux(TrueLux(twin, pose.position, pose.normal) * std::exp(sigma * normal(random)));
    row.reading.sigma_relative = sigma;
    session.readings.push_back(row);
  }
  return session;
}

std::vector<Pose> PosesAround(const Vec3& aim, int count, double near, double far, double off_rad,
                              double tilt_rad, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform;
  const auto turned = [&](const Vec3& from, double most) {
    const Vec3 side = Unit(Cross(from, std::abs(from[2]) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}));
    const double f = 2.0 * pi * uniform(random);
    const double angle = most * std::sqrt(uniform(random));
    return from * std::cos(angle) +
           (side * std::cos(f) + Cross(from, side) * std::sin(f)) * std::sin(angle);
  };
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) {
    const double d = near * std::pow(far / near, count > 1 ? i / (count - 1.0) : 0.0);
    const Vec3 out = turned(aim, off_rad);
    poses.push_back({out * d, turned(out * -1.0, tilt_rad)});
  }
  return poses;
}

}  // namespace lightcal::test
