// SPDX-License-Identifier: Apache-2.0
// How far a camera's luminance is off because its eyes are not V(lambda), and the correction for a
// class of lamps: a mean that is taken out and a sigma that remains.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "lightcal/colorimetry/camera_neutral.h"
#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/records/camera_sensitivities.h"
#include "lightcal/records/capture.h"

namespace lightcal {

// True luminance / luminance as read, for lamps of one class:
//   F = at_middle + per_mired (m - middle),   m in mireds as the camera sees the lamp,
// m held within the lamps F was fitted on.
struct MismatchFactor {
  double at_middle = 1.0;
  double per_mired = 0.0;
  double middle_mired = 250.0;
  double least_mired = 250.0, most_mired = 250.0;
  // What remains for one further lamp of the class, relative, such that +-kZ95 sigma holds 95 %:
  // the root mean square error of predicting each lamp from the others, times Student's factor for
  // so few lamps.
  double sigma = 0.0;

  [[nodiscard]] double At(Mireds lamp) const;
};

// One lamp that a factor is fitted on, or judged by.
struct LampSeen {
  double mired = 250.0;  // as the camera sees it; nearest the locus where it has none
  double factor = 1.0;   // true luminance / luminance read
};

// Constant for fewer than five lamps or less than 30 mired between them, else a line, by least
// squares. Where predicting each lamp from the others this way leaves more than four fifths of the
// error that factor 1 has, factor 1 stands, with its own error as sigma: so few lamps do not tell.
// Factor 1 always for lamps of unknown class and high-CRI LEDs, which err to both sides.
// Leaving out each measured lamp over 52 cameras (tests/imaging/spectral_mismatch_test.cc), rms:
//   white LED 3.9 -> 1.5 %, RGB LED 6.5 -> 4.1 %, tungsten 2.6 -> 0.2 %; high CRI 1.5 %.
// Refused: no_lamps.
[[nodiscard]] Result<MismatchFactor> FitMismatchFactor(LampClass lamp,
                                                       std::span<const LampSeen> lamps);

// A camera of known sensitivities, its raw channels scaled so that D65 of Y = 1 gives green 1.
class SpectralCamera {
 public:
  // Refused: bad_sensitivities (the channels cannot tell colours apart).
  [[nodiscard]] static Result<SpectralCamera> Make(const CameraSensitivities& sensitivities);

  // Raw channels seeing light of this spectrum, whose Y is 1: sums on the spectrum's own grid.
  // Refused: bad_spectrum.
  [[nodiscard]] Result<std::array<double, 3>> ChannelsOf(const Spectrum& light) const;

  // XYZ from raw channels: exact for D65, least squares over the 99 colour evaluation samples of
  // CIE 224 under it. What a DNG ColorMatrix for D65 does.
  [[nodiscard]] const Matrix3& xyz_from_raw() const { return xyz_from_raw_; }

  // Refused as ChannelsOf; no_luminance (the matrix gives the light none).
  [[nodiscard]] Result<LampSeen> See(const Spectrum& light) const;

  // The factor of a class, fitted on its lamps (LampSpectra); of a known spectrum: exact, with
  // kKnownSpectrumSigma for what measured sensitivities leave.
  [[nodiscard]] Result<MismatchFactor> FactorFor(LampClass lamp) const;
  [[nodiscard]] Result<MismatchFactor> FactorFor(const Spectrum& light) const;

 private:
  CameraSensitivities sensitivities_;
  double scale_ = 1.0;  // green of D65 becomes 1
  Matrix3 xyz_from_raw_{};
};

inline constexpr double kKnownSpectrumSigma = 0.005;

// Lamps of a class: white LED, CIE LED-B1 to B5; high CRI, CIE LED-V1 and V2 and the black bodies
// and daylights such lamps imitate; RGB LED, CIE LED-RGB1 and mixes of three Gaussian LEDs on the
// Planckian locus (models); tungsten, black bodies of 2200-3400 K; daylight, CIE D of 4000-10000 K.
// Unknown: all of these, the mixes thinned.
[[nodiscard]] std::vector<Spectrum> LampSpectra(LampClass lamp);

// A camera nobody measured, read by a matrix for D65: fitted on the class's measured lamps over 52
// cameras, sigma by leaving each lamp out over all cameras. The figures are held by
// tests/imaging/spectral_mismatch_test.cc.
[[nodiscard]] MismatchFactor GenericMismatch(LampClass lamp);

// 1 sigma of the colour temperature that a matrix for D65 gives lamps of this class: their root
// mean square error over the same cameras and lamps, at least the 5 mired that profiled cameras
// reach.
[[nodiscard]] Mireds GenericColorSigma(LampClass lamp);

// XYZ from raw channels of a camera whose DNG matrices are known, by its matrix for daylight, so
// that D65 whose green is 1 has Y = 1: the scale of ISO speeds, which the colour of the scene's own
// light must not move.
// Refused: no_colour (a matrix that cannot be inverted, or gives daylight no green).
[[nodiscard]] Result<Matrix3> DaylightXyzFromRaw(const CameraMatrices& matrices);

// Mireds of a chromaticity as the fits above use it: of its CCT, where it has one, else of the
// nearest point of the locus within 1000 K and infinity.
[[nodiscard]] Mireds MiredsOfLamp(Xy xy);

}  // namespace lightcal
