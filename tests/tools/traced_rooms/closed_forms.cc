// SPDX-License-Identifier: Apache-2.0
#include "closed_forms.h"

#include <cstdio>

#include "paint.h"
#include "random_rooms.h"
#include "trace.h"

namespace traced_rooms {
namespace {

bool Told(const char* law, double got, double expected, double tolerance) {
  const double off = got / expected - 1.0;
  const bool holds = std::abs(off) <= tolerance;
  std::printf("%-66s %.5g %.5g %+.2f %% (%.2g %%)%s\n", law, got, expected, 100.0 * off,
              100.0 * tolerance, holds ? "" : "  FAILS");
  return holds;
}

Lamp IsotropicLamp(const Vec3& place) {
  Lamp lamp;
  lamp.place = place;
  lamp.towards = {1, 0, 0};
  lamp.base_angle = -1.0;  // no base: the edge lies outside
  return lamp;
}

// In a closed room of one albedo the mean illuminance from reflected light is, whatever its shape,
//   flux rho / (A (1 - rho)).
// At 460 nm a paint of ln_blue -.3 has that of 550 nm times exp(-.27).
bool Furnace(bool furnished, bool at_460_nm = false) {
  constexpr double kAlbedo = 0.6;
  Room room;
  room.albedo.fill(kAlbedo);
  double area = room.Area();
  if (furnished) {
    room.boxes.push_back({{0.5, 2.5, 0.0}, {1.5, 3.3, 0.9}, kAlbedo});
    area += 2.0 * 0.9 * (1.0 + 0.8);  // its top stands for the floor below
  }
  double albedo = kAlbedo;
  if (at_460_nm) {
    RoomPaint paint;
    paint.walls.fill({-0.3, 0.2});
    paint.boxes.assign(room.boxes.size(), {-0.3, 0.2});
    room = RoomAt(room, paint, 460);
    albedo *= std::exp(-0.27);
  }
  const Lamp lamp = IsotropicLamp({2.7, 1.6, 1.5});
  Random random(1);
  constexpr int kRounds = 400;
  double sum = 0.0, absorbed = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    // Meters spread over all surfaces by their area, each facing away from its own.
    std::vector<Meter> meters;
    while (meters.size() < 12) {
      double at = random.Between(0.0, area);
      Meter meter;
      for (int face = 0; face < 11; ++face) {
        const bool of_box = face >= 6;
        const int axis = of_box ? (face - 6) / 2 : face / 2;
        const bool high = of_box ? (face - 6) % 2 == 1 || axis == 2 : face % 2 == 1;
        const Vec3 low = of_box ? room.boxes[0].low : Vec3{0, 0, 0};
        const Vec3 far = of_box ? room.boxes[0].high : room.size;
        const int b = (axis + 1) % 3;
        const int c = (axis + 2) % 3;
        const double side = (far[b] - low[b]) * (far[c] - low[c]);
        if (at > side) {
          at -= side;
          continue;
        }
        meter.place[axis] = high ? far[axis] : low[axis];
        meter.place[b] = random.Between(low[b], far[b]);
        meter.place[c] = random.Between(low[c], far[c]);
        meter.normal = {0, 0, 0};
        meter.normal[axis] = high == of_box ? 1.0 : -1.0;
        break;
      }
      if (furnished && meter.place[2] == 0.0 && meter.place[0] > 0.5 && meter.place[0] < 1.5 &&
          meter.place[1] > 2.5 && meter.place[1] < 3.3) {
        continue;  // below the furniture
      }
      meters.push_back(meter);
    }
    const TraceAnswer answer = TraceLight(room, lamp, meters, {0.0, 2048, 2048}, random);
    for (const WallLight& light : answer.meters) sum += light.wall / (12.0 * kRounds);
    absorbed += answer.absorbed / kRounds;
  }
  const bool conserved = Told("energy: all light ends in the surfaces", absorbed, 1.0, 0.003);
  return Told(at_460_nm   ? "furnace with furniture, at 460 nm"
              : furnished ? "furnace with furniture: mean E = flux rho / (A (1 - rho))"
                          : "furnace: mean E = flux rho / (A (1 - rho))",
              sum, 4.0 * kPi * albedo / (area * (1.0 - albedo)), 0.012) &&
         conserved;
}

// A floor under a small source, seen from above it: E = rho/pi * integral of I h / (r^2+h^2)^3/2 *
// H^2 / (r^2+H^2)^2 * 2 pi r dr.
bool OneBounce() {
  Room room;
  room.size = {80, 80, 40};
  room.albedo[4] = 0.5;
  const Lamp lamp = IsotropicLamp({40, 40, 1});
  Meter meter{{40, 40, 2.5}, {0, 0, -1}, 0.0};
  Random random(2);
  const TraceAnswer answer = TraceLight(room, lamp, {meter}, {0.001, 1 << 20, 1 << 22}, random);
  double expected = 0.0;
  constexpr int kSteps = 400000;
  for (int i = 0; i < kSteps; ++i) {
    const double r = 40.0 * (i + 0.5) / kSteps;
    const double square = r * r + 1.0;
    expected += 0.5 / kPi / (square * std::sqrt(square)) * 6.25 /
                ((r * r + 6.25) * (r * r + 6.25)) * 2.0 * kPi * r * 40.0 / kSteps;
  }
  return Told("one bounce off a floor: an integral over its rings", answer.meters[0].wall, expected,
              0.005);
}

// A wall that mirrors all light makes of half a room and a lamp a whole room and two lamps.
bool MirrorUnfolds() {
  Room half;
  half.albedo = {0.4, 0.0, 0.6, 0.3, 0.2, 0.7};
  half.glossy_wall = 1;
  half.glossy_f0 = 1.0;
  half.boxes.push_back({{3.5, 0.2, 0.0}, {4.4, 1.0, 1.2}, 0.3});
  const Lamp lamp = IsotropicLamp({3.2, 2.0, 1.5});
  const std::vector<Meter> meters = {{{1.0, 1.5, 1.1}, {1, 0, 0}, 0.0},
                                     {{4.0, 3.1, 0.9}, {-0.6, -0.8, 0}, 0.0}};
  Random random(3);
  const TraceEffort effort{0.002, 1 << 16, 1 << 22};
  const TraceAnswer folded = TraceLight(half, lamp, meters, effort, random);
  Room whole = half;
  whole.glossy_wall = -1;
  whole.size[0] = 10.0;
  whole.albedo[1] = whole.albedo[0];
  whole.boxes.push_back({{5.6, 0.2, 0.0}, {6.5, 1.0, 1.2}, 0.3});
  Lamp twin = lamp;
  twin.place[0] = 10.0 - lamp.place[0];
  const TraceAnswer one = TraceLight(whole, lamp, meters, effort, random);
  const TraceAnswer two = TraceLight(whole, twin, meters, effort, random);
  bool holds = true;
  for (int k = 0; k < 2; ++k) {
    const Vec3 way = twin.place - meters[k].place;
    const double cosine = Dot(Unit(way), meters[k].normal);
    const double direct =
        cosine > 0.0 && !whole.Blocked(twin.place, meters[k].place) ? cosine / Dot(way, way) : 0.0;
    holds = Told("a mirror unfolds into a room of twice the length", folded.meters[k].wall,
                 one.meters[k].wall + two.meters[k].wall + direct, 0.012) &&
            holds;
  }
  return holds;
}

// The same rooms traced from the meter to the lamp.
bool BothWays() {
  bool holds = true;
  for (const int number : {0, 9, 15}) {
    const LitRoom lit = RandomRoom(Family::kOrdinary, number);
    const std::vector<Meter> meters = MetersAlong(lit.lamp, {0.5, 2.0});
    Random random(10 + number);
    const TraceAnswer forwards =
        TraceLight(lit.room, lit.lamp, meters, {0.003, 1 << 16, 1 << 20}, random);
    for (std::size_t k = 0; k < meters.size(); ++k) {
      const WallLight backwards = TraceBackwards(lit.room, lit.lamp, meters[k], 150000, random);
      const double error = std::hypot(forwards.meters[k].error, backwards.error);
      holds = Told("forwards as backwards (bulb, furnished room)", forwards.meters[k].wall,
                   backwards.wall, 3.5 * error) &&
              holds;
    }
  }
  return holds;
}

bool PanelsDirectLight() {
  Lamp panel;
  panel.kind = LampKind::kPanel;
  panel.width = 0.5;
  panel.height = 0.3;
  double sum = 0.0;
  constexpr int kCells = 400;
  for (int i = 0; i < kCells * kCells; ++i) {
    const double x = panel.width * ((i % kCells + 0.5) / kCells - 0.5);
    const double y = panel.height * ((i / kCells + 0.5) / kCells - 0.5);
    const double square = x * x + y * y + 0.25;
    sum += 0.25 / (square * square) / (kCells * kCells);
  }
  return Told("panel at its own width: the rectangle's form factor", panel.Direct(0.5), sum,
              1e-5) &&
         Told("panel far away: I / d^2", panel.Direct(50.0), 1.0 / 2500.0, 1e-4);
}

// Flux over intensity, and that rays leave the lamp as its intensity says.
bool LampsShineAsTheySay() {
  bool holds = true;
  Random random(5);
  for (const int number : {0, 1, 2, 3, 5}) {
    const Lamp lamp = RandomRoom(Family::kOrdinary, number).lamp;
    const double half = std::cos(0.35);  // a cone about the meter's line
    double expected = 0.0;
    constexpr int kSamples = 200000;
    const Frame frame(lamp.towards);
    for (int i = 0; i < kSamples; ++i) {
      const double cosine = half + (1.0 - half) * (i + 0.5) / kSamples;
      const double turn = 2.0 * kPi * std::fmod(0.618033988749895 * i, 1.0);
      const double sine = std::sqrt(1.0 - cosine * cosine);
      expected += lamp.Intensity(frame.At(sine * std::cos(turn), sine * std::sin(turn), cosine));
    }
    expected *= 2.0 * kPi * (1.0 - half) / kSamples;
    int within = 0;
    for (int i = 0; i < kSamples; ++i) {
      Vec3 origin, direction;
      lamp.Emit(random, &origin, &direction);
      within += Dot(direction, lamp.towards) > half ? 1 : 0;
    }
    holds = Told("light in a cone: by rays, by intensity",
                 lamp.FluxOverIntensity() * within / kSamples, expected, 0.03) &&
            holds;
  }
  return holds;
}

// A black room gives a meter nothing but direct light, and every card keeps all of that away.
bool BlackRoomAndCards() {
  Random random(6);
  double light = 0.0, through = 0.0;
  for (int number = 0; number < 30; ++number) {
    LitRoom lit = RandomRoom(Family::kOrdinary, number);
    lit.room.albedo.fill(0.0);
    for (Box& box : lit.room.boxes) box.albedo = 0.0;
    const std::vector<Meter> meters = MetersAlong(lit.lamp, {0.5, 2.0});
    for (const WallLight& at : TraceLight(lit.room, lit.lamp, meters, {0, 64, 64}, random).meters) {
      light += at.wall;
    }
    double half_u = 0.0, half_v = 0.0;
    lit.lamp.CardHalfSides(&half_u, &half_v);
    const bool panel = lit.lamp.kind == LampKind::kPanel;
    // The corner of the lamp is the last to be covered: half way, half as far out.
    if ((panel ? lit.lamp.width / 4.0 : 0.025) > half_u ||
        (panel ? lit.lamp.height / 4.0 : 0.025) > half_v) {
      through += 1.0;
    }
  }
  std::printf("black rooms: %.3g lx from walls; %.0f of 30 cards too small\n", light, through);
  return light == 0.0 && through == 0.0;
}

}  // namespace

bool ClosedFormsHold() {
  bool holds = PanelsDirectLight();
  holds = LampsShineAsTheySay() && holds;
  holds = BlackRoomAndCards() && holds;
  holds = OneBounce() && holds;
  holds = Furnace(false) && holds;
  holds = Furnace(true) && holds;
  holds = Furnace(true, true) && holds;
  holds = MirrorUnfolds() && holds;
  return BothWays() && holds;
}

}  // namespace traced_rooms
