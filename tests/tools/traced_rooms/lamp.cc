// SPDX-License-Identifier: Apache-2.0
#include "lamp.h"

#include <algorithm>

namespace traced_rooms {

std::string_view NameOf(LampKind kind) {
  switch (kind) {
    case LampKind::kBulb:
      return "bulb";
    case LampKind::kPanel:
      return "panel";
    case LampKind::kBeam:
      return "beam";
  }
  return "";
}

double Lamp::BulbPattern(double cosine_to_base) const {
  constexpr double kEdge = 15.0 * kPi / 180.0;
  const double from_base = std::acos(std::clamp(cosine_to_base, -1.0, 1.0));
  const double step = std::clamp((from_base - base_angle) / kEdge, 0.0, 1.0);
  return (1.0 - slope * cosine_to_base) * step * step * (3.0 - 2.0 * step);
}

double Lamp::Intensity(const Vec3& direction) const {
  if (kind == LampKind::kBulb) {
    return BulbPattern(Dot(direction, base)) / BulbPattern(Dot(towards, base));
  }
  const double cosine = Dot(direction, towards);
  if (cosine <= 0.0) return 0.0;
  return kind == LampKind::kPanel ? cosine : std::pow(cosine, power);
}

double Lamp::FluxOverIntensity() const {
  if (kind == LampKind::kPanel) return kPi;
  if (kind == LampKind::kBeam) return 2.0 * kPi / (power + 1.0);
  constexpr int kSteps = 20000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) sum += BulbPattern(-1.0 + 2.0 * (i + 0.5) / kSteps);
  return 4.0 * kPi * sum / kSteps / BulbPattern(Dot(towards, base));
}

double Lamp::Direct(double distance) const {
  if (kind != LampKind::kPanel) return 1.0 / (distance * distance);
  return RectangleIlluminanceOverRadiance(width, height, distance) / (width * height);
}

double Lamp::DirectAt(const Vec3& meter, const Vec3& normal) const {
  const int cells = kind == LampKind::kPanel ? 64 : 1;
  const Frame frame(towards);
  double sum = 0.0;
  for (int i = 0; i < cells * cells; ++i) {
    const double x = cells == 1 ? 0.0 : width * ((i % cells + 0.5) / cells - 0.5);
    const double y = cells == 1 ? 0.0 : height * ((i / cells + 0.5) / cells - 0.5);
    const Vec3 way = meter - (place + frame.At(x, y, 0.0));
    const double r = Length(way);
    const double arriving = -Dot(way, normal) / r;
    if (arriving > 0.0) sum += Intensity((1.0 / r) * way) * arriving / (r * r);
  }
  return sum / (cells * cells);
}

void Lamp::Emit(Random& random, Vec3* origin, Vec3* direction) const {
  *origin = place;
  if (kind == LampKind::kBulb) {
    const Frame frame(base);
    for (;;) {
      const double cosine = random.Between(-1.0, 1.0);
      if (random.Share() * (1.0 + std::abs(slope)) > BulbPattern(cosine)) continue;
      const double turn = 2.0 * kPi * random.Share();
      const double sine = std::sqrt(1.0 - cosine * cosine);
      *direction = frame.At(sine * std::cos(turn), sine * std::sin(turn), cosine);
      return;
    }
  }
  const Frame frame(towards);
  const double exponent = kind == LampKind::kPanel ? 2.0 : power + 1.0;
  const double cosine = std::pow(1.0 - random.Share(), 1.0 / exponent);
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const double turn = 2.0 * kPi * random.Share();
  *direction = frame.At(sine * std::cos(turn), sine * std::sin(turn), cosine);
  if (kind == LampKind::kPanel) {
    const double x = width * (random.Share() - 0.5);
    const double y = height * (random.Share() - 0.5);
    *origin = place + frame.At(x, y, 0.0);
  }
}

void Lamp::CardHalfSides(double* along_u, double* along_v) const {
  *along_u = *along_v = 0.05;
  if (kind == LampKind::kPanel) {
    *along_u = 1.1 * width / 4.0 + 0.015;
    *along_v = 1.1 * height / 4.0 + 0.015;
  }
}

double RectangleIlluminanceOverRadiance(double a, double b, double d) {
  const double x = a / (2.0 * d);
  const double y = b / (2.0 * d);
  const double by_x = std::sqrt(1.0 + x * x);
  const double by_y = std::sqrt(1.0 + y * y);
  return 2.0 * (x / by_x * std::atan(y / by_x) + y / by_y * std::atan(x / by_y));
}

}  // namespace traced_rooms
