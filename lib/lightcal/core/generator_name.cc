// SPDX-License-Identifier: Apache-2.0
#include "lightcal/core/generator_name.h"

namespace lightcal {

std::string GeneratorName() { return "lightcal " LIGHTCAL_VERSION; }

}  // namespace lightcal
