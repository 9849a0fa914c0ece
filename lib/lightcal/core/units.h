// SPDX-License-Identifier: Apache-2.0
// Strong units: one explicit wrapper per kind. Sums and scalings stay inside a kind; anything that
// joins kinds (I = E d^2 hides a steradian) is a named, cited function in photometry, never
// operator algebra.
#pragma once

#include <compare>
#include <numbers>

namespace lightcal {

template <class Kind>
class Quantity {
 public:
  constexpr Quantity() = default;
  constexpr explicit Quantity(double value) : value_(value) {}
  [[nodiscard]] constexpr double value() const { return value_; }

  constexpr auto operator<=>(const Quantity&) const = default;
  constexpr Quantity operator-() const { return Quantity(-value_); }
  friend constexpr Quantity operator+(Quantity a, Quantity b) {
    return Quantity(a.value_ + b.value_);
  }
  friend constexpr Quantity operator-(Quantity a, Quantity b) {
    return Quantity(a.value_ - b.value_);
  }
  friend constexpr Quantity operator*(Quantity a, double s) { return Quantity(a.value_ * s); }
  friend constexpr Quantity operator*(double s, Quantity a) { return a * s; }
  friend constexpr Quantity operator/(Quantity a, double s) { return Quantity(a.value_ / s); }
  // The ratio of two like quantities is a number.
  friend constexpr double operator/(Quantity a, Quantity b) { return a.value_ / b.value_; }

 private:
  double value_ = 0.0;
};

using Lux = Quantity<struct LuxKind>;                        // illuminance, lm/m^2
using Candela = Quantity<struct CandelaKind>;                // luminous intensity, lm/sr
using Lumens = Quantity<struct LumensKind>;                  // luminous flux
using Nits = Quantity<struct NitsKind>;                      // luminance, cd/m^2
using LumensPerSquareMetre = Quantity<struct ExitanceKind>;  // luminous exitance
using LumensPerWatt = Quantity<struct EfficacyKind>;
using Watts = Quantity<struct WattsKind>;  // radiant flux or electrical power
using Kelvin = Quantity<struct KelvinKind>;
using Mireds = Quantity<struct MiredsKind>;  // 1e6 / K
using Metres = Quantity<struct MetresKind>;
using SquareMetres = Quantity<struct SquareMetresKind>;
using Nanometres = Quantity<struct NanometresKind>;
using Radians = Quantity<struct RadiansKind>;
using Steradians = Quantity<struct SteradiansKind>;
using Seconds = Quantity<struct SecondsKind>;

inline constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

[[nodiscard]] constexpr Radians RadiansFromDegrees(double degrees) {
  return Radians(degrees * kRadiansPerDegree);
}
[[nodiscard]] constexpr double DegreesFromRadians(Radians angle) {
  return angle.value() * (180.0 / std::numbers::pi);
}
// Mired = 1e6 / T, T > 0; its own inverse.
[[nodiscard]] constexpr Mireds MiredsFromKelvin(Kelvin t) { return Mireds(1e6 / t.value()); }
[[nodiscard]] constexpr Kelvin KelvinFromMireds(Mireds m) { return Kelvin(1e6 / m.value()); }

}  // namespace lightcal
