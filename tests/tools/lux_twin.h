// SPDX-License-Identifier: Apache-2.0
// A random lux session whose lamp is known: what the tests and the bench of `tradeoff` study.
// Includes no header of lightcal.
#pragma once

#include <cmath>
#include <random>
#include <string>

namespace lightcal::test {

struct LuxTwin {
  std::string toml;  // of its session
  double intensity_cd = 0.0;
  // The readings are those of the lamp described: not so in a room, whose walls' light they lack,
  // nor before a panel, whose nearness they understate.
  bool exact = true;
};

// 4 to 8 readings of a bulb, disk or panel, in a room or not, by a meter of 0.5 to 5 %.
inline LuxTwin RandomLuxTwin(std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::normal_distribution<double> normal;
  LuxTwin twin;
  const double sigma = std::pow(10.0, -2.3 + share(random));
  twin.intensity_cd = std::pow(10.0, 1.0 + 3.0 * share(random));
  const double offset = 0.05 * share(random) - 0.02;
  const int kind = static_cast<int>(3.0 * share(random));
  std::string& text = twin.toml;
  text = "lightcal = 1\nname = \"twin\"\n";
  const bool in_room = share(random) < 0.5;
  if (in_room) {
    text += "[room]\nsize_m = [6.0, 5.0, 2.8]\nreflectance = " +
            std::to_string(0.1 + 0.6 * share(random)) + "\n";
  }
  text += "[[light]]\nname = \"key\"\n";
  twin.exact = !in_room && kind != 2;
  if (kind == 0) text += "kind = \"point\"\n";
  if (kind == 1) text += "kind = \"disk\"\ndiameter_m = 0.2\naim = [1, 0, 0]\n";
  if (kind == 2) text += "kind = \"rect\"\nsize_m = [0.6, 0.3]\naim = [1, 0, 0]\n";
  text += "[[meter]]\nname = \"m\"\nsigma_relative = " + std::to_string(sigma) + "\n";
  // In the room the meter stays inside it: 2.2 m from the lamp in its middle.
  const int count = 4 + static_cast<int>((in_room ? 2.0 : 5.0) * share(random));
  for (int i = 0; i < count; ++i) {
    const double d = 0.5 * std::pow(1.45, i);
    const double area = kind == 0 ? 0.0 : kind == 1 ? 0.01 : 0.018;
    const double lux =
        twin.intensity_cd / ((d + offset) * (d + offset) + area) * std::exp(sigma * normal(random));
    text += "[[reading]]\nlight = \"key\"\nmeter = \"m\"\ndistance_m = " + std::to_string(d) +
            "\nilluminance_lx = " + std::to_string(lux) + "\n";
  }
  return twin;
}

}  // namespace lightcal::test
