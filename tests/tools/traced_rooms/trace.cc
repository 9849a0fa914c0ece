// SPDX-License-Identifier: Apache-2.0
#include "trace.h"

#include <algorithm>

namespace traced_rooms {
namespace {

using Mask = unsigned;  // bit k: the light has not crossed meter k's card

struct Card {
  double distance, half_u, half_v;
  Frame frame;  // w from the lamp to the meter
};

class Tracer {
 public:
  Tracer(const Room& room, const Lamp& lamp, const std::vector<Meter>& meters)
      : room_(room), lamp_(lamp), meters_(meters), frame_(lamp.towards) {
    double u = 0.0, v = 0.0;
    lamp.CardHalfSides(&u, &v);
    const double diagonal = std::hypot(u, v);
    for (const Meter& meter : meters) {
      const bool ahead = meter.from_lamp == lamp.towards;
      cards_.push_back({meter.card_distance, ahead ? u : diagonal, ahead ? v : diagonal,
                        Frame(meter.from_lamp)});
    }
    sum_.resize(meters.size());
    sum_card_.resize(meters.size());
  }

  // Follows one ray of the lamp's light of flux `weight` to its end.
  void Follow(double weight, Random& random) {
    Vec3 origin, direction;
    lamp_.Emit(random, &origin, &direction);
    Mask clear = ~Mask{0};
    for (int depth = 0; depth < 200; ++depth) {
      const Hit hit = room_.Trace(origin, direction);
      for (std::size_t k = 0; k < meters_.size(); ++k) {
        if (Crosses(cards_[k], origin, hit.point)) clear &= ~(Mask{1} << k);
      }
      origin = hit.point;
      if (hit.glossy) {
        const double coat = room_.CoatReflectance(-Dot(direction, hit.normal));
        if (random.Share() < coat) {
          direction = room_.Mirrored(direction, false);
          continue;
        }
        // Chosen with probability 1 - coat: the weight stays.
      }
      const double diffuse = weight * hit.albedo;
      for (std::size_t k = 0; k < meters_.size(); ++k) Deposit(hit, diffuse, k, clear);
      absorbed_ += weight - diffuse;
      weight = diffuse;
      if (weight <= 0.0) return;
      if (depth >= 2) {  // Russian roulette
        const double stays = std::clamp(hit.albedo, 0.05, 0.95);
        if (random.Share() >= stays) {
          absorbed_ += weight;
          return;
        }
        absorbed_ -= weight * (1.0 / stays - 1.0);
        weight /= stays;
      }
      direction = CosineDirection(hit.normal, random);
    }
  }

  // The lamp's own image in the glossy wall, which no ray of light finds by chance.
  double Image(std::size_t k, bool card) const {
    if (room_.glossy_wall < 0) return 0.0;
    const int cells = lamp_.kind == LampKind::kPanel ? 12 : 1;
    const Vec3 image = room_.Mirrored(meters_[k].place, true);
    double sum = 0.0;
    for (int i = 0; i < cells * cells; ++i) {
      Vec3 point = lamp_.place;
      if (cells > 1) {
        point = point + frame_.At(lamp_.width * ((i % cells + 0.5) / cells - 0.5),
                                  lamp_.height * ((i / cells + 0.5) / cells - 0.5), 0.0);
      }
      const double way = Length(image - point);
      const double intensity = lamp_.Intensity((1.0 / way) * (image - point));
      const Way mirror = ByMirror(point, k, card);
      sum += intensity * mirror.share * mirror.cosine / (way * way);
    }
    return sum / (cells * cells);
  }

  std::vector<double> sum_, sum_card_;
  double absorbed_ = 0.0;

 private:
  struct Way {
    double share = 0.0;   // of the light that the coat sends on; 0: something is in the way
    double cosine = 0.0;  // at the meter
  };

  bool Crosses(const Card& card, const Vec3& from, const Vec3& to) const {
    if (card.distance <= 0.0) return false;
    const Vec3 a = from - lamp_.place;
    const Vec3 b = to - lamp_.place;
    const double before = Dot(a, card.frame.w) - card.distance;
    const double after = Dot(b, card.frame.w) - card.distance;
    if (before * after >= 0.0) return false;
    const Vec3 at = a + (before / (before - after)) * (b - a);
    return std::abs(Dot(at, card.frame.u)) < card.half_u &&
           std::abs(Dot(at, card.frame.v)) < card.half_v;
  }

  // From a point to meter k by way of the glossy wall.
  Way ByMirror(const Vec3& point, std::size_t k, bool card) const {
    const Meter& meter = meters_[k];
    const int axis = room_.glossy_wall / 2;
    const double plane = room_.glossy_wall % 2 == 1 ? room_.size[axis] : 0.0;
    const Vec3 way = room_.Mirrored(meter.place, true) - point;
    if (std::abs(way[axis]) < 1e-9 || std::abs(point[axis] - plane) < 1e-9) return {};
    const Vec3 at = point + ((plane - point[axis]) / way[axis]) * way;
    const double cosine = Dot(Unit(at - meter.place), meter.normal);
    if (cosine <= 0.0 || room_.Blocked(point, at) || room_.Blocked(at, meter.place)) return {};
    if (card && (Crosses(cards_[k], point, at) || Crosses(cards_[k], at, meter.place))) return {};
    return {room_.CoatReflectance(std::abs(way[axis]) / Length(way)), cosine};
  }

  void Deposit(const Hit& hit, double flux, std::size_t k, Mask clear) {
    const Meter& meter = meters_[k];
    const bool card_clear = (clear >> k & 1u) != 0;
    const Vec3 way = hit.point - meter.place;
    const double at_meter = Dot(way, meter.normal);
    const double at_surface = -Dot(way, hit.normal);
    if (at_meter > 0.0 && at_surface > 0.0 && !room_.Blocked(hit.point, meter.place)) {
      const double square = Dot(way, way);
      const double light = flux / kPi * at_meter * at_surface / (square * square);
      sum_[k] += light;
      if (card_clear && !Crosses(cards_[k], hit.point, meter.place)) sum_card_[k] += light;
    }
    if (room_.glossy_wall < 0 || hit.glossy) return;
    const Vec3 to_image = room_.Mirrored(meter.place, true) - hit.point;
    const double leaves = Dot(to_image, hit.normal);
    if (leaves <= 0.0) return;
    const double length = Length(to_image);
    const Way mirror = ByMirror(hit.point, k, false);
    if (mirror.share <= 0.0) return;
    const double light =
        flux / kPi * mirror.share * mirror.cosine * leaves / (length * length * length);
    sum_[k] += light;
    if (card_clear && ByMirror(hit.point, k, true).share > 0.0) sum_card_[k] += light;
  }

  const Room& room_;
  const Lamp& lamp_;
  const std::vector<Meter>& meters_;
  Frame frame_;
  std::vector<Card> cards_;
};

}  // namespace

std::vector<Meter> MetersAlong(const Lamp& lamp, const std::vector<double>& distances) {
  std::vector<Meter> meters;
  for (const double d : distances) {
    meters.push_back({lamp.place + d * lamp.towards, -1.0 * lamp.towards, 0.5 * d, lamp.towards});
  }
  return meters;
}

TraceAnswer TraceLight(const Room& room, const Lamp& lamp, const std::vector<Meter>& meters,
                       const TraceEffort& effort, Random& random) {
  const double flux = lamp.FluxOverIntensity();
  const std::size_t count = meters.size();
  const long batch = effort.least / 32;
  Tracer tracer(room, lamp, meters);
  std::vector<double> squares(count), before(count);
  long rays = 0;
  int batches = 0;
  TraceAnswer answer;
  answer.meters.resize(count);
  for (;;) {
    for (long i = 0; i < batch; ++i) tracer.Follow(flux, random);
    rays += batch;
    ++batches;
    bool enough = rays >= effort.least;
    for (std::size_t k = 0; k < count; ++k) {
      const double of_batch = (tracer.sum_[k] - before[k]) / static_cast<double>(batch);
      before[k] = tracer.sum_[k];
      squares[k] += of_batch * of_batch;
      const double mean = tracer.sum_[k] / static_cast<double>(rays);
      const double variance = std::max(0.0, squares[k] / batches - mean * mean) / batches;
      WallLight& light = answer.meters[k];
      light.wall = mean + tracer.Image(k, false);
      light.behind_card = tracer.sum_card_[k] / static_cast<double>(rays) + tracer.Image(k, true);
      light.error = light.wall > 0.0 ? std::sqrt(variance) / light.wall : 0.0;
      enough = enough && light.error <= effort.relative_error;
    }
    if (enough || rays >= effort.most) break;
  }
  answer.absorbed = tracer.absorbed_ / (flux * static_cast<double>(rays));
  return answer;
}

WallLight TraceBackwards(const Room& room, const Lamp& lamp, const Meter& meter, long paths,
                         Random& random) {
  double sum = 0.0, squares = 0.0;
  for (long i = 0; i < paths; ++i) {
    Vec3 origin = meter.place;
    Vec3 direction = CosineDirection(meter.normal, random);
    double weight = 1.0, path = 0.0;  // E = pi <L>, L = albedo / pi * E_direct + ...
    for (int depth = 0; depth < 60; ++depth) {
      const Hit hit = room.Trace(origin, direction);
      weight *= hit.albedo;
      const Vec3 way = hit.point - lamp.place;
      const double square = Dot(way, way);
      const double cosine = -Dot(way, hit.normal) / std::sqrt(square);
      if (cosine > 0.0 && !room.Blocked(lamp.place, hit.point)) {
        path += weight * lamp.Intensity((1.0 / std::sqrt(square)) * way) * cosine / square;
      }
      if (weight < 1e-5) break;
      origin = hit.point;
      direction = CosineDirection(hit.normal, random);
    }
    sum += path;
    squares += path * path;
  }
  const double n = static_cast<double>(paths);
  WallLight light;
  light.wall = sum / n;
  light.error = std::sqrt(std::max(0.0, squares / n - light.wall * light.wall) / n) / light.wall;
  return light;
}

}  // namespace traced_rooms
