// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "lightcal/colorimetry/spectrum.h"

namespace lightcal::app {

// A spectrum as a file our own importer reads back; `what` says in its first line whose it is.
// Without `absolute` an irradiance too is written as relative.
[[nodiscard]] std::string SpectrumCsv(const Spectrum& spectrum, const std::string& what,
                                      bool absolute = true);

}  // namespace lightcal::app
