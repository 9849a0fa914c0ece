// SPDX-License-Identifier: Apache-2.0
// Bright bodies of a panorama -> directional lights, and the panorama without them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/core/matrix3.h"
#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"
#include "lightcal/core/view2d.h"
#include "lightcal/imaging/panorama/bright_bodies.h"
#include "lightcal/imaging/panorama/latlong_grid.h"

namespace lightcal {

// A sun seen through haze or blurred is no wider.
inline constexpr Radians kWidestSun = RadiansFromDegrees(5.0);

// A lat-long panorama in cd/m^2.
struct Dome {
  int width = 0, height = 0, channels = 1;
  std::vector<float> samples;  // row after row; of 3 channels (1, 1, 1) is 1 cd/m^2 of white
  std::vector<float> nits;     // their luminance
  Matrix3 xyz_from_rgb = XyzFromRgbMatrix(RgbSpace::kSrgb);  // of 3 channels

  [[nodiscard]] View2d<const float> luminance() const { return {nits.data(), width, height}; }
  [[nodiscard]] LatLongGrid grid() const { return {width, height}; }
  void Multiply(double factor);
};

// Colour of what falls on a level plane that looks up: the mean over the upper half, weighted by
// the cosine. Absent where the picture is without colour or black.
[[nodiscard]] std::optional<Xy> XyFromAbove(const Dome& dome);

// One light, as it shines into the middle of the panorama.
//   flow = integral of (L - fill) w dOmega  [lx],  illuminance = |flow| (at normal incidence),
//   direction = flow / |flow|;
// so a plane of normal n wholly in front of it gets n . flow, and light and fill together are
// exactly what the picture held.
struct DomeLight {
  BrightBody body;
  Vec3 flow{};
  Vec3 direction{0.0, 0.0, 1.0};  // from the panorama's middle towards the light
  Lux illuminance{0.0};
  // Second moments of what was taken, less those of a pixel: a uniform disc of diameter 4 sd and a
  // uniform rectangle of sides sqrt(12) sd have them.
  Radians angular_diameter{0.0};
  Radians angular_width{0.0}, angular_height{0.0};  // along the horizon, and across
  Steradians solid_angle{0.0};                      // of that disc; at least one pixel
  Nits luminance{0.0};                              // illuminance / solid_angle
  std::optional<Xy> xy;                             // of a picture with colour
  double background_sd_relative = 0.0;  // what the unevenness around may have added or hidden
  bool inferred = false;                // illuminance is from readings, not from the pixels
  bool maybe_clipped = false;           // it ends where the picture does
  // Of one that may be clipped, in a known unit: the ends of its illuminance's interval, where they
  // are not those of the scale.
  std::optional<Lux> at_least, at_most;
  std::vector<float> fill;  // samples that go to body.pixels when it is taken out
};

// What bodies bring above a smooth continuation of what surrounds them: each pixel's fill is the
// mean of a ring three pixels wide around the body, in at most 256 arcs, weighted by 1/distance^3.
// A body that brings nothing is left out. Largest illuminance first.
// The colour of a clipped body is that of its unclipped pixels which are 3 times their fill and
// more, or absent.
[[nodiscard]] std::vector<DomeLight> MeasureDomeLights(const Dome& dome,
                                                       std::vector<BrightBody> bodies,
                                                       std::span<const std::uint8_t> clipped = {});

// As bright as the sun alone can be (2e7 cd/m^2) and small.
[[nodiscard]] bool IsBrightAsSun(const DomeLight& light);

// Puts the light's fill in its place, in samples and luminance.
void TakeOut(const DomeLight& light, Dome& dome);

// A light whose readings say that it gives this illuminance at normal incidence.
void InferIlluminance(Lux illuminance, DomeLight& light);

}  // namespace lightcal
