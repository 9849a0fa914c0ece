// SPDX-License-Identifier: Apache-2.0
// How much light a lens loses towards the corners, from a picture of an evenly lit surface.
#pragma once

#include <optional>
#include <span>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/core/view2d.h"
#include "lightcal/records/camera_profile.h"

namespace lightcal {

// Place of a pixel in units of half the diagonal, from the middle of the picture.
struct FlatPlace {
  double x = 0.0, y = 0.0;
};
[[nodiscard]] FlatPlace FlatPlaceOf(double x_px, double y_px, int width, int height);

// v = 1 + a r^2 + b r^4 + c r^6 of a channel, r from the flat's centre.
[[nodiscard]] double LightThrough(const CameraFlat& flat, std::size_t channel, FlatPlace place);

// Whether v is above 2 % everywhere in a picture of this size, so that it may be divided by.
[[nodiscard]] bool LetsLightThrough(const CameraFlat& flat, int width, int height);

// Least squares over 48 x 32 block means of raw red, green and blue (channels of `raw`, whatever
// unit); the centre from green, with a prior of 0.05 for a picture that does not show one. A radial
// law does not take a panel's unevenness for the lens's, as a grid would; sigma is what it leaves.
// Holds for at least 96 x 64 pixels.
// Refused: flat_too_dark (a block without light), flat_uneven (more than 3 % left: not evenly lit,
// not in the middle), too_small.
[[nodiscard]] Result<CameraFlat> FitFlatField(View2d<const float> raw, double f_number,
                                              std::optional<Metres> focal_length);

// cos^4 of the field angle, an ideal thin lens's own loss, as coefficients: a prior where no flat
// was taken, sigma half of its mean loss. half_diagonal: of the sensor.
//   cos^4 = 1/(1 + s^2)^2,  s = r half_diagonal/focal length;  fitted to r = 1 within 0.1 % for
// s <= 0.7
[[nodiscard]] CameraFlat CosineFourthFlat(Metres half_diagonal, Metres focal_length,
                                          double f_number);

// The flat for an aperture: the one taken there (within a sixth of a stop), else between its two
// neighbours, linear in log N, with half their mean difference in sigma.
// Refused: flat_missing (the aperture lies outside those taken, or none has this focal length).
[[nodiscard]] Result<CameraFlat> FlatFor(std::span<const CameraFlat> flats, double f_number,
                                         std::optional<Metres> focal_length);

}  // namespace lightcal
