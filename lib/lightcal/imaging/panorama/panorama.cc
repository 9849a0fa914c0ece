// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/panorama.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

namespace lightcal {
namespace {

using std::numbers::pi;

constexpr double kLatLongTolerance = 0.01;
constexpr int kRimSamples = 16;
constexpr double kSmoothFocal = 50.0;  // pixels: from here on two orders say it all

// Gauss-Legendre, 3 points on [-1/2, 1/2].
constexpr std::array<std::array<double, 2>, 3> kGauss = {
    {{-0.38729833462074170, 5.0 / 18.0}, {0.0, 8.0 / 18.0}, {0.38729833462074170, 5.0 / 18.0}}};

// Integral of dOmega over [0, x] x [0, y] of the plane at distance 1.
double RectangleSolidAngle(double x, double y) {
  return std::atan(x * y / std::sqrt(1.0 + x * x + y * y));
}
// Integral of cos(theta) dOmega over the same, theta from the plane's normal.
// Source: view factor of a rectangle parallel to a point, Howell, configuration factor B-4.
double RectangleProjected(double x, double y) {
  const double sx = std::sqrt(1.0 + x * x), sy = std::sqrt(1.0 + y * y);
  return 0.5 * (x / sx * std::atan(y / sx) + y / sy * std::atan(x / sy));
}

// sin(t)/t near 0 without 0/0.
double Sinc(double t) { return std::abs(t) < 1e-4 ? 1.0 - t * t / 6.0 : std::sin(t) / t; }

Result<void> CheckView(const PictureView& view) {
  const auto refuse = [](const std::string& message) {
    return Refused("bad_view", "projection", message);
  };
  if (view.width < 1 || view.height < 1) return refuse("the picture has no pixels");
  const double degrees = DegreesFromRadians(view.field_of_view);
  switch (view.projection) {
    case Projection::kLatLong:
      if (std::abs(view.width / (2.0 * view.height) - 1.0) > kLatLongTolerance) {
        return refuse("a lat-long panorama is twice as wide as high; this picture is " +
                      std::to_string(view.width) + " x " + std::to_string(view.height));
      }
      return {};
    case Projection::kRectilinear:
      if (!(degrees > 0.0 && degrees < 180.0)) {
        return refuse(
            "an ordinary lens sees between 0 and 180 degrees across; give {view.field_of_view}");
      }
      return {};
    case Projection::kEquidistant:
    case Projection::kEquisolid:
      break;
  }
  if (!(degrees > 0.0 && degrees <= 360.0)) {
    return refuse("a fisheye sees up to 360 degrees across its circle; give {view.field_of_view}");
  }
  return {};
}

}  // namespace

std::optional<Projection> ProjectionByName(std::string_view name) {
  const auto word = std::ranges::find(kProjectionWords, name);
  if (word == kProjectionWords.end()) return std::nullopt;
  return static_cast<Projection>(word - kProjectionWords.begin());
}

Result<PixelSolidAngles> PixelSolidAngles::Create(const PictureView& view) {
  if (auto ok = CheckView(view); !ok) return Propagate(std::move(ok));
  return PixelSolidAngles(view);
}

PixelSolidAngles::PixelSolidAngles(const PictureView& view) : view_(view) {
  const double half_angle = view.field_of_view.value() / 2.0;
  rim_px_ = std::min(view.width, view.height) / 2.0;
  switch (view.projection) {
    case Projection::kLatLong:
      for (int y = 0; y < view.height; ++y) {
        row_plain_.push_back(LatLongRow(y, Weight::kPlain));
        row_cosine_.push_back(LatLongRow(y, Weight::kCosine));
      }
      return;
    case Projection::kRectilinear:
      focal_px_ = view.width / 2.0 / std::tan(half_angle);
      return;
    case Projection::kEquidistant:
      focal_px_ = rim_px_ / half_angle;
      front_px_ = focal_px_ * pi / 2.0;
      return;
    case Projection::kEquisolid:
      focal_px_ = rim_px_ / (2.0 * std::sin(half_angle / 2.0));
      front_px_ = focal_px_ * std::numbers::sqrt2;
      return;
  }
}

// Between the angles a < b from the zenith, over an azimuth of 2 pi / width:
//   integral sin = cos a - cos b = 2 sin((a+b)/2) sin((b-a)/2)
//   integral sin cos = (sin^2 b - sin^2 a)/2 = sin(b-a) sin(b+a)/2
double PixelSolidAngles::LatLongRow(int y, Weight weight) const {
  const double step = pi / view_.height, azimuth = 2.0 * pi / view_.width;
  const double a = y * step;
  if (weight == Weight::kPlain) {
    return azimuth * 2.0 * std::sin(a + step / 2.0) * std::sin(step / 2.0);
  }
  const double b = std::min((y + 1) * step, pi / 2.0);
  return b > a ? azimuth * std::sin(b - a) * std::sin(b + a) / 2.0 : 0.0;
}

double PixelSolidAngles::Rectilinear(int x, int y, Weight weight) const {
  const auto corner = weight == Weight::kPlain ? RectangleSolidAngle : RectangleProjected;
  const double x0 = (x - view_.width / 2.0) / focal_px_, x1 = x0 + 1.0 / focal_px_;
  const double y0 = (y - view_.height / 2.0) / focal_px_, y1 = y0 + 1.0 / focal_px_;
  return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
}

double PixelSolidAngles::FisheyeTheta(double r) const {
  if (view_.projection == Projection::kEquidistant) return r / focal_px_;
  return 2.0 * std::asin(std::min(1.0, r / (2.0 * focal_px_)));
}

// dOmega/dA, or that times cos(theta), at the radius whose square is r2; 0 beyond the rim (or
// beyond 90 degrees).
double PixelSolidAngles::Density(double r2, Weight weight) const {
  const double limit = weight == Weight::kPlain ? rim_px_ : std::min(rim_px_, front_px_);
  if (r2 > limit * limit) return 0.0;
  const double per_area = 1.0 / (focal_px_ * focal_px_);
  const double theta = FisheyeTheta(std::sqrt(r2));
  const double cosine = weight == Weight::kPlain ? 1.0 : std::cos(theta);
  const double stretch = view_.projection == Projection::kEquidistant ? Sinc(theta) : 1.0;
  return per_area * stretch * cosine;
}

// The mean of the density d(r) over a pixel in the middle of which r is, to second order:
//   d + (d'' + d'/r)/24
// With s = sin(a)/a, and a = theta or (for s cos(theta) = sin(2 theta)/(2 theta)) twice that, the
// Laplacian of an equidistant picture's density is -(s + s'/a) (da/dr)^2; an equisolid one's is 0,
// or -2/f^2 of its cosine 1 - r^2/(2 f^2). The next order is below 1e-3/f^4.
double PixelSolidAngles::SmoothMean(double r, Weight weight) const {
  const double per_area = 1.0 / (focal_px_ * focal_px_);
  if (view_.projection == Projection::kEquisolid) {
    if (weight == Weight::kPlain) return per_area;
    return per_area * (1.0 - r * r * per_area / 2.0 - per_area / 12.0);
  }
  const double turns = weight == Weight::kPlain ? 1.0 : 2.0;
  const double a = turns * r / focal_px_, s = Sinc(a);
  const double slope = a < 1e-3 ? -1.0 / 3.0 : (std::cos(a) - s) / (a * a);  // s'/a
  return per_area * (s - (s + slope) * turns * turns * per_area / 24.0);
}

double PixelSolidAngles::Fisheye(int x, int y, Weight weight) const {
  const double cx = x + 0.5 - view_.width / 2.0, cy = y + 0.5 - view_.height / 2.0;
  const double r = std::hypot(cx, cy);
  constexpr double kHalfDiagonal = std::numbers::sqrt2 / 2.0;
  const auto crosses = [&](double radius) { return std::abs(r - radius) <= kHalfDiagonal; };
  if (crosses(rim_px_) || (weight == Weight::kCosine && crosses(front_px_))) {
    double sum = 0.0;
    for (int i = 0; i < kRimSamples; ++i) {
      for (int j = 0; j < kRimSamples; ++j) {
        const double sx = cx + (i + 0.5) / kRimSamples - 0.5;
        const double sy = cy + (j + 0.5) / kRimSamples - 0.5;
        sum += Density(sx * sx + sy * sy, weight);
      }
    }
    return sum / (kRimSamples * kRimSamples);
  }
  if (r > rim_px_ || (weight == Weight::kCosine && r > front_px_)) return 0.0;
  if (focal_px_ >= kSmoothFocal) return SmoothMean(r, weight);
  double sum = 0.0;
  for (const auto& [dx, wx] : kGauss) {
    for (const auto& [dy, wy] : kGauss) {
      const double sx = cx + dx, sy = cy + dy;
      sum += wx * wy * Density(sx * sx + sy * sy, weight);
    }
  }
  return sum;
}

double PixelSolidAngles::SolidAngle(int x, int y) const {
  switch (view_.projection) {
    case Projection::kLatLong:
      return row_plain_[static_cast<std::size_t>(y)];
    case Projection::kRectilinear:
      return Rectilinear(x, y, Weight::kPlain);
    default:
      return Fisheye(x, y, Weight::kPlain);
  }
}

double PixelSolidAngles::ProjectedSolidAngle(int x, int y) const {
  switch (view_.projection) {
    case Projection::kLatLong:
      return row_cosine_[static_cast<std::size_t>(y)];
    case Projection::kRectilinear:
      return Rectilinear(x, y, Weight::kCosine);
    default:
      return Fisheye(x, y, Weight::kCosine);
  }
}

std::optional<Vec3> PixelSolidAngles::Direction(double x, double y) const {
  if (view_.projection == Projection::kLatLong) {
    const double azimuth = 2.0 * pi * (x / view_.width - 0.5);
    const double zenith = pi * y / view_.height;
    return Vec3{std::sin(azimuth) * std::sin(zenith), std::cos(azimuth) * std::sin(zenith),
                std::cos(zenith)};
  }
  const double right = x - view_.width / 2.0, up = view_.height / 2.0 - y;
  if (view_.projection == Projection::kRectilinear) {
    const Vec3 v{right, focal_px_, up};
    return v * (1.0 / Length(v));
  }
  const double r = std::hypot(right, up);
  if (r > rim_px_) return std::nullopt;
  const double theta = FisheyeTheta(r);
  const double aside = r > 0.0 ? std::sin(theta) / r : 0.0;
  return Vec3{right * aside, std::cos(theta), up * aside};
}

std::optional<std::array<double, 2>> PixelSolidAngles::PointOf(const Vec3& direction) const {
  const auto& [right, forward, up] = direction;
  const double width = view_.width, height = view_.height;
  if (view_.projection == Projection::kLatLong) {
    const double azimuth = std::atan2(right, forward);
    const double zenith = std::atan2(std::hypot(right, forward), up);
    return std::array{(azimuth / (2.0 * pi) + 0.5) * width, zenith / pi * height};
  }
  if (view_.projection == Projection::kRectilinear) {
    if (forward <= 0.0) return std::nullopt;
    const std::array at = {width / 2.0 + focal_px_ * right / forward,
                           height / 2.0 - focal_px_ * up / forward};
    const bool inside = at[0] >= 0.0 && at[0] <= width && at[1] >= 0.0 && at[1] <= height;
    return inside ? std::optional(at) : std::nullopt;
  }
  const double aside = std::hypot(right, up), theta = std::atan2(aside, forward);
  const double r = view_.projection == Projection::kEquidistant
                       ? focal_px_ * theta
                       : 2.0 * focal_px_ * std::sin(theta / 2.0);
  if (r > rim_px_) return std::nullopt;
  const double scale = aside > 0.0 ? r / aside : 0.0;
  return std::array{width / 2.0 + scale * right, height / 2.0 - scale * up};
}

double PixelSolidAngles::RimShare(double x, double y) const {
  if (view_.projection == Projection::kLatLong) return 0.0;
  const double r = std::hypot(x - view_.width / 2.0, y - view_.height / 2.0);
  if (view_.projection != Projection::kRectilinear) return r / rim_px_;
  return r / (std::hypot(view_.width, view_.height) / 2.0);
}

Radians PixelSolidAngles::MiddlePitch() const {
  if (view_.projection == Projection::kLatLong) return Radians(pi / view_.height);
  return Radians(1.0 / focal_px_);
}

}  // namespace lightcal
