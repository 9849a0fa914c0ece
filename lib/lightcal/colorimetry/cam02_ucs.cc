// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/cam02_ucs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lightcal {
namespace {

constexpr Matrix3 kCat02 = {
    {{0.7328, 0.4296, -0.1624}, {-0.7036, 1.6975, 0.0061}, {0.0030, 0.0136, 0.9834}}};
// Hunt-Pointer-Estevez cone responses from CAT02's: M_HPE M_CAT02^-1.
constexpr Matrix3 kConeFromCat02 = {
    {{0.7409790970135309, 0.2180251556757357, 0.04100574731073359},
     {0.28535329168588003, 0.6242015741188158, 0.0904451341953042},
     {-0.009627608738429355, -0.00569803121611342, 1.0153256399545427}}};

constexpr double kAdaptingLuminance = 100.0;  // cd/m2
constexpr double kBackgroundY = 20.0;
constexpr double kSurroundC = 0.69;
constexpr double kOffset = 0.1;

// What the viewing conditions alone decide.
struct Conditions {
  double luminance_level;  // F_L
  double background_n;     // Y_b / Y_w
  double background;       // N_bb = N_cb
  double exponent;         // c z
  double chroma_factor;    // (1.64 - 0.29^n)^0.73
  double colorfulness;     // F_L^0.25
};

Conditions MakeConditions() {
  constexpr double five = 5.0 * kAdaptingLuminance;
  const double k = 1.0 / (five + 1.0);
  const double k4 = k * k * k * k;
  Conditions v{};
  v.luminance_level = 0.2 * k4 * five + 0.1 * (1.0 - k4) * (1.0 - k4) * std::cbrt(five);
  v.background_n = kBackgroundY / 100.0;
  v.background = 0.725 * std::pow(1.0 / v.background_n, 0.2);
  v.exponent = kSurroundC * (1.48 + std::sqrt(v.background_n));
  v.chroma_factor = std::pow(1.64 - std::pow(0.29, v.background_n), 0.73);
  v.colorfulness = std::pow(v.luminance_level, 0.25);
  return v;
}

const Conditions& Viewing() {
  static const Conditions conditions = MakeConditions();
  return conditions;
}

// The cones' response to an adapted stimulus x = F_L R' / 100; odd in x.
double Compressed(double x) {
  const double power = std::pow(std::abs(x), 0.42);
  return std::copysign(400.0 * power / (power + 27.13), x) + kOffset;
}

Column3 Responses(const Matrix3& cone_from_xyz, const Xyz& color) {
  Column3 r = Times(cone_from_xyz, ColumnOf(color));
  for (double& each : r) each = Compressed(each);
  return r;
}

double Achromatic(const Column3& r) {
  return (2.0 * r[0] + r[1] + r[2] / 20.0 - 0.305) * Viewing().background;
}

}  // namespace

Cam02UcsUnder::Cam02UcsUnder(const Xyz& white) {
  const Column3 w = Times(kCat02, ColumnOf(white));
  const double level = Viewing().luminance_level / 100.0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) {
        cone_from_xyz_[i][j] += level * kConeFromCat02[i][k] * white.Y / w[k] * kCat02[k][j];
      }
    }
  }
  white_response_ = Achromatic(Responses(cone_from_xyz_, white));
}

Cam02Ucs Cam02UcsUnder::Of(const Xyz& color) const {
  const Conditions& v = Viewing();
  const Column3 r = Responses(cone_from_xyz_, color);
  const double a = r[0] - 12.0 * r[1] / 11.0 + r[2] / 11.0;
  const double b = (r[0] + r[1] - 2.0 * r[2]) / 9.0;
  const double length = std::hypot(a, b);
  const double lightness =
      std::pow(std::max(Achromatic(r), 0.0) / white_response_, v.exponent);  // J / 100
  const double J = 100.0 * lightness;
  Cam02Ucs ucs{1.7 * J / (1.0 + 0.007 * J), 0.0, 0.0};
  const double sum = r[0] + r[1] + 1.05 * r[2];
  if (!(length > 0.0 && sum > 0.0)) return ucs;
  const double cosine = a / length;
  const double sine = b / length;
  // 1/4 (cos(h + 2 rad) + 3.8)
  const double eccentricity = 0.25 * (cosine * std::cos(2.0) - sine * std::sin(2.0) + 3.8);
  const double t = 50000.0 / 13.0 * v.background * eccentricity * length / sum;
  const double M = std::pow(t, 0.9) * std::sqrt(lightness) * v.chroma_factor * v.colorfulness;
  const double compressed = std::log1p(0.0228 * M) / 0.0228;
  ucs.a = compressed * cosine;
  ucs.b = compressed * sine;
  return ucs;
}

}  // namespace lightcal
