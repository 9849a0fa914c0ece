// SPDX-License-Identifier: Apache-2.0
// A .usda that `check` takes gives lights of finite numbers; any other is refused in words. The IES
// file that it may name is the door of fuzz_ies.
#include <exception>
#include <stdexcept>

#include "lightcal/presets/check/reader_parts.h"
#include "lightcal/presets/exporters.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto no_file = [](const std::string& name) -> std::string {
    throw std::runtime_error(name + " is not there");
  };
  try {
    lightcal::RequireFinite(
        lightcal::ReadUsd(std::string(lightcal::fuzz::TextOf(data, size)), no_file));
  } catch (const std::exception&) {
    // Refused: LightsOfPreset says so, with what the reader says of a name from the file.
    return 0;
  }
  return 0;
}
