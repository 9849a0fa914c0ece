// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace lightcal {

// Who made a file, "lightcal 0.1.0": its provenance.
[[nodiscard]] std::string GeneratorName();

}  // namespace lightcal
