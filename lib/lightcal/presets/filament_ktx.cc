// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/filament_ktx.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "lightcal/core/vec3.h"
#include "lightcal/presets/environment_files.h"
#include "lightcal/presets/gltf_cube_maps.h"
#include "lightcal/presets/gltf_light.h"

namespace lightcal {
namespace {

using KtxRgb = std::array<double, 3>;
constexpr int kKtxLevels = 4;
constexpr int kKtxFaces = 6;
constexpr int kLobeColumns = 128;   // of the picture, for lobes that are wide
constexpr double kWideAlpha = 0.1;  // from here on
constexpr int kNarrowSamples = 128;

void PutWord(std::uint32_t value, std::string& out) {
  for (int shift = 0; shift < 32; shift += 8) {
    out.push_back(static_cast<char>((value >> shift) & 0xFFU));
  }
}

KtxRgb SharpTowards(const EnvironmentPicture& picture, const Vec3& in_gltf) {
  return SmallRadianceTowards(picture, {in_gltf[0], -in_gltf[2], in_gltf[1]});
}

// One direction of the picture, in glTF's axes.
struct Beamlet {
  Vec3 from;
  KtxRgb radiance;
  double solid_angle = 0.0;
};

// Means of the picture in at most kLobeColumns columns.
std::vector<Beamlet> BeamletsOf(const EnvironmentPicture& picture) {
  const int step = std::max(1, picture.small_width / kLobeColumns);
  const int columns = picture.small_width / step, rows = picture.small_height / step;
  std::vector<Beamlet> out;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      Beamlet one;
      for (int y = j * step; y < (j + 1) * step; ++y) {
        const double part = std::sin(std::numbers::pi * (y + 0.5) / picture.small_height);
        for (int x = i * step; x < (i + 1) * step; ++x) {
          one.from =
              one.from +
              GltfFromZUp(PixelDirection(x, y, picture.small_width, picture.small_height)) * part;
          const double* p =
              picture.small.data() +
              3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.small_width) +
                   static_cast<std::size_t>(x));
          for (std::size_t k = 0; k < 3; ++k) one.radiance[k] += part * p[k];
          one.solid_angle += part;
        }
      }
      one.from = one.from * (1.0 / Length(one.from));
      for (double& v : one.radiance) v /= one.solid_angle;
      out.push_back(one);
    }
  }
  return out;
}

KtxRgb MeanOf(const KtxRgb& sum, double weight) {
  KtxRgb out{};
  for (std::size_t k = 0; k < 3; ++k) out[k] = weight > 0.0 ? std::max(0.0, sum[k] / weight) : 0.0;
  return out;
}

// Every direction by GGX's own density: the view is along the normal, half way is h.
KtxRgb WideLobe(const std::vector<Beamlet>& beamlets, const Vec3& normal, double alpha) {
  KtxRgb sum{};
  double weight = 0.0;
  for (const Beamlet& one : beamlets) {
    const double cosine = Dot(one.from, normal);
    if (cosine <= 0.0) continue;
    const double h2 = 0.5 * (1.0 + cosine);
    const double d = alpha / (h2 * (alpha * alpha - 1.0) + 1.0);
    const double w = d * d * cosine * one.solid_angle;
    weight += w;
    for (std::size_t k = 0; k < 3; ++k) sum[k] += w * one.radiance[k];
  }
  return MeanOf(sum, weight);
}

// Drawn from GGX, evenly.
KtxRgb NarrowLobe(const EnvironmentPicture& picture, const Vec3& normal, double alpha) {
  const Vec3 across = std::abs(normal[1]) < 0.9 ? Vec3{0.0, 1.0, 0.0} : Vec3{1.0, 0.0, 0.0};
  Vec3 x = Cross(across, normal);
  x = x * (1.0 / Length(x));
  const Vec3 y = Cross(normal, x);
  KtxRgb sum{};
  double weight = 0.0;
  for (int i = 0; i < kNarrowSamples; ++i) {
    constexpr double kGolden = 2.399963229728653;  // rad
    const double u = (i + 0.5) / kNarrowSamples;
    const double h2 = (1.0 - u) / (1.0 + (alpha * alpha - 1.0) * u);
    const double cosine = 2.0 * h2 - 1.0;  // of the angle doubled: the mirrored direction's
    if (cosine <= 0.0) continue;
    const double sine = std::sqrt(1.0 - cosine * cosine);
    const Vec3 towards =
        x * (sine * std::cos(kGolden * i)) + y * (sine * std::sin(kGolden * i)) + normal * cosine;
    const KtxRgb seen = SharpTowards(picture, towards);
    weight += cosine;
    for (std::size_t k = 0; k < 3; ++k) sum[k] += cosine * seen[k];
  }
  return MeanOf(sum, weight);
}

}  // namespace

std::string FilamentKtx(const EnvironmentPicture& picture, const std::string& harmonics) {
  constexpr std::uint32_t kHalfFloat = 0x140B, kRgba = 0x1908, kRgba16F = 0x881A;
  std::string data(1, 's');
  data += "h";
  data.push_back('\0');
  data += harmonics;
  data.push_back('\0');
  const std::size_t padded = (data.size() + 3) / 4 * 4;
  std::string out = "\xABKTX 11\xBB\r\n\x1A\n";
  for (const std::uint32_t word :
       {std::uint32_t{0x04030201}, kHalfFloat, std::uint32_t{2}, kRgba, kRgba16F, kRgba,
        static_cast<std::uint32_t>(kFilamentCubeSide),
        static_cast<std::uint32_t>(kFilamentCubeSide), std::uint32_t{0}, std::uint32_t{0},
        static_cast<std::uint32_t>(kKtxFaces), static_cast<std::uint32_t>(kKtxLevels),
        static_cast<std::uint32_t>(4 + padded), static_cast<std::uint32_t>(data.size())}) {
    PutWord(word, out);
  }
  data.resize(padded, '\0');
  out += data;
  const std::vector<Beamlet> beamlets = BeamletsOf(picture);
  for (int level = 0; level < kKtxLevels; ++level) {
    const int side = kFilamentCubeSide >> level;
    const double lod = static_cast<double>(level) / (kKtxLevels - 1);
    const double roughness = 1.0 - std::sqrt(1.0 - lod);
    const double alpha = roughness * roughness;
    PutWord(static_cast<std::uint32_t>(8 * side * side), out);
    for (int face = 0; face < kKtxFaces; ++face) {
      for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
          const Vec3 normal = TexelOfCube(face, (i + 0.5) / side, (j + 0.5) / side);
          const KtxRgb rgb = level == 0           ? SharpTowards(picture, normal)
                             : alpha > kWideAlpha ? WideLobe(beamlets, normal, alpha)
                                                  : NarrowLobe(picture, normal, alpha);
          for (const double v : rgb) AppendHalf(v, out);
          AppendHalf(1.0, out);
        }
      }
    }
  }
  return out;
}

}  // namespace lightcal
