// SPDX-License-Identifier: Apache-2.0
// Whatever a meter sends, each decoder answers or refuses; a measurement has its whole spectrum.
#include <span>

#include "lightcal_devices/meters/sekonic/frame.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  namespace sekonic = lightcal::devices::sekonic;
  const auto bytes = std::as_bytes(std::span(data, size));
  static_cast<void>(lightcal::devices::sekonic::DecodeAcknowledge(bytes));
  static_cast<void>(lightcal::devices::sekonic::DecodeModel(bytes));
  static_cast<void>(lightcal::devices::sekonic::DecodeFirmware(bytes));
  static_cast<void>(lightcal::devices::sekonic::DecodeState(bytes));
  const auto stored = lightcal::devices::sekonic::DecodeMemoryInfo(bytes);
  if (stored) Require(*stored >= 0 && *stored <= lightcal::devices::sekonic::kMostStored + 1);
  static_cast<void>(lightcal::devices::sekonic::DecodeStoredMeasurement(bytes));
  const auto measurement = lightcal::devices::sekonic::DecodeMeasurement(bytes);
  if (measurement)
    Require(measurement->spectrum.size() == lightcal::devices::sekonic::kSpectrumSamples);
  return 0;
}
