// SPDX-License-Identifier: Apache-2.0
// Whatever the tags hold, an exposure that is believed is a number a camera can have.
#include <array>
#include <cstring>
#include <optional>

#include "lightcal_devices/captures/exposure_tags.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  std::array<double, 5> numbers{};
  if (size < 1 + sizeof(numbers)) {
    static_cast<void>(
        lightcal::devices::IsoTimeFromExif(std::string(reinterpret_cast<const char*>(data), size)));
    return 0;
  }
  std::memcpy(numbers.data(), data + 1, sizeof(numbers));
  const auto tag = [&](int i) {
    return (data[0] >> i & 1) != 0 ? std::optional(numbers[static_cast<std::size_t>(i)])
                                   : std::nullopt;
  };
  lightcal::Warnings warnings;
  const lightcal::FrameExposure exposure = lightcal::devices::ExposureFromTags(
      {tag(0), tag(1), tag(2), tag(3), tag(4)}, "frame.dng", warnings);
  if (exposure.time) Require(exposure.time->value() > 5e-8 && exposure.time->value() < 2e6);
  if (exposure.f_number) Require(*exposure.f_number > 0.2 && *exposure.f_number < 2000.0);
  if (exposure.iso) Require(*exposure.iso > 0.0 && *exposure.iso < 2e8);
  if (exposure.time_snapped) Require(exposure.time.has_value());
  for (const auto& warning : warnings) Require(!warning.message.empty());
  return 0;
}
