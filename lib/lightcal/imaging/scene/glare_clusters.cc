// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/scene/glare_clusters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

namespace lightcal {
namespace {

class DisjointSets {
 public:
  int Add() {
    parents_.push_back(static_cast<int>(parents_.size()));
    return parents_.back();
  }
  int Root(int i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }
  void Join(int a, int b) {
    a = Root(a);
    b = Root(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }
  [[nodiscard]] int size() const { return static_cast<int>(parents_.size()); }

 private:
  std::vector<int> parents_;
};

// A pixel of a rim: the cube of space it lies in (whose diagonal is the reach) and its group.
struct RimPixel {
  std::int64_t cube = 0;
  Vec3 direction{};
  int group = 0;
};

constexpr std::int64_t kCubeStride = 1 << 20;  // cubes along an axis, more than any reach asks for
std::int64_t CubeKey(std::int64_t x, std::int64_t y, std::int64_t z) {
  return (x * kCubeStride + y) * kCubeStride + z;
}

double SquaredChord(const Vec3& a, const Vec3& b) {
  const Vec3 d = a - b;
  return Dot(d, d);
}

class PixelGroups {
 public:
  PixelGroups(const std::vector<char>& picked, const PixelSolidAngles& angles, Radians reach)
      : picked_(picked),
        angles_(angles),
        width_(angles.view().width),
        height_(angles.view().height),
        chord_(2.0 * std::sin(std::min(reach.value(), 3.0) / 2.0)),
        touching_(angles.MiddlePitch().value() * 1.5 < chord_) {}

  std::vector<int> Find() {
    labels_.assign(picked_.size(), 0);
    sets_.Add();  // 0 is none
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        if (Picked(x, y)) Label(x, y);
      }
    }
    JoinNearRims();
    return Numbered();
  }

 private:
  [[nodiscard]] std::size_t At(int x, int y) const {
    return static_cast<std::size_t>(y) * width_ + x;
  }
  [[nodiscard]] bool Picked(int x, int y) const {
    return x >= 0 && x < width_ && y >= 0 && y < height_ && picked_[At(x, y)] != 0;
  }

  void Label(int x, int y) {
    constexpr std::array<std::pair<int, int>, 4> kEarlier = {{{-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
    int label = 0;
    for (const auto& [dx, dy] : kEarlier) {
      if (!touching_ || !Picked(x + dx, y + dy)) continue;
      const int other = labels_[At(x + dx, y + dy)];
      if (label == 0) label = other;
      if (other != label) sets_.Join(other, label);
    }
    labels_[At(x, y)] = label != 0 ? label : sets_.Add();
  }

  [[nodiscard]] bool OnRim(int x, int y) const {
    if (!touching_) return true;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (!Picked(x + dx, y + dy)) return true;
      }
    }
    return false;
  }

  [[nodiscard]] std::vector<RimPixel> Rims() const {
    const double side = std::max(chord_ / std::sqrt(3.0), 4.0 / static_cast<double>(kCubeStride));
    std::vector<RimPixel> rims;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        if (!Picked(x, y) || !OnRim(x, y)) continue;
        const Vec3 d = *angles_.Direction(x + 0.5, y + 0.5);
        const auto cube = [&](double v) { return static_cast<std::int64_t>((v + 1.0) / side); };
        // Two cubes are kept free below, so that a neighbour's key needs no check.
        rims.push_back(
            {CubeKey(cube(d[0]) + 2, cube(d[1]) + 2, cube(d[2]) + 2), d, labels_[At(x, y)]});
      }
    }
    std::ranges::stable_sort(rims, {}, &RimPixel::cube);
    return rims;
  }

  // Of two cubes: is any pixel of one within reach of one of the other?
  [[nodiscard]] bool Reach(std::span<const RimPixel> a, std::span<const RimPixel> b) const {
    for (const RimPixel& p : a) {
      for (const RimPixel& q : b) {
        if (SquaredChord(p.direction, q.direction) <= chord_ * chord_) return true;
      }
    }
    return false;
  }

  void JoinNearRims() {
    const std::vector<RimPixel> rims = Rims();
    std::vector<std::span<const RimPixel>> cubes;
    for (std::size_t i = 0, j = 0; i < rims.size(); i = j) {
      while (j < rims.size() && rims[j].cube == rims[i].cube) ++j;
      cubes.emplace_back(rims.data() + i, j - i);
      for (const RimPixel& p : cubes.back()) sets_.Join(p.group, rims[i].group);
    }
    for (const auto& cube : cubes) {
      for (int dx = 0; dx <= 2; ++dx) {
        for (int dy = dx == 0 ? 0 : -2; dy <= 2; ++dy) {
          for (int dz = dx == 0 && dy == 0 ? 1 : -2; dz <= 2; ++dz) {
            JoinCubes(cubes, cube, cube.front().cube + CubeKey(dx, dy, dz));
          }
        }
      }
    }
  }

  void JoinCubes(const std::vector<std::span<const RimPixel>>& cubes,
                 std::span<const RimPixel> cube, std::int64_t key) {
    const auto other = std::ranges::lower_bound(
        cubes, key, {}, [](std::span<const RimPixel> c) { return c.front().cube; });
    if (other == cubes.end() || other->front().cube != key) return;
    const int a = cube.front().group, b = other->front().group;
    if (sets_.Root(a) != sets_.Root(b) && Reach(cube, *other)) sets_.Join(a, b);
  }

  std::vector<int> Numbered() {
    std::vector<int> number(static_cast<std::size_t>(sets_.size()), 0);
    int next = 0;
    for (int& label : labels_) {
      if (label == 0) continue;
      int& given = number[static_cast<std::size_t>(sets_.Root(label))];
      if (given == 0) given = ++next;
      label = given;
    }
    return std::move(labels_);
  }

  const std::vector<char>& picked_;
  const PixelSolidAngles& angles_;
  int width_, height_;
  double chord_;
  bool touching_;  // neighbours are within reach of each other
  std::vector<int> labels_;
  DisjointSets sets_;
};

}  // namespace

std::vector<int> GroupPixels(const std::vector<char>& picked, const PixelSolidAngles& angles,
                             Radians reach) {
  return PixelGroups(picked, angles, reach).Find();
}

}  // namespace lightcal
