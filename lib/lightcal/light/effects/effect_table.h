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
    {"distance_offset", 0.5, "light.fixture", effects::FindDistanceOffset},
    {"ambient", 0.5, "reading.lamp = off", effects::FindAmbient},
    {"finite_source", 5.5, "light.size_m, light.diameter_m", effects::FindFiniteSource},
    {"sphere_surface", 0.5, "light.position_m", effects::FindSphereSurface},
    {"horizon", 0.5, "reading.position_m, reading.normal", effects::FindHorizon},
    {"meter_tilt", 3.5, "reading.tilt_deg", effects::FindMeterTilt},
    {"distance_error", 0.5, "light.distance_sigma_m", effects::FindDistanceError},
    {"room_bounce", 9400.0, "reading.shadow_card, room.size_m", effects::FindRoomBounce},
    {"detector_size", 7.5, "meter.head_radius_m", effects::FindDetectorSize},
    {"spectral_mismatch", 0.5, "meter.spectral_f1", effects::FindSpectralMismatch},
    {"cosine_response", 0.5, "meter.cosine_f2", effects::FindCosineResponse},
    {"haze", 3.0, "room.haze_per_m", effects::FindHaze},
    {"narrow_beam", 22.0, "light.beam_deg, light.diameter_m", effects::FindNarrowBeam},
    {"mains", 0.5, "light.lamp_class", effects::FindMains},
    {"flicker", 0.5, "light.flicker_depth, meter.window_s", effects::FindFlicker},
    {"rolling_shutter", 0.5, "capture.rows_s, capture.exposure_s", effects::FindRollingShutter},
    {"warm_up", 0.5, "light.minutes_on", effects::FindWarmUp},
    {"table_interpolation", 0.5, "light.distribution", effects::FindTableInterpolation},
    {"vignetting", 0.5, "capture.camera", effects::FindVignetting},
    {"veiling_glare", 0.5, "capture.lens_glare", effects::FindVeilingGlare},
}};

}  // namespace lightcal
