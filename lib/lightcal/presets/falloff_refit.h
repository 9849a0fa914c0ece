// SPDX-License-Identifier: Apache-2.0
// Range and intensity that make an engine's own falloff give the lux that were read.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/photometry/falloff_windows.h"
#include "lightcal/presets/preset_light.h"

namespace lightcal {

// How an engine lets light fall off: a law of photometry/falloff_windows.h.
struct EngineFalloff {
  // Illuminance per candela [1/m^2] at distance d with range r, decay 2.
  double (*per_candela)(Metres d, Metres r) = nullptr;
  WindowPower window = WindowPower::kSquared;
};

struct FalloffRefit {
  Metres range{0.0};
  double intensity_factor = 1.0;
  // Largest |E_engine/E_lamp - 1| over the distances, after the refit.
  double residual = 0.0;
};

// Range first: `wanted`, or far, but never so near that the window takes more than 0.5 % at the
// farthest distance (4.47 d_max for a squared window, 3.76 d_max for a plain one) unless
// `fixed`. Intensity second: with g_j = falloff(d_j) d_j^2,
//   factor = 1/sqrt(min g max g),   residual = sqrt(max g/min g) - 1,
// the factor of least worst error; one nearer to 1 than a float can tell is 1. A distance beyond a
// fixed range has g = 0: nothing repairs that, its residual is 1.   No distances: 1 m.   Holds for
// distances, ranges above 0.
struct RefitRequest {
  EngineFalloff falloff;
  Metres far_range{10000.0};      // where nobody fixed one
  std::optional<Metres> fixed{};  // the person's
};
[[nodiscard]] FalloffRefit RefitFalloff(const RefitRequest& request,
                                        std::span<const double> distances_m);

// Distances from the effective source at which a lamp's used readings stood; 1 m when none did.
[[nodiscard]] std::vector<double> ReadingDistances_m(const FittedLight& lamp);

// One a light; identity for lights at infinity. Each fixed range whose residual exceeds
// max(0.5 %, u95 of the intensity) is warned (falloff_residual, with the range that would do).
[[nodiscard]] std::vector<FalloffRefit> RefitLights(const LightFile& file,
                                                    std::span<const PresetLight> lights,
                                                    const RefitRequest& request,
                                                    Warnings& warnings);
[[nodiscard]] std::vector<FalloffRefit> RefitLights(const LightFile& file,
                                                    std::span<const PunctualLight> lights,
                                                    const RefitRequest& request,
                                                    Warnings& warnings);

// falloff_intensity_factor and falloff_residual, for preset.json.
void NoteRefit(const FalloffRefit& refit, DerivedLight& light);

}  // namespace lightcal
