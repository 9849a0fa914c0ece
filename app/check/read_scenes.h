// SPDX-License-Identifier: Apache-2.0
// Scene files in formats of their own, and what the readers of all preset files share. These throw
// std::exception with what is wrong; LightsOfPreset turns it into bad_preset.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "check/engine_light.h"

namespace lightcal::app {

// The text of a file that a preset names.
using FileText = std::function<std::string(const std::string& name)>;

// A .tscn of Godot 4 with physical light units. Keys that are absent have the engine's defaults, so
// that a scene saved by the editor reads as it renders.
[[nodiscard]] std::vector<EngineLight> LightsOfGodotScene(const std::string& text);

// A .usda, UsdLux: nits at intensity 1, lights below untransformed parents.
[[nodiscard]] std::vector<EngineLight> LightsOfUsda(const std::string& text,
                                                    const FileText& beside);

// Makes it a table light with the candela of an IES or EULUMDAT file, and its luminaire's name
// where the light has none.
void TakeTable(EngineLight& light, const std::string& photometric);

// Y up to Z up.
[[nodiscard]] inline Vec3 Stood(const Vec3& v) { return {v[0], -v[2], v[1]}; }

// Throws where a light has a NaN or infinity.
void RequireFinite(const std::vector<EngineLight>& lights);
// The value; throws where it is not above 0, naming `what`.
[[nodiscard]] double Above0(const std::string& what, double value);

// All finite numbers in "Color(1, .5, 0, 1)" or "( (1, 0), (0, 1) )", or one alone.
[[nodiscard]] std::vector<double> NumbersIn(std::string_view text);

}  // namespace lightcal::app
