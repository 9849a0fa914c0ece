// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/gltf_cube_maps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lightcal/presets/gltf_light.h"
#include "lightcal/presets/one_color_png.h"

namespace lightcal {
namespace {

constexpr int kBlurColumns = 128;
constexpr double kLeastOfLobe = 1e-6;
constexpr double kFarthestOfLobe = -13.9;  // an exponent below ln(kLeastOfLobe) = -13.82

// One place of the picture, its direction in glTF's axes.
struct PlaceOfPicture {
  Vec3 towards;
  double sin_zenith = 0.0;  // its solid angle, relative
  std::array<double, 3> radiance;
};

std::vector<PlaceOfPicture> PlacesOf(const EnvironmentPicture& picture) {
  const int w = picture.small_width, h = picture.small_height;
  const int step = std::max(1, w / kBlurColumns);
  std::vector<PlaceOfPicture> places;
  for (int y = step / 2; y < h; y += step) {
    const double sin_zenith = std::sin(std::numbers::pi * (y + 0.5) / h);
    for (int x = step / 2; x < w; x += step) {
      const double* p =
          picture.small.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(w) +
                                      static_cast<std::size_t>(x));
      places.push_back({GltfFromZUp(PixelDirection(x, y, w, h)), sin_zenith, {p[0], p[1], p[2]}});
    }
  }
  return places;
}

// The picture towards a direction of glTF's axes, blurred by a lobe as wide as a roughness makes
// it; a mirror shows its mean over a cone of that many radians.
std::array<double, 3> BlurredTowards(const std::vector<PlaceOfPicture>& places, const Vec3& towards,
                                     double sharpness) {
  std::array<double, 3> sum{};
  double weight = 0.0;
  for (const PlaceOfPicture& place : places) {
    const double exponent = sharpness * (Dot(place.towards, towards) - 1.0);
    if (exponent < kFarthestOfLobe) continue;
    const double lobe = std::exp(exponent) * place.sin_zenith;
    if (lobe < kLeastOfLobe) continue;
    weight += lobe;
    for (std::size_t c = 0; c < 3; ++c) sum[c] += lobe * place.radiance[c];
  }
  for (double& v : sum) v = weight > 0.0 ? std::max(0.0, v / weight) : 0.0;
  return sum;
}

}  // namespace

Vec3 TexelOfCube(int face, double s, double t) {
  const double a = 2.0 * s - 1.0, b = 2.0 * t - 1.0;
  const Vec3 faces[] = {{1.0, -b, -a}, {-1.0, -b, a}, {a, 1.0, b},
                        {a, -1.0, -b}, {a, -b, 1.0},  {-a, -b, -1.0}};
  return faces[face] * (1.0 / Length(faces[face]));
}

std::array<std::uint8_t, 4> RgbdOf(const std::array<double, 3>& radiance) {
  constexpr double kTop = 255.0;
  const double largest = std::max({radiance[0], radiance[1], radiance[2], 1.0});
  const double d = std::clamp(std::floor(kTop / largest), 1.0, kTop) / kTop;
  const double clipped = std::min(1.0, 1.0 / (largest * d));
  std::array<std::uint8_t, 4> out{};
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    out[i] = static_cast<std::uint8_t>(std::lround(kTop * SrgbEncoded(radiance[i] * d * clipped)));
  }
  out[3] = static_cast<std::uint8_t>(std::lround(kTop * d));
  return out;
}

std::vector<CubeMap> PrefilteredCube(const EnvironmentPicture& picture, int side) {
  int levels = 1;
  while ((side >> (levels - 1)) > 1) ++levels;
  std::vector<CubeMap> mips(static_cast<std::size_t>(levels));
  const std::vector<PlaceOfPicture> places = PlacesOf(picture);
  for (int level = 0; level < levels; ++level) {
    const int width = side >> level;
    const double roughness = std::max(0.2, static_cast<double>(level) / (levels - 1));
    const double sharpness = 2.0 / std::pow(roughness, 4);
    CubeMap& mip = mips[static_cast<std::size_t>(level)];
    for (int face = 0; face < 6; ++face) {
      std::vector<std::array<std::uint8_t, 4>> texels;
      for (int j = 0; j < width; ++j) {
        for (int i = 0; i < width; ++i) {
          texels.push_back(RgbdOf(BlurredTowards(
              places, TexelOfCube(face, (i + 0.5) / width, (j + 0.5) / width), sharpness)));
        }
      }
      mip[static_cast<std::size_t>(face)] = PngOfTexels(width, texels);
    }
  }
  return mips;
}

}  // namespace lightcal
