// SPDX-License-Identifier: Apache-2.0
// A folder of fitted lights, one light.json each.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::app {

struct LibraryLight {
  std::string path;
  FittedLight light;
  Provenance provenance;
};

// $XDG_DATA_HOME/lightcal/lights, ~/.local/share/lightcal/lights where that is not set.
// Fails: no_library (neither it nor HOME is set).
[[nodiscard]] Result<std::string> DefaultLibrary();

// Every light of every light.json in the folder and below, by path, then as in the file. Other
// files are passed over; a light.json that cannot be read is warned about (bad_light).
// Fails: not_found (no such folder).
[[nodiscard]] Result<std::vector<LibraryLight>> LightsInFolder(const std::string& folder,
                                                               Warnings& warnings);

// Each light of the file as a file of its own in the folder: NAME-HASH.json, HASH of the inputs it
// was made from (of the light itself where they are not known). So the same calibration replaces
// itself, a new measurement of a lamp of that name stands beside the old one. Returns the paths.
[[nodiscard]] Result<std::vector<std::string>> AddToLibrary(const LightFile& file,
                                                            const std::string& folder);

// Whether a light can be called that: no other light's file has the name. Fails: exists.
[[nodiscard]] Result<void> RefuseTakenName(const LibraryLight& entry, const std::string& name,
                                           const std::vector<LibraryLight>& all);

// Takes a light out of the library: its file goes. Refused: several_lights (a file that somebody
// put there holds others too). Fails: not_removed.
[[nodiscard]] Result<void> RemoveFromLibrary(const LibraryLight& entry,
                                             const std::vector<LibraryLight>& all);

}  // namespace lightcal::app
