// SPDX-License-Identifier: Apache-2.0
// Colour temperatures of many chromaticities at once.
#pragma once

#include <span>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/chromaticity.h"

namespace lightcal {

// results[i] is CctFromUv(colors[i]) (CctFromXy for Xy), temperature and duv equal to it within
// 1e-10, status equal: a table over uv gives a start within a fraction of a locus segment, three
// Newton steps follow, several points to an instruction. What is not settled there (another
// segment, a status other than kOk) goes through the function of one colour, and so costs as
// much as that. The table is computed at first use (3 ms). Holds for results.size() >=
// colors.size(); results beyond colors.size() are left alone.
void CctBatch(std::span<const Uv1960> colors, std::span<CctResult> results);
void CctBatch(std::span<const Xy> colors, std::span<CctResult> results);

}  // namespace lightcal
