// SPDX-License-Identifier: Apache-2.0
// A reading with every effect in it, by brute force: sums over the source and the meter's head,
// pulses counted one by one, a room of patches. No header of the room it judges.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <string_view>

#include "radiosity.h"

namespace lightcal::test {

// The eleven effects of the design's section 3 that one lamp can have at once, by lightcal's names
// (rows 1, 2, 6-11, 13-15; a globe's surface, a tube's length and the horizon belong to other
// lamps).
inline constexpr std::array<std::string_view, 11> kTruthEffects = {
    "finite_source", "narrow_beam", "meter_tilt", "distance_error", "ambient", "room_bounce",
    "detector_size", "flicker",     "warm_up",    "mains",          "haze"};
enum TruthEffect : std::uint8_t {
  kFiniteSource,
  kNarrowBeam,
  kMeterTilt,
  kDistanceError,
  kAmbient,
  kRoomBounce,
  kDetectorSize,
  kFlicker,
  kWarmUp,
  kMains,
  kHaze,
};
inline constexpr unsigned kAllTruthEffects = (1U << kTruthEffects.size()) - 1U;

// A disk that shines as cos^n, a meter, a room; what is stated, and what really is.
struct TruthScene {
  GreyBox box;
  Place lamp{}, aim{}, meter{};  // as stated
  double radius_m = 0.03;
  double beam_rad = 1.0;      // full angle at half the peak
  double distance_m = 1.0;    // stated
  double emission_rad = 0.0;  // off the axis
  double tilt_rad = 0.0;      // stated
  double head_radius_m = 0.005;
  double flicker_hz = 100.0, duty = 0.5, window_s = 0.2;
  double on_for_s = 1800.0;
  double haze_per_metre = 2e-4;
  double ambient_over_direct = 0.01;
  // Known to nobody.
  double slip_m = 0.0;         // of the distance, within 5 mm
  double pointing_rad = 0.0;   // of the tilt, within 3 degrees
  double tilt_turn_rad = 0.0;  // which way the meter is tilted
  double phase = 0.0;          // of the first pulse
  double warm_up_part = 0.2;
  double mains = 0.0;  // within 1 %
};

[[nodiscard]] TruthScene RandomTruthScene(std::mt19937_64& random);

// Everything of a scene that does not change with the effects asked for.
struct TruthParts {
  double point = 0.0;    // direct light of a point [lx/cd]
  double lambert = 1.0;  // what a Lambertian disk makes of it
  double beam = 1.0;     // what a disk of beams makes of it
  double head = 1.0;
  double bounce = 0.0;   // [lx/cd]
  double flicker = 1.0;  // factors of all the lamp's light
  double warm_up = 1.0, mains = 1.0;
};
[[nodiscard]] TruthParts BruteForce(const TruthScene& scene);

// Illuminance per candela with the effects of a bit mask.
[[nodiscard]] double Illuminance(const TruthScene& scene, const TruthParts& parts,
                                 unsigned effects);

}  // namespace lightcal::test
