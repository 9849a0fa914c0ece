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
#include "lightcal/light/effects/finite_source.h"
#include "lightcal/light/effects/flicker.h"
#include "lightcal/light/effects/haze.h"
#include "lightcal/light/effects/horizon.h"
#include "lightcal/light/effects/mains.h"
#include "lightcal/light/effects/meter_tilt.h"
#include "lightcal/light/effects/narrow_beam.h"
#include "lightcal/light/effects/rolling_shutter.h"
#include "lightcal/light/effects/room_bounce.h"
#include "lightcal/light/effects/spectral_mismatch.h"
#include "lightcal/light/effects/sphere_surface.h"
#include "lightcal/light/effects/table_interpolation.h"
#include "lightcal/light/effects/veiling_glare.h"
#include "lightcal/light/effects/vignetting.h"
#include "lightcal/light/effects/warm_up.h"

namespace lightcal {

inline constexpr std::array<Effect, 20> kEffects = {{
    {"distance_offset", 1.0, "light.fixture", effects::FindDistanceOffset},
    {"ambient", 2.0, "reading.lamp = off", effects::FindAmbient},
    {"finite_source", 18.0, "light.size_m, light.diameter_m", effects::FindFiniteSource},
    {"sphere_surface", 2.0, "light.position_m", effects::FindSphereSurface},
    {"horizon", 3.0, "reading.position_m, reading.normal", effects::FindHorizon},
    {"meter_tilt", 5.0, "reading.tilt_deg", effects::FindMeterTilt},
    {"distance_error", 3.0, "reading.position_m", effects::FindDistanceError},
    {"room_bounce", 1700.0, "reading.shadow_card, room.size_m", effects::FindRoomBounce},
    {"detector_size", 5.0, "meter.head_radius_m", effects::FindDetectorSize},
    {"spectral_mismatch", 400.0, "meter.spectral_f1", effects::FindSpectralMismatch},
    {"cosine_response", 10.0, "meter.cosine_f2", effects::FindCosineResponse},
    {"haze", 8.0, "room.haze_per_m", effects::FindHaze},
    {"narrow_beam", 25.0, "light.beam_deg, light.diameter_m", effects::FindNarrowBeam},
    {"mains", 15.0, "light.lamp_class", effects::FindMains},
    {"flicker", 30.0, "light.flicker_depth, meter.window_s", effects::FindFlicker},
    {"rolling_shutter", 30.0, "capture.rows_s, capture.exposure_s", effects::FindRollingShutter},
    {"warm_up", 20.0, "light.minutes_on", effects::FindWarmUp},
    {"table_interpolation", 40.0, "light.distribution", effects::FindTableInterpolation},
    {"vignetting", 5.0, "capture.camera", effects::FindVignetting},
    {"veiling_glare", 10.0, "capture.lens_glare", effects::FindVeilingGlare},
}};

}  // namespace lightcal
