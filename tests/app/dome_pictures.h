// SPDX-License-Identifier: Apache-2.0
// Synthetic skies and lit rooms as files, and `lightcal dome` driven on them.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "run_cli.h"
#include "synthetic_sky.h"

namespace lightcal::test::dome {

using Words = std::vector<std::string>;
inline const Ray kUp = {0.0, 0.0, 1.0};

inline std::string Text(double v) { return std::to_string(v); }

// A file of a picture's RGB divided by nits_per_unit; with absolute it says so (whiteLuminance).
std::string WritePicture(const TempDir& folder, const std::string& name, const SkyPicture& picture,
                         double nits_per_unit = 1.0, bool absolute = false);
SkyPicture ReadPictureFile(const std::string& path);

nlohmann::json DomeJson(const std::string& picture, const std::string& output, Words more);
CliResult Dome(const std::string& picture, const std::string& output, const Words& more);
// Exit 3 with this code, and nothing written.
void ExpectRefused(const std::string& picture, const std::string& output, const std::string& code,
                   Words more);
bool Warns(const nlohmann::json& document, const std::string& code);

// E of a plane by a lat-long picture alone: the sum over its pixels' middles.
double LuxOfPicture(const SkyPicture& picture, const Ray& normal, double nits_per_unit = 1.0);
// E of a plane by the directional lights of a light.json.
double LuxOfLights(const nlohmann::json& light_file, const Ray& normal);

// The listed light nearest to a direction.
struct Found {
  nlohmann::json light;
  double off_deg = 180.0;
};
Found LightAt(const nlohmann::json& document, const Ray& direction);

// A clear sky over ground, with the sun's aureole; no sun.
SkyScene ClearSky(const Ray& sun);
// The sun: 90 klx, half a degree, darker at its limb.
SkyLamp Sun(const Ray& direction);

}  // namespace lightcal::test::dome
