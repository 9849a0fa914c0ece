// SPDX-License-Identifier: Apache-2.0
#include "synthetic_sky.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace lightcal::test {
namespace {

using std::numbers::pi;

double Radians(double degrees) { return degrees * pi / 180.0; }
double Dot(const Ray& a, const Ray& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Rgb3 MeanOfRays(const std::function<Rgb3(const Ray&)>& look, const SkyView& view, int x, int y,
                int side) {
  Rgb3 sum{};
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const SkyRay at = view(x + (i + 0.5) / side, y + (j + 0.5) / side);
      if (!at.seen) continue;
      const Rgb3 rgb = look(at.ray);
      for (std::size_t c = 0; c < 3; ++c) sum[c] += rgb[c] / (side * side);
    }
  }
  return sum;
}

// How far the corners of a pixel look from its middle.
double PixelReach(const SkyView& view, int x, int y, const Ray& middle) {
  double reach = 0.0;
  for (const double dx : {0.0, 1.0}) {
    for (const double dy : {0.0, 1.0}) {
      const SkyRay corner = view(x + dx, y + dy);
      if (corner.seen) reach = std::max(reach, AngleBetween(corner.ray, middle));
    }
  }
  return reach;
}

}  // namespace

double AngleBetween(const Ray& a, const Ray& b) {
  const Ray d = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  return 2.0 * std::asin(std::min(1.0, std::sqrt(Dot(d, d)) / 2.0));
}

Ray RayAt(double azimuth_deg, double elevation_deg) {
  const double a = Radians(azimuth_deg), e = Radians(elevation_deg);
  return {std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e)};
}

double Luminance(const Rgb3& rgb) {
  return 0.2126390059 * rgb[0] + 0.7151686788 * rgb[1] + 0.0721923154 * rgb[2];
}

double SkyLamp::Reach() const { return Radians(blurred ? 6.0 * radius_deg : radius_deg); }

double SkyLamp::Shape(double angle) const {
  if (angle > Reach()) return 0.0;
  const double r = angle / Radians(radius_deg);
  if (blurred) return std::exp(-r * r / 2.0);
  return 1.0 - limb * (1.0 - std::sqrt(std::max(0.0, 1.0 - r * r)));
}

double SkyLamp::MiddleNits() const {
  constexpr int kRings = 20000;
  double sum = 0.0;
  const double step = Reach() / kRings;
  for (int i = 0; i < kRings; ++i) {
    const double angle = (i + 0.5) * step;
    sum += Shape(angle) * std::cos(angle) * 2.0 * pi * std::sin(angle) * step;
  }
  return lux / sum;
}

SkyView LatLongView(int width, int height) {
  return [width, height](double x, double y) {
    const double azimuth = 2.0 * pi * (x / width - 0.5), zenith = pi * y / height;
    return SkyRay{true,
                  {std::sin(azimuth) * std::sin(zenith), std::cos(azimuth) * std::sin(zenith),
                   std::cos(zenith)}};
  };
}

SkyView FisheyeView(int size, double fov_deg, double azimuth_deg, double elevation_deg) {
  const Ray forward = RayAt(azimuth_deg, elevation_deg);
  const Ray right = RayAt(azimuth_deg + 90.0, 0.0);
  const Ray up = RayAt(azimuth_deg, elevation_deg + 90.0);
  const double per_pixel = Radians(fov_deg) / size;
  return [=](double x, double y) {
    const double px = x - size / 2.0, py = size / 2.0 - y, r = std::hypot(px, py);
    if (r > size / 2.0) return SkyRay{};
    const double theta = r * per_pixel, side = r > 0.0 ? std::sin(theta) / r : 0.0;
    SkyRay out{true, {}};
    for (std::size_t c = 0; c < 3; ++c) {
      out.ray[c] = std::cos(theta) * forward[c] + side * (px * right[c] + py * up[c]);
    }
    return out;
  };
}

SkyView LensView(Lens lens, int width, int height, double fov_deg, double azimuth_deg,
                 double elevation_deg, double roll_deg) {
  const Ray forward = RayAt(azimuth_deg, elevation_deg);
  const Ray level = RayAt(azimuth_deg + 90.0, 0.0);
  const Ray upright = RayAt(azimuth_deg, elevation_deg + 90.0);
  const double c = std::cos(Radians(roll_deg)), s = std::sin(Radians(roll_deg));
  const double half = Radians(fov_deg) / 2.0;
  const double rim = lens == Lens::kRect ? width / 2.0 : std::min(width, height) / 2.0;
  return [=](double x, double y) {
    const double px = x - width / 2.0, py = height / 2.0 - y, r = std::hypot(px, py);
    double theta = std::atan(r / rim * std::tan(half));
    if (lens == Lens::kEquidistant) theta = r / rim * half;
    if (lens == Lens::kEquisolid) {
      theta = 2.0 * std::asin(std::min(1.0, r / rim * std::sin(half / 2.0)));
    }
    if (lens != Lens::kRect && r > rim) return SkyRay{};
    const double side = r > 0.0 ? std::sin(theta) / r : 0.0;
    SkyRay out{true, {}};
    for (std::size_t i = 0; i < 3; ++i) {
      const double right = c * level[i] - s * upright[i], up = c * upright[i] + s * level[i];
      out.ray[i] = std::cos(theta) * forward[i] + side * (px * right + py * up);
    }
    return out;
  };
}

void AddLamps(const std::vector<SkyLamp>& lamps, const SkyView& view, SkyPicture& picture) {
  for (const SkyLamp& lamp : lamps) {
    const double middle = lamp.MiddleNits();
    const auto look = [&](const Ray& ray) {
      const double nits = middle * lamp.Shape(AngleBetween(ray, lamp.direction));
      return Rgb3{nits * lamp.tint[0], nits * lamp.tint[1], nits * lamp.tint[2]};
    };
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        const SkyRay at = view(x + 0.5, y + 0.5);
        if (!at.seen) continue;
        const double angle = AngleBetween(at.ray, lamp.direction);
        if (angle > lamp.Reach() + 0.1) continue;
        if (angle > lamp.Reach() + PixelReach(view, x, y, at.ray)) continue;
        const Rgb3 rgb = MeanOfRays(look, view, x, y, 24);
        float* pixel = &picture.rgb[3 * (static_cast<std::size_t>(y) * picture.width + x)];
        for (std::size_t c = 0; c < 3; ++c) pixel[c] += static_cast<float>(rgb[c]);
      }
    }
  }
}

SkyPicture Photograph(const SkyScene& scene, const SkyView& view, int width, int height) {
  SkyPicture picture{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Rgb3 rgb = MeanOfRays(scene.background, view, x, y, 3);
      for (const double v : rgb) picture.rgb.push_back(static_cast<float>(v));
    }
  }
  AddLamps(scene.lamps, view, picture);
  return picture;
}

double TrueLux(const SkyScene& scene, const Ray& normal) {
  // Rings of equal height have equal area (Archimedes).
  constexpr int kHeights = 800, kAround = 1600;
  double lux = 0.0;
  for (int j = 0; j < kHeights; ++j) {
    const double z = 1.0 - 2.0 * (j + 0.5) / kHeights, side = std::sqrt(1.0 - z * z);
    for (int i = 0; i < kAround; ++i) {
      const double azimuth = 2.0 * pi * (i + 0.5) / kAround;
      const Ray ray = {side * std::sin(azimuth), side * std::cos(azimuth), z};
      const double cosine = Dot(ray, normal);
      if (cosine > 0.0) lux += Luminance(scene.background(ray)) * cosine;
    }
  }
  lux *= 4.0 * pi / (double{kHeights} * kAround);
  for (const SkyLamp& lamp : scene.lamps) {
    lux += std::max(0.0, Dot(lamp.direction, normal)) * lamp.lux * Luminance(lamp.tint);
  }
  return lux;
}

}  // namespace lightcal::test
