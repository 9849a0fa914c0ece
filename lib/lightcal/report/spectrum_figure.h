// SPDX-License-Identifier: Apache-2.0
// A light's spectrum.
#pragma once

#include <string>
#include <string_view>

#include "lightcal/report/report_extras.h"

namespace lightcal::report {

// Power against wavelength over 380-780 nm, or as much of it as was read: mW m^-2 nm^-1 of an
// irradiance, else relative to the largest sample shown. Negative samples (noise) stand at 0. The
// area below is filled with the colours of the wavelengths, as far as a screen has them. Empty
// where fewer than two samples lie in that range. id must be unique in the page.
[[nodiscard]] std::string SpectrumFigure(const LightSpectrum& light, std::string_view id);

}  // namespace lightcal::report
