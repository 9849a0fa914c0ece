// SPDX-License-Identifier: Apache-2.0
// A light as a preset file says it, read back, and the lux it gives. Shares nothing with the
// exporters: its own constants, axes, cone laws and integration.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/vec3.h"
#include "lightcal/light/intensity_table.h"

namespace lightcal {

enum class EngineLightKind : std::uint8_t { kPoint, kSpot, kSun, kFlat, kTube, kDome, kTable };
// Over the cosine from outer to inner: squared, smoothstep; over the angle: smoothstep, linear;
// 1 - u^power with u = (1 - cos)/(1 - cos outer).
enum class ConeLaw : std::uint8_t { kSquared, kSmooth, kSmoothInAngle, kLinearInAngle, kPower };
struct ConeOfLaw {
  ConeLaw law = ConeLaw::kSquared;
  double inner_rad = 0.0, outer_rad = 0.0;
  double power = 1.0;
};
// Of the intensity on the axis, at an angle whose cosine that is.
[[nodiscard]] double ConeAt(const ConeOfLaw& cone, double cosine);

// Z up, metres. emitted has the colour's luminance in it: cd of a point or spot, lx of a sun, cd/m2
// of a flat source (round: a disk), a tube or a dome, a factor on a table's candela.
struct EngineLight {
  std::string name;
  EngineLightKind kind = EngineLightKind::kPoint;
  double emitted = 0.0;
  Vec3 position_m{}, aim{0.0, 0.0, -1.0};
  Vec3 x{1.0, 0.0, 0.0}, y{0.0, 1.0, 0.0};  // a flat source's width and height; a table's C0, C90
  double inner_rad = 0.0, outer_rad = 0.0;
  ConeLaw law = ConeLaw::kSquared;
  double cone_power = 1.0;
  double decay = 2.0;                    // light falls with 1/d^decay
  double range_m = 0.0;                  // of the window (1 - (d/range)^4)^p, clamped; 0 = none
  double window_power = 2.0;             // p: 1 of KHR_lights_punctual
  double width_m = 0.0, height_m = 0.0;  // a tube: its length and its diameter
  bool round = false;
  // Instead of a cone: intensity over that on the axis, at the middles of even steps of half a
  // turn.
  std::vector<double> profile{};
  std::optional<IntensityTable> table;
  double offset_m = 0.0;  // from where distances were measured to the light, of lamps without aim
  bool placed = true;     // false: the file holds neither place nor aim
  // Its colour, linear Rec. 709 of any length. Absent: the file holds none, or a picture does.
  std::optional<Vec3> rgb{};
};

// On a surface of unit normal `normal`.
[[nodiscard]] double LuxAt(const EngineLight& light, const Vec3& point, const Vec3& normal);

// The text of a file that a preset names. Throws std::exception where there is none.
using FileText = std::function<std::string(const std::string& name)>;

// What one kind of file says, in its own words. Throws std::exception with what is wrong.
using PresetReader = std::vector<EngineLight>(const std::string& text, const FileText& beside);

}  // namespace lightcal
