// SPDX-License-Identifier: Apache-2.0
#include "synthetic_camera.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <set>

namespace lightcal::test {
namespace {

// xoshiro256++ (Blackman, Vigna 2018), seeded by splitmix64: the same numbers everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) {
    for (auto& word : state_) {
      seed += 0x9E3779B97F4A7C15U;
      std::uint64_t z = seed;
      z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9U;
      z = (z ^ z >> 27) * 0x94D049BB133111EBU;
      word = z ^ z >> 31;
    }
  }
  // In (0, 1).
  double Uniform() {
    auto& s = state_;
    const std::uint64_t result = Rotate(s[0] + s[3], 23) + s[0];
    const std::uint64_t t = s[1] << 17;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= t;
    s[3] = Rotate(s[3], 45);
    return (static_cast<double>(result >> 11) + 0.5) * 0x1.0p-53;
  }
  // Marsaglia's polar method.
  double Normal() {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    double u = 0.0, v = 0.0, s = 0.0;
    do {
      u = 2.0 * Uniform() - 1.0;
      v = 2.0 * Uniform() - 1.0;
      s = u * u + v * v;
    } while (s >= 1.0 || s == 0.0);
    const double scale = std::sqrt(-2.0 * std::log(s) / s);
    spare_ = v * scale;
    has_spare_ = true;
    return u * scale;
  }
  // Exact below 50 (products of uniforms); above, the normal law with its Cornish-Fisher skewness
  // term, whose mean, variance and skewness are those of Poisson's law.
  double Poisson(double mean) {
    if (mean <= 0.0) return 0.0;
    if (mean < 50.0) {
      const double stop = std::exp(-mean);
      int count = 0;
      for (double product = Uniform(); product > stop; product *= Uniform()) ++count;
      return count;
    }
    const double z = Normal();
    return std::max(0.0, std::round(mean + std::sqrt(mean) * z + (z * z - 1.0) / 6.0));
  }

 private:
  static std::uint64_t Rotate(std::uint64_t x, int k) { return x << k | x >> (64 - k); }
  std::array<std::uint64_t, 4> state_{};
  double spare_ = 0.0;
  bool has_spare_ = false;
};

constexpr double kKneeFrom = 0.8;

// A parabola up to where it would turn down again; level from there, as more light is never darker.
double Knee(double electrons, double full_well, double missing) {
  if (missing <= 0.0) return electrons;
  const double top = (1.0 - kKneeFrom) / (2.0 * missing);
  const double into = (electrons / full_well - kKneeFrom) / (1.0 - kKneeFrom);
  if (into <= 0.0) return electrons;
  if (into >= top) return full_well * (kKneeFrom + missing * top * top);
  return electrons - missing * full_well * into * into;
}

// Fujifilm's X-Trans, as DNG converters write it.
constexpr int kXTrans[6][6] = {{1, 1, 0, 1, 1, 2}, {1, 1, 2, 1, 1, 0}, {2, 0, 1, 0, 2, 1},
                               {1, 1, 2, 1, 1, 0}, {1, 1, 0, 1, 1, 2}, {0, 2, 1, 2, 0, 1}};

}  // namespace

SyntheticCamera FlawedCamera(int width, int height) {
  SyntheticCamera camera;
  camera.width = width;
  camera.height = height;
  camera.prnu_relative = 0.005;
  camera.knee_relative = 0.01;
  camera.row_noise_e = 0.5;
  return camera;
}

int FilterAt(const SyntheticCamera& camera, int x, int y) {
  return camera.x_trans ? kXTrans[y % 6][x % 6] : (x & 1) + (y & 1);
}

SyntheticXyz XyzOf(double luminance_nits, double x, double y) {
  return {luminance_nits * x / y, luminance_nits, luminance_nits * (1.0 - x - y) / y};
}

double SaturatingNits(const SyntheticCamera& camera, const SyntheticExposure& exposure) {
  const double n = exposure.true_f_number;
  return 78.0 * n * n / (camera.lens_q * exposure.iso * exposure.true_time_s * camera.sensitivity);
}

std::vector<std::uint16_t> Expose(const SyntheticCamera& camera, const SyntheticExposure& exposure,
                                  const SyntheticScene& scene) {
  const double full_well = camera.full_well_e * camera.base_iso / exposure.iso;
  const double electrons_per_nit = full_well / SaturatingNits(camera, exposure);
  const double dn_per_electron = (camera.white_dn - camera.black_dn) / full_well;
  const std::set<std::array<int, 2>> hot(camera.hot_pixels.begin(), camera.hot_pixels.end());
  Random gains(camera.pixel_seed), random(exposure.seed);

  std::vector<std::uint16_t> picture;
  picture.reserve(static_cast<std::size_t>(camera.width) * camera.height);
  for (int y = 0; y < camera.height; ++y) {
    const double row_offset = camera.row_noise_e > 0.0 ? camera.row_noise_e * random.Normal() : 0.0;
    for (int x = 0; x < camera.width; ++x) {
      const SyntheticXyz c = scene(x, y);
      const int color = FilterAt(camera, x, y);
      const auto& row = camera.camera_from_xyz[color];
      double response = camera.monochrome ? c.Y : row[0] * c.X + row[1] * c.Y + row[2] * c.Z;
      response *= exposure.filter[color];
      if (camera.lens) response *= camera.lens(x, y, color);
      const double dark_e =
          exposure.true_time_s * (hot.contains({x, y}) ? camera.hot_e_per_s : camera.dark_e_per_s);
      double electrons = random.Poisson(electrons_per_nit * response + dark_e);
      if (camera.prnu_relative > 0.0) electrons *= 1.0 + camera.prnu_relative * gains.Normal();
      electrons = std::min(Knee(electrons, full_well, camera.knee_relative), full_well);
      electrons += camera.read_noise_e * random.Normal() + row_offset;
      const double black = camera.black_dn + camera.black_error_dn[color];
      const double dn = std::round(black + dn_per_electron * electrons);
      picture.push_back(static_cast<std::uint16_t>(std::clamp(dn, 0.0, camera.white_dn)));
    }
  }
  return picture;
}

double DialLabel(double true_time_s) {
  constexpr double kSpeeds[] = {1,    1.25, 1.6,  2,    2.5,  3,    4,    5,    6,    8,
                                10,   13,   15,   20,   25,   30,   40,   50,   60,   80,
                                100,  125,  160,  200,  250,  320,  400,  500,  640,  800,
                                1000, 1250, 1600, 2000, 2500, 3200, 4000, 5000, 6400, 8000};
  constexpr double kTimes[] = {1, 1.3, 1.6, 2, 2.5, 3.2, 4, 5, 6, 8, 10, 13, 15, 20, 25, 30};
  const int thirds = static_cast<int>(std::lround(3.0 * std::log2(true_time_s)));
  return thirds > 0 ? kTimes[std::min<std::size_t>(thirds, std::size(kTimes) - 1)]
                    : 1.0 / kSpeeds[std::min<std::size_t>(-thirds, std::size(kSpeeds) - 1)];
}

std::vector<SyntheticExposure> ExposureSeries(double shortest_s, int frames, double stops,
                                              double f_number, double jitter_relative,
                                              std::uint64_t seed) {
  Random random(seed);
  std::vector<SyntheticExposure> series;
  for (int i = 0; i < frames; ++i) {
    const double nominal = shortest_s * std::exp2(stops * i);
    SyntheticExposure exposure;
    exposure.label_time_s = DialLabel(nominal);
    exposure.true_time_s = nominal * (1.0 + jitter_relative * random.Normal());
    exposure.true_f_number = exposure.label_f_number = f_number;
    exposure.seed = seed * 1000 + static_cast<std::uint64_t>(i) + 1;
    series.push_back(exposure);
  }
  return series;
}

int StepWedge::PatchAt(int px, int py) const {
  const int count = static_cast<int>(nits.size());
  const int rows = (count + columns - 1) / columns;
  const int patch = py * rows / height * columns + px * columns / width;
  return std::min(patch, count - 1);
}

SyntheticScene StepWedge::Scene() const {
  return [wedge = *this](int px, int py) {
    return XyzOf(wedge.nits[wedge.PatchAt(px, py)], wedge.x, wedge.y);
  };
}

std::vector<double> LogSteps(double lowest_nits, double highest_nits, int count) {
  std::vector<double> steps;
  const double ratio = highest_nits / lowest_nits;
  for (int i = 0; i < count; ++i) {
    steps.push_back(lowest_nits * std::pow(ratio, i / static_cast<double>(count - 1)));
  }
  return steps;
}

}  // namespace lightcal::test
