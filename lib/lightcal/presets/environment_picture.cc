// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/environment_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/core/even_directions.h"
#include "lightcal/core/matrix3.h"

namespace lightcal {
namespace {

constexpr double kPi = std::numbers::pi;

// Calls visit(PixelDirection, PixelSolidAngle, rgb) for every pixel of the small picture, asking
// for sines once a row and once a column.
template <class Visit>
void ForSmallPixels(const EnvironmentPicture& picture, const Visit& visit) {
  const int w = picture.small_width, h = picture.small_height;
  struct Azimuth {
    double sine = 0.0, cosine = 0.0;
  };
  std::vector<Azimuth> columns;
  for (int x = 0; x < w; ++x) {
    const double azimuth = 2.0 * kPi * ((x + 0.5) / w - 0.5);
    columns.push_back({std::sin(azimuth), std::cos(azimuth)});
  }
  const double* rgb = picture.small.data();
  for (int y = 0; y < h; ++y) {
    const double omega = PixelSolidAngle(y, w, h);
    const double zenith = kPi * (y + 0.5) / h;
    const double aside = std::sin(zenith), up = std::cos(zenith);
    for (const Azimuth& column : columns) {
      visit(Vec3{aside * column.sine, aside * column.cosine, up}, omega, rgb);
      rgb += 3;
    }
  }
}

template <class Value>
Column3 BilinearTowards(const std::vector<Value>& rgb, int width, int height, const Vec3& w) {
  const double zenith = std::acos(std::clamp(w[2], -1.0, 1.0));
  const double x = (std::atan2(w[0], w[1]) / (2.0 * kPi) + 0.5) * width - 0.5;
  const double y = std::clamp(zenith / kPi * height - 0.5, 0.0, height - 1.0);
  const double left = std::floor(x), top = std::min(std::floor(y), height - 2.0);
  const auto at = [&](double column, double row) {
    const int c = ((static_cast<int>(column) % width) + width) % width;
    return rgb.data() +
           3 * (static_cast<std::size_t>(std::max(0.0, row)) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(c));
  };
  Column3 out{};
  const double fx = x - left, fy = y - std::max(0.0, top);
  for (std::size_t c = 0; c < 3; ++c) {
    out[c] =
        (double{at(left, top)[c]} * (1.0 - fx) + double{at(left + 1.0, top)[c]} * fx) * (1.0 - fy) +
        (double{at(left, top + 1.0)[c]} * (1.0 - fx) + double{at(left + 1.0, top + 1.0)[c]} * fx) *
            fy;
  }
  return out;
}

// The nine of Harmonics, in a direction.
std::array<double, 9> BasisOf(const Vec3& d) {
  const double k0 = 0.5 * std::sqrt(1.0 / kPi), k1 = std::sqrt(3.0 / (4.0 * kPi));
  const double k2 = std::sqrt(15.0 / (4.0 * kPi)), k20 = 0.25 * std::sqrt(5.0 / kPi);
  return {k0,
          k1 * d[1],
          k1 * d[2],
          k1 * d[0],
          k2 * d[0] * d[1],
          k2 * d[1] * d[2],
          k20 * (3.0 * d[2] * d[2] - 1.0),
          k2 * d[0] * d[2],
          0.5 * k2 * (d[0] * d[0] - d[1] * d[1])};
}

}  // namespace

Vec3 PixelDirection(int x, int y, int width, int height) {
  const double azimuth = 2.0 * kPi * ((x + 0.5) / width - 0.5);
  const double zenith = kPi * (y + 0.5) / height;
  return {std::sin(zenith) * std::sin(azimuth), std::sin(zenith) * std::cos(azimuth),
          std::cos(zenith)};
}

double PixelSolidAngle(int y, int width, int height) {
  return 2.0 * kPi / width * (std::cos(kPi * y / height) - std::cos(kPi * (y + 1) / height));
}

std::array<double, 3> RadianceTowards(const EnvironmentPicture& picture, const Vec3& direction) {
  return BilinearTowards(picture.rgb, picture.width, picture.height, direction);
}

std::array<double, 3> SmallRadianceTowards(const EnvironmentPicture& picture,
                                           const Vec3& direction) {
  return BilinearTowards(picture.small, picture.small_width, picture.small_height, direction);
}

void EnvironmentPicture::Reduce() {
  const int step = std::max(1, width / kSmallWidth);
  small_width = width / step;
  small_height = height / step;
  small.assign(3 * static_cast<std::size_t>(small_width) * static_cast<std::size_t>(small_height),
               0.0);
  std::vector<double> weight(static_cast<std::size_t>(small_height), 0.0);
  for (int y = 0; y < small_height * step; ++y) {
    const double omega = PixelSolidAngle(y, width, height);
    weight[static_cast<std::size_t>(y / step)] += omega * step;
    for (int x = 0; x < small_width * step; ++x) {
      const std::size_t to =
          3 * (static_cast<std::size_t>(y / step) * static_cast<std::size_t>(small_width) +
               static_cast<std::size_t>(x / step));
      const std::size_t from = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                    static_cast<std::size_t>(x));
      for (std::size_t c = 0; c < 3; ++c) small[to + c] += omega * double{rgb[from + c]};
    }
  }
  for (std::size_t i = 0; i < small.size(); ++i) {
    small[i] /= weight[i / 3 / static_cast<std::size_t>(small_width)];
  }
}

Vec3 IrradianceOn(const EnvironmentPicture& picture, const Vec3& normal) {
  return IrradianceOn(picture, std::span(&normal, 1)).front();
}

std::vector<Vec3> IrradianceOn(const EnvironmentPicture& picture, std::span<const Vec3> normals) {
  std::vector<Vec3> sums(normals.size());
  ForSmallPixels(picture, [&](const Vec3& direction, double omega, const double* rgb) {
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const double cosine = Dot(normals[i], direction);
      if (cosine <= 0.0) continue;
      for (std::size_t c = 0; c < 3; ++c) sums[i][c] += omega * cosine * rgb[c];
    }
  });
  return sums;
}

Harmonics RadianceHarmonics(const EnvironmentPicture& picture, Vec3 (*turn)(const Vec3&)) {
  Harmonics out{};
  ForSmallPixels(picture, [&](const Vec3& direction, double omega, const double* rgb) {
    const auto basis = BasisOf(turn(direction));
    for (std::size_t i = 0; i < out.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) out[i][c] += omega * basis[i] * rgb[c];
    }
  });
  return out;
}

Vec3 IrradianceOn(const Harmonics& radiance, const Vec3& normal) {
  Vec3 sum{};
  const auto basis = BasisOf(normal);
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    const double band = i == 0 ? kPi : i < 4 ? 2.0 * kPi / 3.0 : kPi / 4.0;
    sum = sum + radiance[i] * (band * basis[i]);
  }
  return sum;
}

HarmonicsError WorstOfHarmonics(const EnvironmentPicture& picture) {
  constexpr int kRound = 200;
  constexpr double kDark = 1e-3;  // of the brightest normal: where nothing is lit
  std::vector<Vec3> normals = {{0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {1, 0, 0}, {0, -1, 0}, {-1, 0, 0}};
  for (int i = 0; i < kRound; ++i) normals.push_back(EvenDirection(i, kRound));
  const auto luminance = [](const Vec3& rgb) {
    return LuminanceOfRgb({rgb[0], rgb[1], rgb[2]}, RgbSpace::kSrgb);
  };
  std::vector<double> own;
  for (const Vec3& rgb : IrradianceOn(picture, normals)) own.push_back(luminance(rgb));
  const Harmonics harmonics = RadianceHarmonics(picture, [](const Vec3& ours) { return ours; });
  HarmonicsError worst;
  const double least = kDark * *std::ranges::max_element(own);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (!(own[i] > least)) continue;
    const HarmonicsError here{normals[i], own[i], luminance(IrradianceOn(harmonics, normals[i]))};
    if (std::abs(here.relative()) > std::abs(worst.relative())) worst = here;
  }
  return worst;
}

}  // namespace lightcal
