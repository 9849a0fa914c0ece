// SPDX-License-Identifier: Apache-2.0
// What engines make of measured lights: the figures to type in, and the lux they would show.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lightcal {

// A figure to type into an engine: one card of a light.
struct EngineFigure {
  std::string light;   // name of the light
  std::string engine;  // "Unreal Engine"
  std::string field;   // "SpotLight · Intensity"
  std::string value;   // "1934.2", plain digits that can be pasted
  std::string unit;    // "cd"; "" where the engine's number has none
  // What must be set with it, each "" where nothing must.
  std::string color;   // "1, 0.5155, 0.194 (linear)"
  std::string kelvin;  // "3200 K", instead of a color
  std::string size;    // "radius 0.03 m", which a luminance is of
  std::string cone;    // "Outer Angle 50°, Inner Angle 60 %"
  std::string with;    // "Attenuation 2", without which the number is another lamp
  std::string file;    // ".ies", exported beside it
  std::string before;  // in earlier versions: "before Blender 4.0 17.71 W"
  std::string place;   // "stands 30 cm behind the point its distances were measured from"
  std::string note;    // all of it, and what the engine makes otherwise
};

// A white card under a panorama, facing one way.
struct WayLux {
  std::string_view way;  // "up", "down", "front", "right", "back", "left"
  double expected_lx = 0.0;
  double engine_lx = 0.0;
};

// What an engine makes of a light where a meter stood.
struct ParityRow {
  std::string light;
  std::string engine;
  double distance_m = 0.0;   // from the lamp's reference point; 0 for lights at infinity
  double expected_lx = 0.0;  // what the measured lamp gives there
  double engine_lx = 0.0;    // what the engine's own law makes of the numbers in its file
  std::string law;           // "1/d², range 164 m"
  std::string executed;      // how its exporter was checked: "rendered in Cycles 3.4: ..."
  bool rendered = false;     // whether that ran the engine itself
  // Of a beam: the largest difference in any direction to 5 degrees beyond its edge, over the axial
  // intensity, and where.
  std::optional<double> off_axis;
  double off_axis_deg = 0.0;
  std::vector<WayLux> around{};  // of a dome with a picture, where the engine's law is published
};

struct EngineAnswers {
  std::vector<EngineFigure> figures;
  std::vector<ParityRow> parity;
};

}  // namespace lightcal
