// SPDX-License-Identifier: Apache-2.0
// Panorama files -> a calibrated environment, and its lights as lights.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/calibrate/dome/read_dome.h"
#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/core/result.h"
#include "lightcal/photometry/exposure.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/sources.h"

namespace lightcal {

inline constexpr std::size_t kEveryLight = std::numeric_limits<std::size_t>::max();
inline constexpr std::size_t kMostDomeLights = 32;  // named, and taken out as "every light"
inline constexpr int kPreviewWidth = 1024;

inline constexpr const char* kDomePicture = "dome.exr";  // what the made dome is saved as

struct DomeSettings {
  std::size_t extract = 0;              // so many of the brightest lights leave the dome
  std::optional<RgbSpace> space;        // absent: the file's own primaries, else Rec. 709
  std::optional<Xy> white;              // what becomes the space's white; luminance stays
  std::optional<CameraSettings> plate;  // the dome as this exposure sees it, saturating at 1
  std::string time{};                   // of provenance, ISO 8601; "" = unknown
};

// What a plane in the middle of the dome gets.
struct DomePlane {
  std::string name;  // "up" "down" "front" "right" "back" "left" "reading"
  Vec3 normal;
  double total = 0.0, lights = 0.0, remaining = 0.0;  // [lx], of those taken out and of the rest
  std::optional<double> most{};  // of `remaining`, where it holds light that may be clipped
};

struct MadeDome {
  // Its dome without the lights that were taken out, turned north and converted:
  //   sample = L / L_max of the plate's exposure, or cd/m^2 without one
  // input.dome.nits stay cd/m^2. Colours of lights are as the dome has them.
  MeasuredDome measured;
  std::vector<std::string> names;  // of its lights
  std::size_t extracted = 0;       // the first so many were taken out
  // These, then the dome itself (kind dome, "environment", as kDomePicture) unless it is black from
  // above; with provenance.
  LightFile light_file;
  Dome preview;  // as it was read, turned north, at most about kPreviewWidth pixels wide
  std::vector<DomePlane> planes;
  Nits white_luminance{1.0};  // of a sample of 1
  Warnings warnings;          // those of `measured` left out: fewer_lights, and what a fit warns of
};

// Refused: not_positive (a plate no camera takes), bad_chromaticity (of the white), and as
// LightFileOfDome. Fails: as Sources::sha256.
[[nodiscard]] Result<MadeDome> MakeDome(MeasuredDome measured, const DomeRequest& request,
                                        const Sources& sources, const DomeSettings& settings);

// Files of one lat-long panorama.   Refused besides: as MeasureDome.
[[nodiscard]] Result<MadeDome> MakeDome(const std::vector<std::string>& files,
                                        const Sources& sources, const DomeSettings& settings);

// The chromaticities of the made dome.
[[nodiscard]] RgbPrimaries PrimariesOfOutput(const MeasuredDome& measured,
                                             const DomeSettings& settings);

}  // namespace lightcal
