// SPDX-License-Identifier: Apache-2.0
// Whatever comes in, each decoder answers or refuses; a spectrum fits its range and is finite.
#include <algorithm>
#include <span>

#include "lightcal_devices/meters/torchbearer/frame.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  namespace torchbearer = lightcal::devices::torchbearer;
  const auto bytes = std::as_bytes(std::span(data, size));
  using std::ranges::all_of;
  if (const auto message = lightcal::devices::torchbearer::DecodeMessage(bytes)) {
    Require(message->data.size() + 9 == bytes.size());
    Require(*lightcal::devices::torchbearer::MessageLength(
                bytes.first(lightcal::devices::torchbearer::kHeaderBytes)) == bytes.size());
  }
  static_cast<void>(lightcal::devices::torchbearer::DecodeAccepted(bytes));
  static_cast<void>(lightcal::devices::torchbearer::DecodeExposureMode(bytes));
  if (const auto id = lightcal::devices::torchbearer::DecodeDeviceId(bytes)) Require(!id->empty());
  if (const auto range = lightcal::devices::torchbearer::DecodeRange(bytes)) {
    Require(range->samples() >= 2 && range->samples() <= 2301);
  }
  // The range of as many samples as these bytes would hold.
  constexpr std::size_t kHeader = 19;
  const int samples = bytes.size() < kHeader + 4 ? 2 : static_cast<int>(bytes.size() - kHeader) / 2;
  const lightcal::devices::torchbearer::WavelengthRange range{340, 339 + samples};
  if (const auto m = lightcal::devices::torchbearer::DecodeMeasurement(bytes, range)) {
    Require(m->irradiance_W_m2_nm.size() == range.samples());
    Require(all_of(m->irradiance_W_m2_nm, [](double v) { return v >= 0.0 && v <= 65535.0; }));
  }
  return 0;
}
