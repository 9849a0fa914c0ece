// SPDX-License-Identifier: Apache-2.0
// A .tscn that `check` takes gives lights of finite numbers; any other is refused in words.
#include <exception>

#include "lightcal/presets/check/reader_parts.h"
#include "lightcal/presets/exporters.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    lightcal::RequireFinite(
        lightcal::ReadGodot(std::string(lightcal::fuzz::TextOf(data, size)), nullptr));
  } catch (const std::exception&) {
    // Refused: LightsOfPreset says so, with what the reader says of a name from the file.
    return 0;
  }
  return 0;
}
