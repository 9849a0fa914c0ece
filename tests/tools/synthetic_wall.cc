// SPDX-License-Identifier: Apache-2.0
#include "synthetic_wall.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <random>
#include <regex>

namespace lightcal::test {
namespace {

constexpr int kPoints = 4;  // along a pixel's side

Point3 Minus(const Point3& a, const Point3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double Inner(const Point3& a, const Point3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point3 Outer(const Point3& a, const Point3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point3 Unit(const Point3& a) {
  const double n = std::sqrt(Inner(a, a));
  return {a[0] / n, a[1] / n, a[2] / n};
}

struct Eye {
  Point3 right, down, ahead;
};

Eye EyeOf(const SyntheticWall& wall) {
  const Point3 ahead = Unit(Minus(wall.looks_at, wall.camera));
  const Point3 right0 = Unit(Outer(ahead, {0, 0, 1}));
  const Point3 down0 = Outer(ahead, right0);
  const double a = wall.roll_deg * std::numbers::pi / 180.0, c = std::cos(a), s = std::sin(a);
  Eye eye{.right = {}, .down = {}, .ahead = ahead};
  for (std::size_t i = 0; i < 3; ++i) {
    eye.right[i] = c * right0[i] + s * down0[i];
    eye.down[i] = c * down0[i] - s * right0[i];
  }
  return eye;
}

// Tangents of an undistorted ray, by repeated substitution.
std::array<double, 2> Ray(const SyntheticWall& wall, double px, double py) {
  const double u = (px - 0.5 * wall.width - wall.centre_x_off) / wall.focal_px;
  const double v = (py - 0.5 * wall.height - wall.centre_y_off) / wall.focal_px;
  double x = u, y = v;
  for (int i = 0; i < 40; ++i) {
    const double r2 = x * x + y * y;
    const double radial = 1.0 + wall.k1 * r2 + wall.k2 * r2 * r2;
    const double dx = 2.0 * wall.p1 * x * y, dy = wall.p1 * (r2 + 2.0 * y * y);
    const double before_x = x, before_y = y;
    x = (u - dx) / radial;
    y = (v - dy) / radial;
    if (x == before_x && y == before_y) break;  // and so for ever
  }
  return {x, y};
}

double ReflectanceAt(const SyntheticWall& wall, double x, double z) {
  const double mx = 0.5 * (wall.paper_width - wall.board_width);
  const double mz = 0.5 * (wall.paper_height - wall.board_height);
  const bool paper = x > -mx && x < wall.board_width + mx && z > -mz && z < wall.board_height + mz;
  if (!paper || wall.board.empty()) return wall.wall_reflectance;
  double reflectance = wall.paper_reflectance;
  for (const PrintedRectangle& r : wall.board) {
    if (x >= r.x && x < r.x + r.width && z >= r.z && z < r.z + r.height) {
      reflectance = r.black ? wall.ink_reflectance : wall.paper_reflectance;
    }
  }
  return reflectance;
}

struct Seen {
  double nits = 0.0;
  bool plain = true;  // wall, far enough from the sheet of paper
};

// The point (x, z) of the wall on a ray; absent where it misses.
std::optional<std::array<double, 2>> WallOn(const SyntheticWall& wall, const Eye& eye,
                                            const std::array<double, 2>& tangent) {
  Point3 ray{};
  for (std::size_t i = 0; i < 3; ++i) {
    ray[i] = eye.ahead[i] + tangent[0] * eye.right[i] + tangent[1] * eye.down[i];
  }
  if (ray[1] <= 1e-6) return std::nullopt;
  const double length = -wall.camera[1] / ray[1];
  return std::array{wall.camera[0] + length * ray[0], wall.camera[2] + length * ray[2]};
}

Seen LuminanceAlong(const SyntheticWall& wall, const Eye& eye, double px, double py) {
  const auto tangent = Ray(wall, px, py);
  const auto seen = WallOn(wall, eye, tangent);
  if (!seen) return {};
  const auto [x, z] = *seen;
  const Point3 beam = Minus({x, 0.0, z}, wall.lamp);
  const double r2 = Inner(beam, beam);
  const double incidence = beam[1] / std::sqrt(r2);
  double lux = wall.intensity(Unit(beam)) / r2 * incidence * (1.0 - wall.gloss * (1.0 - incidence));
  if (wall.other_lx) lux += wall.other_lx(x, z);
  const double off_axis = 1.0 / std::sqrt(1.0 + tangent[0] * tangent[0] + tangent[1] * tangent[1]);
  const double nits =
      ReflectanceAt(wall, x, z) / std::numbers::pi * lux * std::pow(off_axis, wall.vignetting);
  const double margin = 0.1;
  const bool plain = wall.board.empty() || x < -margin || x > wall.board_width + margin ||
                     z < -margin || z > wall.board_height + margin;
  return {nits, plain};
}

void Blur(std::vector<float>& picture, int width, int height, double sigma) {
  const int reach = static_cast<int>(3.0 * sigma) + 1;
  std::vector<double> weight;
  double sum = 0.0;
  for (int i = -reach; i <= reach; ++i) {
    sum += weight.emplace_back(std::exp(-0.5 * i * i / (sigma * sigma)));
  }
  const auto pass = [&](int dx, int dy) {
    const std::vector<float> from = picture;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        double value = 0.0;
        for (int i = -reach; i <= reach; ++i) {
          const int sx = std::clamp(x + i * dx, 0, width - 1);
          const int sy = std::clamp(y + i * dy, 0, height - 1);
          value += weight[static_cast<std::size_t>(i + reach)] *
                   double{from[static_cast<std::size_t>(sy) * width + sx]};
        }
        picture[static_cast<std::size_t>(y) * width + x] = static_cast<float>(value / sum);
      }
    }
  };
  pass(1, 0);
  pass(0, 1);
}

double Bell(double angle, double half_width) {
  const double x = angle / half_width;
  return std::exp(-std::numbers::ln2 * x * x);
}

constexpr double kDegrees = 180.0 / std::numbers::pi;

}  // namespace

double SpotInAGlow(const Point3& d) {
  const double angle = std::acos(std::clamp(d[1], -1.0, 1.0)) * kDegrees;
  return 780.0 * Bell(angle, 15.0) + 120.0 * std::max(0.0, d[1]);
}

double TwoLobes(const Point3& d) {
  const double x = std::atan2(d[0], d[1]) * kDegrees, z = std::atan2(d[2], d[1]) * kDegrees;
  return 500.0 * Bell(std::hypot(x - 10.0, (z + 4.0) / 1.5), 11.0) +
         300.0 * Bell(std::hypot(x + 14.0, z), 9.0) + 60.0 * std::max(0.0, d[1]);
}

std::array<int, 4> PixelsAround(const SyntheticWall& wall, double x, double z, double radius) {
  const Eye eye = EyeOf(wall);
  int left = wall.width, right = -1, top = wall.height, bottom = -1;
  for (int py = 0; py < wall.height; ++py) {
    for (int px = 0; px < wall.width; ++px) {
      const auto at = WallOn(wall, eye, Ray(wall, px + 0.5, py + 0.5));
      if (!at || std::hypot((*at)[0] - x, (*at)[1] - z) > radius) continue;
      left = std::min(left, px);
      right = std::max(right, px);
      top = std::min(top, py);
      bottom = std::max(bottom, py);
    }
  }
  return {left, top, right - left + 1, bottom - top + 1};
}

std::vector<float> PhotographWall(const SyntheticWall& wall) {
  const Eye eye = EyeOf(wall);
  std::vector<float> picture;
  for (int y = 0; y < wall.height; ++y) {
    for (int x = 0; x < wall.width; ++x) {
      const Seen middle = LuminanceAlong(wall, eye, x + 0.5, y + 0.5);
      double sum = middle.nits;
      if (!middle.plain) {
        sum = 0.0;
        for (int j = 0; j < kPoints; ++j) {
          for (int i = 0; i < kPoints; ++i) {
            sum += LuminanceAlong(wall, eye, x + (i + 0.5) / kPoints, y + (j + 0.5) / kPoints).nits;
          }
        }
        sum /= kPoints * kPoints;
      }
      picture.push_back(static_cast<float>(sum));
    }
  }
  if (wall.glare > 0.0) {
    double sum = 0.0;
    for (const float value : picture) sum += double{value};
    const auto veil = static_cast<float>(wall.glare * sum / static_cast<double>(picture.size()));
    for (float& value : picture) value += veil;
  }
  if (wall.blur_px > 0.0) Blur(picture, wall.width, wall.height, wall.blur_px);
  std::mt19937_64 random(wall.seed);
  std::normal_distribution<double> normal;
  for (float& value : picture) {
    value *= static_cast<float>(1.0 + wall.noise_relative * normal(random));
  }
  return picture;
}

std::vector<PrintedRectangle> RectanglesOfSvg(const std::string& svg) {
  // <g id="board" transform="translate(X Y) scale(S -S)"> holds them in metres; nothing else has
  // this class.
  static const std::regex kRectangle(
      "<rect class=\"(black|white)\" x=\"([^\"]+)\" y=\"([^\"]+)\" width=\"([^\"]+)\" "
      "height=\"([^\"]+)\"");
  std::vector<PrintedRectangle> out;
  for (std::sregex_iterator it(svg.begin(), svg.end(), kRectangle), end; it != end; ++it) {
    const std::smatch& m = *it;
    out.push_back(
        {std::stod(m[2]), std::stod(m[3]), std::stod(m[4]), std::stod(m[5]), m[1] == "black"});
  }
  return out;
}

ConeTruth TruthWithin(const SyntheticIntensity& intensity, const Point3& aim,
                      double half_angle_deg) {
  constexpr int kGamma = 1200, kAzimuth = 720;
  const Point3 a = Unit(aim);
  const Point3 x = Unit(std::abs(a[2]) < 0.9 ? Outer(a, {0, 0, 1}) : Outer(a, {1, 0, 0}));
  const Point3 y = Outer(a, x);
  const double end = half_angle_deg * std::numbers::pi / 180.0;
  ConeTruth truth;
  for (int i = 0; i < kGamma; ++i) {
    const double gamma = end * (i + 0.5) / kGamma;
    for (int j = 0; j < kAzimuth; ++j) {
      const double c = 2.0 * std::numbers::pi * (j + 0.5) / kAzimuth;
      Point3 d{};
      for (std::size_t k = 0; k < 3; ++k) {
        d[k] = std::cos(gamma) * a[k] + std::sin(gamma) * (std::cos(c) * x[k] + std::sin(c) * y[k]);
      }
      const double candela = intensity(d);
      truth.peak_cd = std::max(truth.peak_cd, candela);
      truth.flux_lm +=
          candela * std::sin(gamma) * (end / kGamma) * (2.0 * std::numbers::pi / kAzimuth);
    }
  }
  return truth;
}

}  // namespace lightcal::test
