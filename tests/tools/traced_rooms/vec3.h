// SPDX-License-Identifier: Apache-2.0
// Vectors and random numbers of the traced rooms; the same on every machine.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace traced_rooms {

inline constexpr double kPi = 3.14159265358979323846;

using Vec3 = std::array<double, 3>;

inline Vec3 operator+(const Vec3& a, const Vec3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vec3 operator-(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vec3 operator*(double s, const Vec3& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double Dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double Length(const Vec3& a) { return std::sqrt(Dot(a, a)); }
inline Vec3 Unit(const Vec3& a) { return (1.0 / Length(a)) * a; }
inline Vec3 Cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Two unit vectors that make a right-handed frame with the unit vector `w`.
struct Frame {
  Vec3 u, v, w;
  explicit Frame(const Vec3& axis) : w(axis) {
    const Vec3 other = std::abs(axis[2]) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
    u = Unit(Cross(other, w));
    v = Cross(w, u);
  }
  Vec3 At(double x, double y, double z) const { return x * u + y * v + z * w; }
};

// xoshiro256+ seeded by splitmix64 (Blackman and Vigna, public domain); std's distributions differ
// between libraries, these do not.
class Random {
 public:
  explicit Random(std::uint64_t seed) {
    for (auto& word : state_) {
      seed += 0x9e3779b97f4a7c15ULL;
      std::uint64_t z = seed;
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
      word = z ^ (z >> 31);
    }
  }
  // In [0, 1).
  double Share() {
    const std::uint64_t sum = state_[0] + state_[3];
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = (state_[3] << 45) | (state_[3] >> 19);
    return static_cast<double>(sum >> 11) * 0x1p-53;
  }
  double Between(double low, double high) { return low + (high - low) * Share(); }
  double LogBetween(double low, double high) { return low * std::pow(high / low, Share()); }
  int Below(int count) { return static_cast<int>(count * Share()); }

 private:
  std::array<std::uint64_t, 4> state_{};
};

inline Vec3 CosineDirection(const Vec3& normal, Random& random) {
  const double radius = std::sqrt(random.Share());
  const double turn = 2.0 * kPi * random.Share();
  return Frame(normal).At(radius * std::cos(turn), radius * std::sin(turn),
                          std::sqrt(std::fmax(0.0, 1.0 - radius * radius)));
}

}  // namespace traced_rooms
