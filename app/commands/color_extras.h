// SPDX-License-Identifier: Apache-2.0
// What `lightcal color` says on request besides the colour itself: its uncertainty from noise, the
// error of a spectrum's step and range, RGB seen under another white or brought into gamut, and
// what other programs call its temperature.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "color_spaces.h"
#include "console.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/cct_noise.h"
#include "lightcal/colorimetry/gamut.h"
#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/colorimetry/spectral_error.h"
#include "lightcal/core/result.h"

namespace lightcal::app {

// As typed.
struct ColorExtraOptions {
  std::string sigma, white, gamut = "keep", sampling = "auto", plot;
  bool engines = false, adobe = false, tlci = false;
};
void AddColorExtraOptions(CLI::App& parser, ColorExtraOptions& options);
[[nodiscard]] bool AsksForExtras(const ColorExtraOptions& options);

// As understood.
struct ColorExtras {
  std::optional<double> sigma;  // relative, of each of X, Y and Z
  std::optional<Xy> white;      // adapted to the space's own white
  GamutPolicy gamut = GamutPolicy::kKeep;
  std::optional<Sampling> sampling;
  bool engines = false, adobe = false;
};
// Wrong usage for a white that cannot be read and a sigma that is no share between 0 and 100 %.
[[nodiscard]] Result<ColorExtras> ParseColorExtras(const ColorExtraOptions& options);

// Y = 1 before the gamut policy.
[[nodiscard]] Rgb RgbOf(Xy xy, const NamedSpace& space, const ColorExtras& extras);

// What was found out about one colour.
struct ColorFindings {
  std::optional<CctNoise> noise;
  std::optional<SpectralError> spectral_error;
  [[nodiscard]] bool too_noisy() const { return noise && noise->too_noisy(); }
};
// The uncertainty under extras.sigma of a colour with these tristimulus values. Warns too_noisy.
[[nodiscard]] std::optional<CctNoise> NoiseFound(const Xyz& color, const ColorExtras& extras,
                                                 const std::string& subject, Warnings& warnings);
// format: of the file; instruments average over their step, of a plain table it is not known.
// Warns undersampled.
[[nodiscard]] std::optional<SpectralError> SpectralErrorFound(const Spectrum& spectrum,
                                                              const std::string& format,
                                                              const ColorExtras& extras,
                                                              const std::string& subject,
                                                              Warnings& warnings);
// "uncertainty", "spectral_error", "rgb_gamut", "rgb_white", "engines", "adobe".
[[nodiscard]] Node ColorExtrasNode(Xy xy, const ColorExtras& extras, const ColorFindings& findings);

// Rows for the table of one colour.
struct ExtraRow {
  std::string what, value, unit;
};
[[nodiscard]] std::vector<ExtraRow> ColorExtraRows(Xy xy, const ColorExtras& extras,
                                                   const ColorFindings& findings);

}  // namespace lightcal::app
