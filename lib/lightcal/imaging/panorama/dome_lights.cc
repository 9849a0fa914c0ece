// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/dome_lights.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "lightcal/core/statistics.h"

namespace lightcal {
namespace {

using Index = std::int32_t;
using std::numbers::pi;

constexpr int kRingPitches = 3;
constexpr int kMostArcs = 256;
constexpr double kRingOutlier = 3.0;  // times the ring's median: another light, not the background
constexpr std::int32_t kFree = -1;

// Two unit vectors across a direction: along the horizon, and up.
struct Frame2d {
  Vec3 right, up;
};
Frame2d FrameAcross(const Vec3& d) {
  const double aside = std::hypot(d[0], d[1]);
  const Vec3 right = aside > 1e-9 ? Vec3{d[1] / aside, -d[0] / aside, 0.0} : Vec3{1.0, 0.0, 0.0};
  return {right, Cross(right, d)};
}

struct Arc {
  Vec3 direction{};
  double nits = 0.0;
  std::array<double, 3> samples{};
  double count = 0.0;
};

class LightMeasurer {
 public:
  LightMeasurer(const Dome& dome, std::span<const std::uint8_t> clipped)
      : dome_(dome),
        clipped_(clipped),
        grid_(dome.grid()),
        xyz_from_rgb_(dome.xyz_from_rgb),
        owner_(dome.nits.size(), kFree) {}

  void Claim(const BrightBody& body, std::int32_t self) {
    for (const Index i : body.pixels) owner_[static_cast<std::size_t>(i)] = self;
  }

  DomeLight Measure(BrightBody body) const {
    DomeLight light;
    light.body = std::move(body);
    const std::vector<Arc> arcs = ArcsAround(light.body);
    FillFrom(arcs, light);
    TakeMoments(light);
    const double ring_sd = Spread(arcs);
    double omega = 0.0;
    for (const Index i : light.body.pixels) omega += grid_.SolidAngle(grid_.Y(i));
    const double e = light.illuminance.value();
    if (e > 0.0) light.background_sd_relative = ring_sd * omega / e;
    return light;
  }

 private:
  [[nodiscard]] const float* Samples(Index i) const {
    return &dome_.samples[static_cast<std::size_t>(i) * static_cast<std::size_t>(dome_.channels)];
  }
  [[nodiscard]] double Nits(Index i) const { return dome_.nits[static_cast<std::size_t>(i)]; }
  [[nodiscard]] Vec3 Direction(Index i) const { return grid_.Direction(grid_.X(i), grid_.Y(i)); }

  [[nodiscard]] Vec3 Middle(const BrightBody& body) const {
    Vec3 sum{};
    for (const Index i : body.pixels) sum = sum + grid_.Flow(grid_.X(i), grid_.Y(i));
    const double length = Length(sum);
    return length > 0.0 ? sum * (1.0 / length) : Direction(body.pixels.front());
  }

  // Pixels around the body that no body owns.
  [[nodiscard]] std::vector<Index> Ring(const BrightBody& body) const {
    std::vector<Index> ring;
    std::vector<Index> edge = body.pixels;
    std::vector<Index> seen = body.pixels;  // ascending
    for (int pitch = 0; pitch < kRingPitches; ++pitch) {
      std::vector<Index> next;
      for (const Index i : edge) {
        grid_.ForNeighbours(grid_.X(i), grid_.Y(i), [&](Index neighbour) {
          if (!std::binary_search(seen.begin(), seen.end(), neighbour)) next.push_back(neighbour);
        });
      }
      std::sort(next.begin(), next.end());
      next.erase(std::unique(next.begin(), next.end()), next.end());
      const auto middle = static_cast<std::ptrdiff_t>(seen.size());
      seen.insert(seen.end(), next.begin(), next.end());
      std::inplace_merge(seen.begin(), seen.begin() + middle, seen.end());
      for (const Index i : next) {
        if (owner_[static_cast<std::size_t>(i)] == kFree) ring.push_back(i);
      }
      edge = std::move(next);
    }
    return ring;
  }

  [[nodiscard]] std::vector<Arc> ArcsAround(const BrightBody& body) const {
    std::vector<Index> ring = Ring(body);
    if (ring.empty()) return {};
    std::vector<double> levels;
    for (const Index i : ring) levels.push_back(Nits(i));
    const double most = kRingOutlier * std::max(0.0, UpperMedian(levels));
    const Vec3 centre = Middle(body);
    const Frame2d frame = FrameAcross(centre);
    const int count = std::min(kMostArcs, static_cast<int>(ring.size()));
    std::vector<Arc> arcs(static_cast<std::size_t>(count));
    for (const Index i : ring) {
      if (Nits(i) > most) continue;
      const Vec3 d = Direction(i);
      const double angle = std::atan2(Dot(d, frame.up), Dot(d, frame.right));
      const int at = std::clamp(static_cast<int>((angle / (2.0 * pi) + 0.5) * count), 0, count - 1);
      Arc& arc = arcs[static_cast<std::size_t>(at)];
      arc.direction = arc.direction + d;
      arc.nits += Nits(i);
      for (int c = 0; c < dome_.channels; ++c) {
        arc.samples[static_cast<std::size_t>(c)] += double{Samples(i)[c]};
      }
      arc.count += 1.0;
    }
    std::erase_if(arcs, [](const Arc& arc) { return arc.count == 0.0; });
    for (Arc& arc : arcs) {
      arc.direction = arc.direction * (1.0 / Length(arc.direction));
      arc.nits /= arc.count;
      for (double& v : arc.samples) v /= arc.count;
    }
    return arcs;
  }

  void FillFrom(const std::vector<Arc>& arcs, DomeLight& light) const {
    const double blur2 = std::pow(grid_.pitch().value(), 2);
    for (const Index i : light.body.pixels) {
      const Vec3 d = Direction(i);
      std::array<double, 3> sum{};
      double weights = 0.0;
      for (const Arc& arc : arcs) {
        const Vec3 chord = d - arc.direction;
        const double distance2 = Dot(chord, chord) + blur2;
        const double weight = arc.count / (distance2 * std::sqrt(distance2));
        weights += weight;
        for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * arc.samples[c];
      }
      for (int c = 0; c < dome_.channels; ++c) {
        const double v = weights > 0.0 ? sum[static_cast<std::size_t>(c)] / weights : 0.0;
        light.fill.push_back(static_cast<float>(v));
      }
    }
  }

  [[nodiscard]] Xyz XyzOf(const float* samples, const float* fill) const {
    const double r = double{samples[0]} - fill[0], g = double{samples[1]} - fill[1],
                 b = double{samples[2]} - fill[2];
    const auto row = [&](std::size_t k) {
      return xyz_from_rgb_[k][0] * r + xyz_from_rgb_[k][1] * g + xyz_from_rgb_[k][2] * b;
    };
    return {row(0), row(1), row(2)};
  }

  [[nodiscard]] double Added(const DomeLight& light, std::size_t at) const {
    const float* samples = Samples(light.body.pixels[at]);
    const float* fill = &light.fill[at * static_cast<std::size_t>(dome_.channels)];
    if (dome_.channels == 1) return double{samples[0]} - fill[0];
    return XyzOf(samples, fill).Y;
  }

  // Of a clipped body what stands out of its surroundings as another light would: the rest of its
  // edge differs from the fill by the surroundings' own unevenness, and has their colour.
  [[nodiscard]] bool ShowsColor(const DomeLight& light, std::size_t at) const {
    if (!light.body.clipped) return true;
    const Index i = light.body.pixels[at];
    if (!clipped_.empty() && clipped_[static_cast<std::size_t>(i)] != 0) return false;
    return Nits(i) * (1.0 - 1.0 / kRingOutlier) < Added(light, at);
  }

  void TakeMoments(DomeLight& light) const {
    Xyz color{};
    for (std::size_t at = 0; at < light.body.pixels.size(); ++at) {
      const Index i = light.body.pixels[at];
      light.flow = light.flow + grid_.Flow(grid_.X(i), grid_.Y(i)) * Added(light, at);
      if (dome_.channels != 3 || !ShowsColor(light, at)) continue;
      const Xyz xyz = XyzOf(Samples(i), &light.fill[at * 3]);
      const double omega = grid_.SolidAngle(grid_.Y(i));
      color = {color.X + omega * xyz.X, color.Y + omega * xyz.Y, color.Z + omega * xyz.Z};
    }
    const double e = Length(light.flow);
    light.illuminance = Lux(e);
    light.direction = e > 0.0 ? light.flow * (1.0 / e) : Middle(light.body);
    const bool colored = color.X >= 0.0 && color.Y > 0.0 && color.Z >= 0.0;
    if (dome_.channels == 3 && colored) light.xy = XyFromXyz(color);
    TakeSize(light);
  }

  void TakeSize(DomeLight& light) const {
    const Frame2d frame = FrameAcross(light.direction);
    double weights = 0.0, right2 = 0.0, up2 = 0.0;
    for (std::size_t at = 0; at < light.body.pixels.size(); ++at) {
      const Index i = light.body.pixels[at];
      const double weight = std::max(0.0, Added(light, at)) * grid_.SolidAngle(grid_.Y(i));
      const Vec3 d = Direction(i);
      weights += weight;
      right2 += weight * std::pow(Dot(d, frame.right), 2);
      up2 += weight * std::pow(Dot(d, frame.up), 2);
    }
    const double pitch = grid_.pitch().value();
    if (weights > 0.0) {
      right2 = std::max(0.0, right2 / weights - pitch * pitch / 12.0);
      up2 = std::max(0.0, up2 / weights - pitch * pitch / 12.0);
    }
    light.angular_width = Radians(std::sqrt(12.0 * right2));
    light.angular_height = Radians(std::sqrt(12.0 * up2));
    light.angular_diameter = Radians(4.0 * std::sqrt((right2 + up2) / 2.0));
    const double half = std::sin(light.angular_diameter.value() / 4.0);
    const int row = grid_.Y(light.body.pixels[light.body.pixels.size() / 2]);
    light.solid_angle = Steradians(std::max(4.0 * pi * half * half, grid_.SolidAngle(row)));
    light.luminance = lightcal::Nits(light.illuminance.value() / light.solid_angle.value());
  }

  static double Spread(const std::vector<Arc>& arcs) {
    double sum = 0.0, sum2 = 0.0, count = 0.0;
    for (const Arc& arc : arcs) {
      sum += arc.nits;
      sum2 += arc.nits * arc.nits;
      count += 1.0;
    }
    if (count < 2.0) return 0.0;
    return std::sqrt(std::max(0.0, sum2 / count - sum * sum / (count * count)));
  }

  const Dome& dome_;
  std::span<const std::uint8_t> clipped_;
  LatLongGrid grid_;
  Matrix3 xyz_from_rgb_;
  std::vector<std::int32_t> owner_;
};

}  // namespace

void Dome::Multiply(double factor) {
  const auto f = static_cast<float>(factor);
  for (float& v : samples) v *= f;
  for (float& v : nits) v *= f;
}

std::vector<DomeLight> MeasureDomeLights(const Dome& dome, std::vector<BrightBody> bodies,
                                         std::span<const std::uint8_t> clipped) {
  LightMeasurer measurer(dome, clipped);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    measurer.Claim(bodies[i], static_cast<std::int32_t>(i));
  }
  std::vector<DomeLight> lights;
  for (BrightBody& body : bodies) {
    DomeLight light = measurer.Measure(std::move(body));
    if (light.illuminance.value() > 0.0) lights.push_back(std::move(light));
  }
  std::stable_sort(lights.begin(), lights.end(), [](const DomeLight& a, const DomeLight& b) {
    return a.illuminance.value() > b.illuminance.value();
  });
  return lights;
}

bool IsBrightAsSun(const DomeLight& light) {
  constexpr double kSunNits = 2e7;
  return light.luminance.value() > kSunNits && light.angular_diameter < kWidestSun;
}

void TakeOut(const DomeLight& light, Dome& dome) {
  const auto& luminance = dome.xyz_from_rgb[1];
  const auto channels = static_cast<std::size_t>(dome.channels);
  for (std::size_t at = 0; at < light.body.pixels.size(); ++at) {
    const auto i = static_cast<std::size_t>(light.body.pixels[at]);
    const float* fill = &light.fill[at * channels];
    std::copy_n(fill, channels, &dome.samples[i * channels]);
    double nits = fill[0];
    if (channels == 3) {
      nits = luminance[0] * fill[0] + luminance[1] * fill[1] + luminance[2] * fill[2];
    }
    dome.nits[i] = static_cast<float>(nits);
  }
}

void InferIlluminance(Lux illuminance, DomeLight& light) {
  light.inferred = true;
  light.flow = light.direction * illuminance.value();
  light.illuminance = illuminance;
  light.luminance = Nits(illuminance.value() / light.solid_angle.value());
}

std::optional<Xy> XyFromAbove(const Dome& dome) {
  if (dome.channels != 3) return std::nullopt;
  const LatLongGrid grid = dome.grid();
  Column3 sum{};
  for (int y = 0; y < dome.height / 2; ++y) {
    for (int x = 0; x < dome.width; ++x) {
      const double weight = grid.Flow(x, y)[2];
      const std::size_t at = 3 * static_cast<std::size_t>(grid.Index(x, y));
      for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * double{dome.samples[at + c]};
    }
  }
  const Column3 xyz = Times(dome.xyz_from_rgb, sum);
  if (!(xyz[1] > 0.0)) return std::nullopt;
  return XyFromXyz({xyz[0], xyz[1], xyz[2]});
}

}  // namespace lightcal
