// SPDX-License-Identifier: Apache-2.0
// What `lightcal dome` writes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "dome/dome_work.h"
#include "lightcal/core/result.h"
#include "lightcal/photometry/exposure.h"
#include "output_files.h"

namespace lightcal::app {

struct DomeColors {
  std::optional<RgbSpace> space;  // absent: the file's own primaries, else Rec. 709
  std::optional<Xy> white;        // what becomes the space's white; luminance stays
};

// The chromaticities of a written dome.
[[nodiscard]] RgbPrimaries PrimariesOfOutput(const MeasuredDome& measured,
                                             const DomeColors& colors);
// A light's colour as the written dome has it.
[[nodiscard]] std::optional<Xy> ColorInOutput(const MeasuredDome& measured,
                                              const DomeColors& colors, std::optional<Xy> xy);

// The dome as it was read, turned north and tone-mapped, every light ringed and named, those that
// will be taken out in full lines.
[[nodiscard]] Result<OutputFile> DomePreview(const std::string& path, const MeasuredDome& measured,
                                             const std::vector<std::string>& names,
                                             std::size_t extracted);

// The first `extracted` lights leave the dome, which then is turned north and converted:
//   sample = L / L_max of the plate's exposure, or cd/m^2 without one; whiteLuminance says which.
// measured.input.dome.nits stay cd/m^2.
void FinishDome(std::size_t extracted, const DomeColors& colors,
                const std::optional<CameraSettings>& plate, MeasuredDome& measured);

// The finished dome as a lat-long OpenEXR of 32 bit floats. `measured` must outlive the call.
[[nodiscard]] OutputWriter DomeExr(const std::string& path, const MeasuredDome& measured,
                                   const DomeColors& colors,
                                   const std::optional<CameraSettings>& plate,
                                   std::size_t extracted);

}  // namespace lightcal::app
