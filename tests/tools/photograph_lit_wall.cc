// SPDX-License-Identifier: Apache-2.0
// SYNTHETIC: photographs a wall that a lamp lights in a traced room (traced_rooms --lit_walls).
//   photograph_lit_wall BOARD.svg WALL.exr < WALL      prints a box around the card's shadow
// The lens is that of sample_data/sessions/lit_wall/views. WALL: words and numbers. `distance` of
// the lamp from the wall sets the scale of all: the board's squares are .03 of it. `place GAMMA
// AZIMUTH LX` what the room throws onto a place of the wall as the lamp sees it; between places it
// is interpolated. The lamp shines `candela` straight ahead, elsewhere as cos^`power`, or as a bulb
// with a base (traced_rooms/lamp.h). With `lamp_red`, `_green`, `_blue` and `room_red` ... the
// picture has these colours where the lamp, and where the room lights the wall.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "synthetic_wall.h"
#include "wall_picture_file.h"

namespace {

using namespace lightcal::test;  // NOLINT(google-build-using-namespace): a tool of the tests

constexpr double kDegree = std::numbers::pi / 180.0;

struct Place {
  double x = 0.0, z = 0.0;  // tangents, to the right and up as the lamp looks
  double lux = 0.0;
};

struct Task {
  std::map<std::string, double> numbers;
  std::vector<Place> places;

  [[nodiscard]] double Of(const std::string& name, double otherwise) const {
    const auto found = numbers.find(name);
    return found == numbers.end() ? otherwise : found->second;
  }
};

Task ReadTask(std::istream& in) {
  Task task;
  for (std::string word; in >> word;) {
    if (word != "place") {
      in >> task.numbers[word];
      continue;
    }
    double gamma = 0.0, azimuth = 0.0;
    Place place;
    in >> gamma >> azimuth >> place.lux;
    place.x = std::tan(gamma * kDegree) * std::sin(azimuth * kDegree);
    place.z = std::tan(gamma * kDegree) * std::cos(azimuth * kDegree);
    task.places.push_back(place);
  }
  return task;
}

// Weights by distance to the power -4 (D. Shepard, ACM National Conference 517 (1968)); beyond the
// outermost places as at their rim.
double Between(const std::vector<Place>& places, double x, double z) {
  const double rim = std::tan(40.0 * kDegree);
  const double held = std::min(1.0, rim / std::max(1e-9, std::hypot(x, z)));
  double sum = 0.0, weights = 0.0;
  for (const Place& place : places) {
    const double across = place.x - held * x, up = place.z - held * z;
    const double apart2 = std::max(across * across + up * up, 1e-12);
    const double weight = 1.0 / (apart2 * apart2);
    sum += weight * place.lux;
    weights += weight;
  }
  return sum / weights;
}

// Candela over those straight ahead, towards (right, ahead, up).
SyntheticIntensity PatternOf(const Task& task) {
  const double power = task.Of("power", 0.0);
  if (power > 0.0) return [power](const Point3& d) { return std::pow(d[1], power); };
  const Point3 base = {task.Of("base_right", 0.0), task.Of("base_ahead", 0.0),
                       task.Of("base_up", 1.0)};
  const double angle = task.Of("base_deg", 0.0), slope = task.Of("slope", 0.0);
  const auto pattern = [=](const Point3& d) {
    const double cosine = d[0] * base[0] + d[1] * base[1] + d[2] * base[2];
    const double from_base = std::acos(std::clamp(cosine, -1.0, 1.0)) / kDegree;
    const double step = std::clamp((from_base - angle) / 15.0, 0.0, 1.0);
    return (1.0 - slope * cosine) * step * step * (3.0 - 2.0 * step);
  };
  const double ahead = pattern({0, 1, 0});
  return [=](const Point3& d) { return pattern(d) / ahead; };
}

// A camera and a board for a lamp one metre from the wall, times `distance`.
SyntheticWall WallAt(double distance, const std::string& board_svg) {
  std::ifstream svg(board_svg);
  SyntheticWall wall;
  wall.board = RectanglesOfSvg({std::istreambuf_iterator<char>(svg), {}});
  wall.width = 800;
  wall.height = 600;
  wall.focal_px = 640.0;
  for (PrintedRectangle& r : wall.board) {
    r = {r.x * distance, r.z * distance, r.width * distance, r.height * distance, r.black};
  }
  for (double* length :
       {&wall.paper_width, &wall.paper_height, &wall.board_width, &wall.board_height}) {
    *length *= distance;
  }
  for (Point3* point : {&wall.camera, &wall.looks_at, &wall.lamp}) {
    for (double& axis : *point) axis *= distance;
  }
  return wall;
}

// What the lamp shows in its colour, and all else in the room's.
std::vector<float> InColours(const Task& task, SyntheticWall wall) {
  SyntheticWall others = wall;
  others.intensity = [](const Point3&) { return 0.0; };
  wall.other_lx = [](double, double) { return 0.0; };
  ++others.seed;
  const std::vector<float> by_lamp = PhotographWall(wall), by_others = PhotographWall(others);
  std::vector<std::array<double, 2>> parts;  // of lamp and room in each channel
  for (const char* channel : {"red", "green", "blue"}) {
    parts.push_back({task.Of(std::string("lamp_") + channel, 1.0),
                     task.Of(std::string("room_") + channel, 1.0)});
  }
  std::vector<float> out;
  for (std::size_t i = 0; i < by_lamp.size(); ++i) {
    for (const auto& [lamp, room] : parts) {
      out.push_back(static_cast<float>(by_lamp[i] * lamp + by_others[i] * room));
    }
  }
  return out;
}

int PhotographLitWall(const std::string& board_svg, const std::string& out) {
  const Task task = ReadTask(std::cin);
  const double distance = task.Of("distance", 1.0);
  SyntheticWall wall = WallAt(distance, board_svg);
  const Point3 stated = wall.lamp;
  wall.lamp = {stated[0] + task.Of("lamp_x", 0.0), stated[1] + task.Of("lamp_y", 0.0),
               stated[2] + task.Of("lamp_z", 0.0)};
  wall.wall_reflectance = task.Of("reflectance", 0.8);
  wall.gloss = task.Of("gloss", 0.0);
  wall.glare = task.Of("glare", 0.0);
  wall.seed = static_cast<std::uint64_t>(task.Of("seed", 1.0));
  const SyntheticIntensity pattern = PatternOf(task);
  const double candela = task.Of("candela", 1.0);
  // A card near the lamp hides what lies within this of a direction.
  const double shadow_tan = task.Of("shadow", 0.0), shadow_x = 0.30, shadow_z = -0.25;
  wall.intensity = [&](const Point3& d) {
    const double x = d[0] / d[1], z = d[2] / d[1];
    return std::hypot(x - shadow_x, z - shadow_z) < shadow_tan ? 0.0 : candela * pattern(d);
  };
  const double ambient = task.Of("ambient", 0.0);
  const bool off = task.Of("off", 0.0) > 0.0;
  wall.other_lx = [&](double x, double z) {
    return ambient +
           (off ? 0.0
                : Between(task.places, (x - stated[0]) / distance, (z - stated[2]) / distance));
  };
  if (off) wall.intensity = [](const Point3&) { return 0.0; };
  if (shadow_tan > 0.0) {
    const double far = -wall.lamp[1];
    const auto box = PixelsAround(wall, wall.lamp[0] + shadow_x * far,
                                  wall.lamp[2] + shadow_z * far, shadow_tan * far);
    std::printf("%d, %d, %d, %d\n", box[0], box[1], box[2], box[3]);
  }
  std::vector<float> nits =
      task.numbers.contains("lamp_red") ? InColours(task, wall) : PhotographWall(wall);
  for (float& value : nits) value *= static_cast<float>(task.Of("scale", 1.0));
  return WriteWallPicture(out, wall, nits) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) { return argc == 3 ? PhotographLitWall(argv[1], argv[2]) : 2; }
