// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/rgb_spaces.h"

#include <cmath>
#include <cstddef>

namespace lightcal {
namespace {

constexpr Xy kD65 = {0.3127, 0.3290};
constexpr std::array<RgbPrimaries, 4> kPrimaries = {{
    {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, kD65},
    {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, kD65},
    {{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, {0.32168, 0.33767}},
    {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, kD65},
}};

constexpr Matrix3 kBradford = {
    {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};

constexpr Column3 UnitY(Xy c) { return ColumnOf(XyzFromXyAtUnitY(c)); }

// The same direction as UnitY, where y may be 0: those of X and Z are.
constexpr Column3 Towards(Xy c) { return {c.x, c.y, 1.0 - c.x - c.y}; }

constexpr Matrix3 Derive(const RgbPrimaries& p) {
  const Column3 red = Towards(p.red), green = Towards(p.green), blue = Towards(p.blue);
  Matrix3 m{};
  for (std::size_t i = 0; i < 3; ++i) m[i] = {red[i], green[i], blue[i]};
  const Column3 luminance = Times(Inverse(m), UnitY(p.white));
  for (auto& row : m) {
    for (std::size_t j = 0; j < 3; ++j) row[j] *= luminance[j];
  }
  return m;
}

struct Matrices {
  Matrix3 to_xyz, from_xyz;
};
constexpr Matrices DeriveBoth(RgbSpace space) {
  const Matrix3 to_xyz = Derive(kPrimaries[static_cast<std::size_t>(space)]);
  return {to_xyz, Inverse(to_xyz)};
}
constexpr std::array<Matrices, 4> kMatrices = {
    DeriveBoth(RgbSpace::kSrgb), DeriveBoth(RgbSpace::kRec2020), DeriveBoth(RgbSpace::kAcescg),
    DeriveBoth(RgbSpace::kDisplayP3)};

const Matrices& MatricesOf(RgbSpace space) { return kMatrices[static_cast<std::size_t>(space)]; }

}  // namespace

RgbPrimaries PrimariesOf(RgbSpace space) { return kPrimaries[static_cast<std::size_t>(space)]; }
Matrix3 XyzFromRgbMatrix(RgbSpace space) { return MatricesOf(space).to_xyz; }
Matrix3 XyzFromRgbMatrix(const RgbPrimaries& primaries) { return Derive(primaries); }

bool SpanColors(const RgbPrimaries& p) {
  constexpr double kLeast = 1e-6, kMost = 100.0;  // the largest in use is below 2
  for (const Xy c : {p.red, p.green, p.blue, p.white}) {
    const bool ordinary = std::abs(c.x) < kMost && std::abs(c.y) < kMost;  // false for NaN
    if (!ordinary) return false;
  }
  const double area =
      (p.green.x - p.red.x) * (p.blue.y - p.red.y) - (p.blue.x - p.red.x) * (p.green.y - p.red.y);
  return std::abs(area) > kLeast && p.white.y > kLeast;
}

Matrix3 RgbFromXyzMatrix(RgbSpace space) { return MatricesOf(space).from_xyz; }

Rgb LinearRgbFromXyz(const Xyz& color, RgbSpace space) {
  const Column3 c = Times(MatricesOf(space).from_xyz, ColumnOf(color));
  return {c[0], c[1], c[2]};
}

Xyz XyzFromLinearRgb(const Rgb& color, RgbSpace space) {
  const Column3 c = Times(MatricesOf(space).to_xyz, {color.r, color.g, color.b});
  return {c[0], c[1], c[2]};
}

double LuminanceOfRgb(const Rgb& color, RgbSpace space) { return XyzFromLinearRgb(color, space).Y; }

Xyz AdaptBradford(const Xyz& color, Xy from, Xy to) {
  const Column3 source = Times(kBradford, UnitY(from));
  const Column3 target = Times(kBradford, UnitY(to));
  Column3 cones = Times(kBradford, ColumnOf(color));
  for (std::size_t i = 0; i < 3; ++i) cones[i] *= target[i] / source[i];
  const Column3 out = Times(Inverse(kBradford), cones);
  return {out[0], out[1], out[2]};
}

Xyz AdaptedToSpace(const Xyz& color, Xy scene_white, RgbSpace space) {
  const Xy own = PrimariesOf(space).white;
  const bool same = scene_white.x == own.x && scene_white.y == own.y;
  return same ? color : AdaptBradford(color, scene_white, own);
}

}  // namespace lightcal
