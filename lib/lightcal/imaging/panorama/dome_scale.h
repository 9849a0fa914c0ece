// SPDX-License-Identifier: Apache-2.0
// A lux meter's reading -> what a panorama's numbers are in cd/m^2, or what a clipped light is.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"
#include "lightcal/imaging/panorama/dome_lights.h"

namespace lightcal {

// Taken where the panorama was.
struct DomeReading {
  Lux illuminance{0.0};
  double sigma_relative = 0.05;
  Vec3 normal{0.0, 0.0, 1.0};  // where the meter faced; unit
  std::optional<Lux> shaded;   // the same with a card between the meter and one light
};

struct DomeScale {
  double factor = 1.0;       // what samples and lights were multiplied by
  double read_factor = 1.0;  // what the reading alone asked for
  double read_weight = 1.0;  // of the reading in the factor, beside the picture's own scale
  double sd_relative = 0.0;  // of the samples' scale; 0 where no reading gave it
  double range_ln = 0.0;     // half of what light that the picture may lack leaves open, in ln
  // Lights whose illuminance is the reading minus the rest; their relative sd.
  int inferred = 0;
  double inferred_sd_relative = 0.0;
  // Where a card took away less than the light's pixels give: what of it. Else 1.
  double shading_of_pixels = 1.0;
};

// What lights that may be clipped give a plane at most, whose rest gives it `rest_lx` [lx]:
// nineteen times that, which more than the sun under a clear sky hardly does, and twice what they
// show; one that may be the sun, above the horizon and small, no more than the sun outside the
// atmosphere: 138 klx at perihelion (133.3 at mean distance: Darula, Kittler, Gueymard 2005).
[[nodiscard]] double MostOfCutOff(std::span<const DomeLight* const> lights, const Vec3& normal,
                                  double rest_lx);

// Whether a meter that faces so sees a light well enough to measure it.
[[nodiscard]] bool LightsMeter(const DomeLight& light, const Vec3& normal);

// What two readings say of a light that a card may have kept from the meter: E_shaded / E is
// R / E(n), within what two readings differ by, where its pixels hold all its light.
enum class ShadingBy : std::uint8_t { kNotSeen, kLess, kAsPixelsSay, kMore };
[[nodiscard]] ShadingBy ShadingOf(const DomeReading& reading, double all_lux,
                                  const DomeLight& light);

// Whether the card took away more than two readings differ by.
[[nodiscard]] bool TookLight(const DomeReading& reading);

// With E(n) = integral of L max(0, n . w) dOmega over the whole panorama, R = E(n) - the lights
// that are solved for (their flow . n), and d a light's direction:
//   no light clipped, none shaded      factor = E_lux / E(n)
//   `shaded` given                     factor = E_shaded / R, and the light that was shaded gives
//                                      (E_lux - E_shaded) / (n . d) at normal incidence: the
//                                      clipped one, else that whose pixels are best what the card
//                                      took away, else the brightest
//   lights that may be clipped lit the meter, none shaded, the unit unknown
//                                      factor = the geometric mean of E_lux / E(n), the picture as
//                                      it is, and of the least: (E_lux - the most that these lights
//                                      give) / R; range_ln reaches from one to the other; these
//                                      lights share what is left: E_lux = factor R + theirs
//   lights clipped, the scale absolute   factor = 1; the clipped light gives (E_lux - R) / (n . d);
//                                      several share one luminance. One reading cannot give both:
//                                      their sd is that of E_lux and of the scale's part of R
// The samples of dome and lights are multiplied. A picture that states how sure its scale is
// (`stated_sd`, relative; in cd/m^2) keeps its part in ln(factor), by 1/sd^2, unless it is more
// than two standard deviations from the reading, which is then believed alone. Refused: no_light
// (E(n) or R not above 0), lux_below_rest (the rest alone exceeds the reading), lux_misses_light
// (the meter faced away from the light to be solved), clipped_scale_unknown (a clipped light in a
// panorama whose scale nobody knows), several_clipped (the shaded reading holds the others),
// shaded_light_unknown (a card took away more than any light's pixels give, and which is clipped
// cannot be told).
[[nodiscard]] Result<DomeScale> ScaleDome(const DomeReading& reading, bool absolute,
                                          std::optional<double> stated_sd, Dome& dome,
                                          std::vector<DomeLight>& lights);

}  // namespace lightcal
