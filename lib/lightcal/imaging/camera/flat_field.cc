// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/camera/flat_field.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "lightcal/core/numbers_text.h"

namespace lightcal {
namespace {

constexpr int kColumns = 48, kRows = 32;
constexpr double kCenterPrior = 0.05;
constexpr double kMostUneven = 0.03;
constexpr double kLeastLight = 0.02;  // of the axis, anywhere in the picture
constexpr int kRejectPasses = 12;
constexpr double kSameAperture = 0.06;  // of ln N
constexpr double kSameFocus = 0.02;     // of ln f
constexpr int kRings = 32;

struct Block {
  FlatPlace place;
  std::array<double, 3> light{};
};

std::vector<Block> BlocksOf(View2d<const float> raw) {
  std::vector<Block> blocks;
  for (int j = 0; j < kRows; ++j) {
    const int top = raw.height() * j / kRows, bottom = raw.height() * (j + 1) / kRows;
    for (int i = 0; i < kColumns; ++i) {
      const int left = raw.width() * i / kColumns, right = raw.width() * (i + 1) / kColumns;
      Block block;
      block.place =
          FlatPlaceOf(0.5 * (left + right), 0.5 * (top + bottom), raw.width(), raw.height());
      for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) {
          for (int c = 0; c < 3; ++c) block.light[static_cast<std::size_t>(c)] += raw(x, y, c);
        }
      }
      const double count = static_cast<double>(right - left) * (bottom - top);
      for (double& light : block.light) light /= count;
      blocks.push_back(block);
    }
  }
  return blocks;
}

double RadiusSquared(FlatPlace place, const std::array<double, 2>& center) {
  const double x = place.x - center[0], y = place.y - center[1];
  return x * x + y * y;
}

// p0 + p1 r^2 + p2 r^4 + p3 r^6 of one channel, and what it leaves.
struct RadialFit {
  std::array<double, 4> p{};
  double rms = 0.0;  // relative to p0
};

RadialFit FitRadial(const std::vector<Block>& blocks, std::size_t channel,
                    const std::array<double, 2>& center) {
  const auto n = static_cast<Eigen::Index>(blocks.size());
  Eigen::MatrixXd terms(n, 4);
  Eigen::VectorXd light(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Block& block = blocks[static_cast<std::size_t>(i)];
    const double r2 = RadiusSquared(block.place, center);
    terms.row(i) << 1.0, r2, r2 * r2, r2 * r2 * r2;
    light[i] = block.light[channel];
  }
  const Eigen::VectorXd p = terms.colPivHouseholderQr().solve(light);
  const Eigen::VectorXd left = light - terms * p;
  RadialFit fit;
  for (std::size_t k = 0; k < 4; ++k) fit.p[k] = p[static_cast<Eigen::Index>(k)];
  fit.rms = std::sqrt(left.squaredNorm() / static_cast<double>(n - 4)) / p[0];
  return fit;
}

// Gauss-Newton on the centre alone, the polynomial following.
std::array<double, 2> FindCenter(const std::vector<Block>& blocks) {
  std::array<double, 2> center{0.0, 0.0};
  for (int pass = 0; pass < kRejectPasses; ++pass) {
    const RadialFit fit = FitRadial(blocks, 1, center);
    const double sigma = std::max(fit.rms * fit.p[0], 1e-12 * fit.p[0]);
    Eigen::Matrix2d normal =
        Eigen::Matrix2d::Identity() * (sigma * sigma / (kCenterPrior * kCenterPrior));
    Eigen::Vector2d right(-center[0] * normal(0, 0), -center[1] * normal(1, 1));
    for (const Block& block : blocks) {
      const double x = block.place.x - center[0], y = block.place.y - center[1];
      const double r2 = x * x + y * y;
      const double model = fit.p[0] + r2 * (fit.p[1] + r2 * (fit.p[2] + r2 * fit.p[3]));
      const double slope = -2.0 * (fit.p[1] + r2 * (2.0 * fit.p[2] + r2 * 3.0 * fit.p[3]));
      const Eigen::Vector2d gradient(slope * x, slope * y);
      normal += gradient * gradient.transpose();
      right += gradient * (block.light[1] - model);
    }
    const Eigen::Vector2d step = normal.ldlt().solve(right);
    for (int k = 0; k < 2; ++k) {
      auto& at = center[static_cast<std::size_t>(k)];
      at = std::clamp(at + step[k], -0.3, 0.3);
    }
    if (step.norm() < 1e-7) break;
  }
  return center;
}

// Mean over the disc of the difference of two flats' green light, squared and rooted.
double MeanDifference(const CameraFlat& a, const CameraFlat& b) {
  double sum = 0.0, weight = 0.0;
  for (int i = 0; i < kRings; ++i) {
    const double r = (i + 0.5) / kRings;
    const double off = LightThrough(a, 1, {a.center[0] + r, a.center[1]}) -
                       LightThrough(b, 1, {b.center[0] + r, b.center[1]});
    sum += r * off * off;
    weight += r;
  }
  return std::sqrt(sum / weight);
}

CameraFlat Between(const CameraFlat& a, const CameraFlat& b, double f_number) {
  const double share = std::log(f_number / a.f_number) / std::log(b.f_number / a.f_number);
  const auto mix = [share](double x, double y) { return x + share * (y - x); };
  CameraFlat flat = a;
  flat.f_number = f_number;
  for (std::size_t k = 0; k < 2; ++k) flat.center[k] = mix(a.center[k], b.center[k]);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t k = 0; k < 3; ++k) {
      flat.channels[c][k] = mix(a.channels[c][k], b.channels[c][k]);
    }
  }
  flat.sigma_relative =
      std::hypot(std::max(a.sigma_relative, b.sigma_relative), 0.5 * MeanDifference(a, b));
  return flat;
}

}  // namespace

FlatPlace FlatPlaceOf(double x_px, double y_px, int width, int height) {
  const double half_diagonal = 0.5 * std::hypot(width, height);
  return {(x_px - 0.5 * width) / half_diagonal, (y_px - 0.5 * height) / half_diagonal};
}

double LightThrough(const CameraFlat& flat, std::size_t channel, FlatPlace place) {
  const double r2 = RadiusSquared(place, flat.center);
  const auto& [a, b, c] = flat.channels[channel];
  return 1.0 + r2 * (a + r2 * (b + r2 * c));
}

bool LetsLightThrough(const CameraFlat& flat, int width, int height) {
  for (int j = 0; j <= kRows; ++j) {
    for (int i = 0; i <= kColumns; ++i) {
      const FlatPlace place =
          FlatPlaceOf(1.0 * width * i / kColumns, 1.0 * height * j / kRows, width, height);
      for (std::size_t c = 0; c < 3; ++c) {
        if (!(LightThrough(flat, c, place) > kLeastLight)) return false;
      }
    }
  }
  return true;
}

Result<CameraFlat> FitFlatField(View2d<const float> raw, double f_number,
                                std::optional<Metres> focal_length) {
  if (raw.width() < 2 * kColumns || raw.height() < 2 * kRows || raw.channels() != 3) {
    return Refused("too_small", "flat", "a flat field needs a colour picture of 96 x 64 pixels");
  }
  const std::vector<Block> blocks = BlocksOf(raw);
  double brightest = 0.0;
  for (const Block& block : blocks) brightest = std::max(brightest, block.light[1]);
  for (const Block& block : blocks) {
    if (!(*std::ranges::min_element(block.light) > 0.0) ||
        !(block.light[1] > kLeastLight * brightest)) {
      return Refused("flat_too_dark", "flat",
                     "parts of the picture hold no light; the evenly lit surface must fill it");
    }
  }
  CameraFlat flat;
  flat.f_number = f_number;
  flat.focal_length = focal_length;
  flat.center = FindCenter(blocks);
  for (std::size_t c = 0; c < 3; ++c) {
    const RadialFit fit = FitRadial(blocks, c, flat.center);
    for (std::size_t k = 0; k < 3; ++k) flat.channels[c][k] = fit.p[k + 1] / fit.p[0];
    // Green decides: red or blue alone may be near their noise.
    if (c == 1) flat.sigma_relative = fit.rms;
  }
  if (!(flat.sigma_relative < kMostUneven)) {
    return Refused("flat_uneven", "flat",
                   "what is left after a round loss of light is " +
                       PercentText(flat.sigma_relative) +
                       ": the surface is not evenly lit, or does not fill the picture");
  }
  if (!LetsLightThrough(flat, raw.width(), raw.height())) {
    return Refused("flat_uneven", "flat", "no round loss of light explains this picture");
  }
  return flat;
}

CameraFlat CosineFourthFlat(Metres half_diagonal, Metres focal_length, double f_number) {
  // Through 1/(1 + q r^2)^2 at r^2 = 1/3, 2/3 and 1.
  const double q = std::pow(half_diagonal / focal_length, 2.0);
  Eigen::Matrix3d terms;
  Eigen::Vector3d value;
  for (int i = 0; i < 3; ++i) {
    const double r2 = (i + 1) / 3.0;
    terms.row(i) << r2, r2 * r2, r2 * r2 * r2;
    value[i] = 1.0 / ((1.0 + q * r2) * (1.0 + q * r2)) - 1.0;
  }
  const Eigen::Vector3d k = terms.colPivHouseholderQr().solve(value);
  CameraFlat flat;
  flat.f_number = f_number;
  flat.focal_length = focal_length;
  flat.channels.fill({k[0], k[1], k[2]});
  CameraFlat none = flat;
  none.channels = {};
  flat.sigma_relative = 0.5 * MeanDifference(flat, none);
  return flat;
}

Result<CameraFlat> FlatFor(std::span<const CameraFlat> flats, double f_number,
                           std::optional<Metres> focal_length) {
  const CameraFlat *below = nullptr, *above = nullptr;
  std::string known;
  for (const CameraFlat& flat : flats) {
    const bool zoomed = flat.focal_length && focal_length &&
                        std::abs(std::log(*flat.focal_length / *focal_length)) > kSameFocus;
    if (zoomed) continue;
    if (std::abs(std::log(flat.f_number / f_number)) < kSameAperture) return flat;
    known += (known.empty() ? "f/" : ", f/") + RoundedText(flat.f_number, 2);
    const CameraFlat*& side = flat.f_number < f_number ? below : above;
    const bool nearer = side == nullptr || std::abs(std::log(flat.f_number / f_number)) <
                                               std::abs(std::log(side->f_number / f_number));
    if (nearer) side = &flat;
  }
  if (below != nullptr && above != nullptr) return Between(*below, *above, f_number);
  return Refused("flat_missing", "f/" + RoundedText(f_number, 2),
                 known.empty()
                     ? "the camera's flat fields were taken at another focal length"
                     : "the camera's flat fields were taken at " + known +
                           "; how a lens loses light outside of these is not known: take one at "
                           "this aperture, or leave flat fields out ({camera.flat})");
}

}  // namespace lightcal
