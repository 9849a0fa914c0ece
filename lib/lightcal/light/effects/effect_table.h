// SPDX-License-Identifier: Apache-2.0
// Every effect lightcal knows, in one table.
#pragma once

#include <array>

#include "lightcal/light/effects/ambient.h"
#include "lightcal/light/effects/cosine_response.h"
#include "lightcal/light/effects/detector_size.h"
#include "lightcal/light/effects/distance_error.h"
#include "lightcal/light/effects/distance_offset.h"
#include "lightcal/light/effects/effect.h"
#include "lightcal/light/effects/engine_window.h"
#include "lightcal/light/effects/finite_source.h"
#include "lightcal/light/effects/flicker.h"
#include "lightcal/light/effects/haze.h"
#include "lightcal/light/effects/horizon.h"
#include "lightcal/light/effects/mains.h"
#include "lightcal/light/effects/meter_tilt.h"
#include "lightcal/light/effects/narrow_beam.h"
#include "lightcal/light/effects/noise.h"
#include "lightcal/light/effects/rolling_shutter.h"
#include "lightcal/light/effects/room_bounce.h"
#include "lightcal/light/effects/sh_truncation.h"
#include "lightcal/light/effects/spectral_mismatch.h"
#include "lightcal/light/effects/spectral_step.h"
#include "lightcal/light/effects/sphere_surface.h"
#include "lightcal/light/effects/storage.h"
#include "lightcal/light/effects/table_interpolation.h"
#include "lightcal/light/effects/veiling_glare.h"
#include "lightcal/light/effects/vignetting.h"
#include "lightcal/light/effects/warm_up.h"

namespace lightcal {

inline constexpr std::array<Effect, 25> kEffects = {{
    {"distance_offset", 1.0, effects::FindDistanceOffset},
    {"ambient", 2.0, effects::FindAmbient},
    {"finite_source", 18.0, effects::FindFiniteSource},
    {"sphere_surface", 2.0, effects::FindSphereSurface},
    {"horizon", 3.0, effects::FindHorizon},
    {"meter_tilt", 5.0, effects::FindMeterTilt},
    {"distance_error", 3.0, effects::FindDistanceError},
    {"room_bounce", 1700.0, effects::FindRoomBounce},
    {"detector_size", 5.0, effects::FindDetectorSize},
    {"spectral_mismatch", 400.0, effects::FindSpectralMismatch},
    {"cosine_response", 10.0, effects::FindCosineResponse},
    {"haze", 8.0, effects::FindHaze},
    {"narrow_beam", 25.0, effects::FindNarrowBeam},
    {"mains", 15.0, effects::FindMains},
    {"flicker", 30.0, effects::FindFlicker},
    {"rolling_shutter", 30.0, effects::FindRollingShutter},
    {"warm_up", 20.0, effects::FindWarmUp},
    {"table_interpolation", 40.0, effects::FindTableInterpolation},
    {"sh_truncation", 60.0, effects::FindShTruncation},
    {"engine_window", 3.0, effects::FindEngineWindow},
    {"vignetting", 5.0, effects::FindVignetting},
    {"veiling_glare", 10.0, effects::FindVeilingGlare},
    {"noise", 1.0, effects::FindNoise},
    {"spectral_step", 100.0, effects::FindSpectralStep},
    {"storage", 1.0, effects::FindStorage},
}};

}  // namespace lightcal
