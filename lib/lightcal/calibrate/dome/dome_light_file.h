// SPDX-License-Identifier: Apache-2.0
// Lights of a dome as lights and readings of a session: from here on nobody knows that they were
// seen in a panorama.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lightcal/imaging/panorama/measure_dome.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal {

// Wider than this a light is an area light: shadows and highlights tell.
inline constexpr double kAreaLightDegrees = 10.0;

// "sun" for what is as bright as the sun alone can be (2e7 cd/m^2) and small; "light-1" ... for
// the others, by their order.
[[nodiscard]] std::vector<std::string> NamesOfLights(const MeasuredDome& measured,
                                                     std::size_t count);

// A directional light: shines along the opposite of where it was seen.
[[nodiscard]] LightDescription DirectionalLight(const MeasuredDome& measured, std::size_t index,
                                                std::string name);
// Its illuminance at normal incidence and, of pictures with colour, its chromaticity.
[[nodiscard]] Reading ReadingOfLight(const MeasuredDome& measured, std::size_t index,
                                     std::string name);

// The first `count` lights, fitted as every session is. A light wider than kAreaLightDegrees
// becomes a rect of its luminance and angular size, facing the middle from 1 m away.
[[nodiscard]] Result<LightFile> LightFileOfDome(const MeasuredDome& measured, std::size_t count,
                                                Warnings& warnings);

}  // namespace lightcal
