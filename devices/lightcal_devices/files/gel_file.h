// SPDX-License-Identifier: Apache-2.0
// Files of colour filters' transmittances.
#pragma once

#include <string>
#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal/records/gel.h"

namespace lightcal::devices {

// Three forms, by content:
//   a row a filter: columns filter, name (either may miss), then one column a wavelength named
//     "405nm" .. "700nm" with transmittances of 0..1 ("405nm_percent": 0..100), and what the maker
//     claims: tungsten_Y_percent, tungsten_x, tungsten_y, daylight_Y_percent, ...;
//   a column a filter: wavelength_nm, then "L204 transmittance", "L204 transmittance_percent",
//     "L204 T%", "L204 %";
//   IES TM-27 .spdx whose SpectralQuantity is transmittance.
// Fails: not_found, unreadable. Refused: bad_gels (none of these, a value outside 0..1, wavelengths
// that do not increase or miss 450-650 nm), units_ambiguous (percent or not is not said and values
// above 1 stand there; percent signs in some cells of a filter only). "45.2%" in a cell is percent.
// Warns gels_as_fractions: not said, and no filter passes half.
[[nodiscard]] Result<GelSet> ReadGelFile(const std::string& path);
[[nodiscard]] Result<GelSet> GelsFromText(std::string_view text, std::string_view name);

}  // namespace lightcal::devices
