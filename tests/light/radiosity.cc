// SPDX-License-Identifier: Apache-2.0
#include "radiosity.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace lightcal::test {
namespace {

using std::numbers::pi;

Place Minus(const Place& a, const Place& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double Product(const Place& a, const Place& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

struct Patch {
  Place centre{};
  Place inward{};
  double area = 0.0;
  int wall = 0;
};

std::vector<Patch> Cut(const GreyBox& box, int n) {
  std::vector<Patch> patches;
  patches.reserve(static_cast<std::size_t>(6 * n * n));
  for (int wall = 0; wall < 6; ++wall) {
    const int axis = wall / 2;
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const auto low = [&](int k) { return k == 2 ? 0.0 : -0.5 * box.size[k]; };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        Patch patch;
        patch.centre[axis] = low(axis) + (wall % 2) * box.size[axis];
        patch.centre[u] = low(u) + (i + 0.5) / n * box.size[u];
        patch.centre[v] = low(v) + (j + 0.5) / n * box.size[v];
        patch.inward[axis] = wall % 2 == 0 ? 1.0 : -1.0;
        patch.area = box.size[u] * box.size[v] / (n * n);
        patch.wall = wall;
        patches.push_back(patch);
      }
    }
  }
  return patches;
}

double FromLamp(const PointLamp& lamp, const Place& point, const Place& normal) {
  const Place away = Minus(point, lamp.position);
  const double r2 = Product(away, away);
  const double r = std::sqrt(r2);
  const double facing = -Product(away, normal) / r;
  if (facing <= 0.0) return 0.0;
  double intensity = 1.0;
  if (lamp.exponent > 0.0) {
    const double c = Product(away, lamp.aim) / r;
    if (c <= 0.0) return 0.0;
    intensity = std::pow(c, lamp.exponent);
  }
  return intensity * facing / r2;
}

// What a patch of unit radiosity sends to a point with a normal.
double Kernel(const Patch& from, const Place& point, const Place& normal) {
  const Place to = Minus(from.centre, point);
  const double r2 = Product(to, to);
  const double here = Product(normal, to);
  const double there = -Product(from.inward, to);
  if (here <= 0.0 || there <= 0.0) return 0.0;
  return from.area * here * there / (pi * r2 * r2);
}

// Shares of each patch's light that reach the others, every row made whole: the box is closed.
std::vector<double> FormFactors(const std::vector<Patch>& patches) {
  const std::size_t n = patches.size();
  std::vector<double> shares(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    double whole = 0.0;
    for (std::size_t j = 0; j < n; ++j) {
      if (patches[i].wall == patches[j].wall) continue;
      shares[i * n + j] = Kernel(patches[j], patches[i].centre, patches[i].inward);
      whole += shares[i * n + j];
    }
    for (std::size_t j = 0; j < n; ++j) shares[i * n + j] /= whole;
  }
  return shares;
}

// Mean of the lamp's own light over a patch, by 4 x 4 points.
double DirectOn(const Patch& patch, const PointLamp& lamp, int axis, double side_u, double side_v) {
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      Place point = patch.centre;
      point[(axis + 1) % 3] += ((i + 0.5) / 4 - 0.5) * side_u;
      point[(axis + 2) % 3] += ((j + 0.5) / 4 - 0.5) * side_v;
      sum += FromLamp(lamp, point, patch.inward);
    }
  }
  return sum / 16;
}

}  // namespace

double IndirectIlluminance(const GreyBox& box, const PointLamp& lamp, const Place& meter,
                           const Place& normal, const RadiositySteps& steps) {
  const double rho = box.reflectance;
  double sum = 0.0;
  for (const Patch& patch : Cut(box, steps.first_bounce)) {
    const double kernel = Kernel(patch, meter, normal);
    if (kernel > 0.0) sum += rho * FromLamp(lamp, patch.centre, patch.inward) * kernel;
  }
  const std::vector<Patch> patches = Cut(box, steps.patches);
  const std::vector<double> shares = FormFactors(patches);
  const std::size_t n = patches.size();
  std::vector<double> direct(n), indirect(n, 0.0), next(n);
  for (std::size_t i = 0; i < n; ++i) {
    const int axis = patches[i].wall / 2;
    direct[i] = DirectOn(patches[i], lamp, axis, box.size[(axis + 1) % 3] / steps.patches,
                         box.size[(axis + 2) % 3] / steps.patches);
  }
  for (int bounce = 0; bounce < 200; ++bounce) {
    double change = 0.0;
    double largest = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      double gathered = 0.0;
      for (std::size_t j = 0; j < n; ++j) {
        gathered += shares[i * n + j] * (direct[j] + indirect[j]);
      }
      next[i] = rho * gathered;
      change = std::max(change, std::abs(next[i] - indirect[i]));
      largest = std::max(largest, next[i]);
    }
    indirect.swap(next);
    if (change <= 1e-3 * largest) break;
  }
  // The further bounces are smooth: finer pieces of the same patches towards the meter.
  for (std::size_t i = 0; i < n; ++i) {
    const int axis = patches[i].wall / 2;
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    Patch piece = patches[i];
    piece.area /= 16;
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) {
        piece.centre = patches[i].centre;
        piece.centre[u] += ((a + 0.5) / 4 - 0.5) * box.size[u] / steps.patches;
        piece.centre[v] += ((b + 0.5) / 4 - 0.5) * box.size[v] / steps.patches;
        sum += rho * indirect[i] * Kernel(piece, meter, normal);
      }
    }
  }
  return sum;
}

}  // namespace lightcal::test
