// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/aim_bundle.h"

#include <ceres/jet.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "lightcal/core/statistics.h"
#include "lightcal/core/vec3.h"

namespace lightcal {
namespace {

constexpr double kBendSd = 0.03;   // prior of the lens's a and b
constexpr double kGaugeSd = 1e-5;  // radians, of the mean turn

template <class T>
Vec3Of<T> TurnedBy(const T* turn, const Vec3Of<T>& v) {
  const Vec3Of<T> g{turn[0] / 2.0, turn[1] / 2.0, turn[2] / 2.0};
  const T share = 2.0 / (1.0 + Dot(g, g));
  return v + Cross(g, v + Cross(g, v)) * share;
}

template <class T>
Vec3Of<T> Turned(const AimBundle& bundle, std::size_t view, const std::array<double, 2>& point,
                 const T* turn, const T* lens) {
  using std::exp;
  const Vec3Of<T> seen = BearingOf(bundle.view, point, T(exp(lens[0])), lens[1], lens[2]);
  const Eigen::Matrix3d& m = bundle.turns[view];
  Vec3Of<T> placed;
  for (Eigen::Index i = 0; i < 3; ++i) {
    placed[static_cast<std::size_t>(i)] = m(i, 0) * seen[0] + m(i, 1) * seen[1] + m(i, 2) * seen[2];
  }
  return TurnedBy(turn, placed);
}

// Two coordinates of a match's misfit in pixels of the middle.
template <class T>
std::array<T, 2> Misfit(const AimBundle& bundle, const AimMatch& match, const T* turn_a,
                        const T* turn_b, const T* lens) {
  const auto a = Turned(bundle, match.a, match.at_a, turn_a, lens);
  const auto b = Turned(bundle, match.b, match.at_b, turn_b, lens);
  const double focal = std::exp(bundle.ln_focal);
  std::array<T, 2> out{T(0.0), T(0.0)};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    out[0] += (a[k] - b[k]) * (focal * match.across[i]);
    out[1] += (a[k] - b[k]) * (focal * match.along[i]);
  }
  return out;
}

}  // namespace

bool AimRows::operator()(const double* at, double* residuals, double* jacobian) const {
  using Nine = ceres::Jet<double, 9>;
  const int rows = NumResiduals(), lens = bundle.Lens();
  if (jacobian != nullptr) {
    std::fill_n(jacobian, static_cast<std::size_t>(rows) * NumParameters(), 0.0);
  }
  const auto derivative = [&](int row, int column) -> double& {
    return jacobian[static_cast<std::size_t>(column) * rows + row];
  };
  int row = 0;
  for (const AimMatch& match : bundle.matches) {
    const int a = 3 * static_cast<int>(match.a), b = 3 * static_cast<int>(match.b);
    std::array<Nine, 9> local;
    for (int k = 0; k < 3; ++k) {
      local[k] = Nine(at[a + k], k);
      local[3 + k] = Nine(at[b + k], 3 + k);
      local[6 + k] = Nine(at[lens + k], 6 + k);
    }
    const auto misfit = Misfit(bundle, match, local.data(), local.data() + 3, local.data() + 6);
    const double scale = std::sqrt(match.weight) / bundle.sd_px;
    for (const Nine& part : misfit) {
      residuals[row] = scale * part.a;
      for (int k = 0; k < 3 && jacobian != nullptr; ++k) {
        derivative(row, a + k) = scale * part.v[k];
        derivative(row, b + k) = scale * part.v[3 + k];
        derivative(row, lens + k) = scale * part.v[6 + k];
      }
      ++row;
    }
  }
  for (int k = 0; k < kAimLensParameters; ++k, ++row) {
    const double mean = k == 0 ? bundle.ln_focal : 0.0;
    const double sd = k == 0 ? bundle.ln_focal_sd : kBendSd;
    residuals[row] = (at[lens + k] - mean) / sd;
    if (jacobian != nullptr) derivative(row, lens + k) = 1.0 / sd;
  }
  const auto views = static_cast<int>(bundle.turns.size());
  for (int k = 0; k < 3; ++k, ++row) {
    residuals[row] = 0.0;
    for (int v = 0; v < views; ++v) {
      residuals[row] += at[3 * v + k] / views / kGaugeSd;
      if (jacobian != nullptr) derivative(row, 3 * v + k) = 1.0 / views / kGaugeSd;
    }
  }
  return true;
}

Eigen::Vector3d AimDirection(const AimBundle& bundle, const AimMatch& match, const AimVector& at) {
  const double* const lens = at.data() + bundle.Lens();
  const auto d = Turned(bundle, match.a, match.at_a, at.data() + 3 * match.a, lens);
  return {d[0], d[1], d[2]};
}

void SetAimTangents(AimBundle& bundle, const AimVector& at) {
  for (AimMatch& match : bundle.matches) {
    const Eigen::Vector3d seen = AimDirection(bundle, match, at);
    match.across = seen.unitOrthogonal();
    match.along = seen.cross(match.across);
  }
}

std::array<double, 2> AimMisfit(const AimBundle& bundle, const AimMatch& match,
                                const AimVector& at) {
  return Misfit(bundle, match, at.data() + 3 * match.a, at.data() + 3 * match.b,
                at.data() + bundle.Lens());
}

void ReweighAims(AimBundle& bundle, const AimVector& at) {
  std::vector<double> off;
  for (const AimMatch& match : bundle.matches) {
    for (const double v : AimMisfit(bundle, match, at)) off.push_back(std::abs(v));
  }
  bundle.sd_px = std::max(1e-3, kSdPerMad * UpperMedian(off));
  for (AimMatch& match : bundle.matches) {
    const auto [x, y] = AimMisfit(bundle, match, at);
    const double z = std::hypot(x, y) / (kCauchyScale * bundle.sd_px);
    match.weight = 1.0 / (1.0 + z * z);
  }
}

void FoldAimTurns(AimBundle& bundle, AimVector& at) {
  for (std::size_t v = 0; v < bundle.turns.size(); ++v) {
    double* const turn = at.data() + 3 * v;
    Eigen::Matrix3d& own = bundle.turns[v];
    for (Eigen::Index column = 0; column < 3; ++column) {
      const Vec3 image = TurnedBy(turn, Vec3{own(0, column), own(1, column), own(2, column)});
      own.col(column) << image[0], image[1], image[2];
    }
    std::fill_n(turn, 3, 0.0);
  }
}

}  // namespace lightcal
