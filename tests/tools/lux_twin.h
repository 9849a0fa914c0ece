// SPDX-License-Identifier: Apache-2.0
// A random lux session whose lamp is known: what the tests and the bench of `tradeoff` study.
// Includes no header of lightcal; light from walls is what tests/tools/traced_rooms traced, panels
// and disks are integrated over their area.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace lightcal::test {

// One ordinary room of the traced table.
struct TracedRoom {
  std::string kind;  // bulb, panel, beam
  double width_m = 0.0, height_m = 0.0, power = 0.0;
  std::vector<double> size_m;
  double reflectance = 0.0;
  std::vector<std::pair<double, double>> lux_per_candela;  // distance in m, all light
};

inline std::vector<TracedRoom> ReadTracedRooms(const std::string& path) {
  constexpr double kDistances[] = {0.5, 0.7, 1.0, 1.5, 2.0, 3.0};
  std::vector<TracedRoom> rooms;
  std::ifstream table(path);
  for (std::string line; std::getline(table, line);) {
    std::vector<std::string> cells;
    std::stringstream cut(line);
    for (std::string cell; std::getline(cut, cell, ',');) cells.push_back(cell);
    if (cells[0] != "ordinary") continue;
    const auto number = [&](std::size_t i) { return std::atof(cells[i].c_str()); };
    TracedRoom room{cells[2], number(3), number(4), number(5), {}, number(9), {}};
    room.size_m = {number(6), number(7), number(8)};
    for (std::size_t k = 0; 13 + 3 * k < cells.size() && !cells[12 + 3 * k].empty(); ++k) {
      room.lux_per_candela.emplace_back(kDistances[k], number(12 + 3 * k) + number(13 + 3 * k));
    }
    rooms.push_back(std::move(room));
  }
  return rooms;
}

// Illuminance on the axis of a Lambertian source of 1 cd there: the mean of d^2/(d^2 + rho^2)^2
// over its area, rho from its middle, by so many pieces that more change nothing a meter sees.
inline double RectangleLux(double width_m, double height_m, double d) {
  constexpr int kPieces = 100;
  double sum = 0.0;
  for (int i = 0; i < kPieces; ++i) {
    for (int k = 0; k < kPieces; ++k) {
      const double x = width_m * ((i + 0.5) / kPieces - 0.5);
      const double y = height_m * ((k + 0.5) / kPieces - 0.5);
      sum += d * d / std::pow(d * d + x * x + y * y, 2);
    }
  }
  return sum / (kPieces * kPieces);
}
inline double DiskLux(double radius_m, double d) {
  constexpr int kRings = 1000;  // of the same area each
  double sum = 0.0;
  for (int i = 0; i < kRings; ++i) {
    const double square = radius_m * radius_m * (i + 0.5) / kRings;
    sum += d * d / std::pow(d * d + square, 2);
  }
  return sum / kRings;
}

struct LuxTwin {
  std::string toml;  // of its session
  double intensity_cd = 0.0;
  bool in_room = false;  // with walls, stated to 5 % of their length and 15 % of their reflectance
};

namespace lux_twin {

inline std::string Line(const std::string& key, double value) {
  return key + " = " + std::to_string(value) + "\n";
}
inline std::string Line(const std::string& key, const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + std::to_string(value);
  return key + " = [" + text + "]\n";
}

// A bulb, a disk or a panel in the dark.
inline std::vector<std::pair<double, double>> DarkLamp(int kind, int count, double offset,
                                                       std::string& keys) {
  constexpr double kDiameter = 0.2, kWidth = 0.6, kHeight = 0.3;
  if (kind == 0) keys = "kind = \"point\"\nfixture = \"bulb\"\n";
  if (kind == 1) keys = "kind = \"disk\"\naim = [1, 0, 0]\n" + Line("diameter_m", kDiameter);
  if (kind == 2) {
    keys =
        "kind = \"rect\"\naim = [1, 0, 0]\n" + Line("size_m", std::vector<double>{kWidth, kHeight});
  }
  std::vector<std::pair<double, double>> lux;
  for (int i = 0; i < count; ++i) {
    const double d = 0.5 * std::pow(1.45, i) + offset;
    lux.emplace_back(d, kind == 0   ? 1.0 / (d * d)
                        : kind == 1 ? DiskLux(0.5 * kDiameter, d)
                                    : RectangleLux(kWidth, kHeight, d));
  }
  return lux;
}

inline std::string KeysOf(const TracedRoom& room) {
  if (room.kind == "panel") {
    return "kind = \"rect\"\naim = [1, 0, 0]\n" +
           Line("size_m", std::vector<double>{room.width_m, room.height_m});
  }
  if (room.kind == "beam") {  // half the intensity at half the beam angle
    const double half = std::acos(std::pow(0.5, 1.0 / room.power));
    return "kind = \"spot\"\naim = [1, 0, 0]\n" + Line("beam_deg", 2.0 * half * 57.29577951308232);
  }
  return "kind = \"point\"\nfixture = \"bulb\"\n";
}

}  // namespace lux_twin

// 4 to 8 readings of a bulb, disk or panel in the dark, or of a bulb, panel or beam in a room, by a
// meter that is off by 0.5 to 5 % in all its readings and by 1 % (or less) in each.
inline LuxTwin RandomLuxTwin(const std::vector<TracedRoom>& rooms, std::mt19937_64& random) {
  using lux_twin::Line;
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::normal_distribution<double> normal;
  LuxTwin twin;
  const double sigma = std::pow(10.0, -2.3 + share(random));
  twin.intensity_cd = std::pow(10.0, 1.0 + 3.0 * share(random));
  const double offset = 0.05 * share(random) - 0.02;
  twin.in_room = share(random) < 0.5;
  std::string keys;
  std::vector<std::pair<double, double>> lux;
  twin.toml = "lightcal = 1\nname = \"twin\"\n";
  if (twin.in_room) {
    const auto at = static_cast<std::size_t>(share(random) * static_cast<double>(rooms.size()));
    const TracedRoom& room = rooms[at];
    std::vector<double> size = room.size_m;
    for (double& side : size) side *= 0.95 + 0.1 * share(random);
    twin.toml += "[room]\n" + Line("size_m", size) +
                 Line("reflectance", room.reflectance * (0.85 + 0.3 * share(random)));
    keys = lux_twin::KeysOf(room);
    lux = room.lux_per_candela;
  } else {
    twin.toml += "[room]\ndark = true\n";
    const int kind = static_cast<int>(3.0 * share(random));
    lux = lux_twin::DarkLamp(kind, 4 + static_cast<int>(5.0 * share(random)), offset, keys);
  }
  twin.toml += "[[light]]\nname = \"key\"\n" + keys + "[[meter]]\nname = \"m\"\n" +
               Line("sigma_relative", sigma);
  const double each = std::min(0.01, sigma);
  const double gain = twin.intensity_cd * std::exp(sigma * normal(random));
  for (const auto& [d, per_candela] : lux) {
    twin.toml += "[[reading]]\nlight = \"key\"\nmeter = \"m\"\n" + Line("distance_m", d - offset) +
                 Line("illuminance_lx", gain * per_candela * std::exp(each * normal(random)));
  }
  return twin;
}

}  // namespace lightcal::test
