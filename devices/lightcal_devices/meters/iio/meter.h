// SPDX-License-Identifier: Apache-2.0
// The dialogue with a light sensor of Linux' Industrial I/O. README.md tells which files are read.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "lightcal_devices/meters/iio/frame.h"
#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices::iio {

// 1 sigma of E of a chip behind a window, without a cosine corrector: nobody states one, so it is
// wide until a calibration factor is given.
inline constexpr double kSigmaRelative = 0.30;

// Errors besides the transport's own: bad_reply, interrupted.
class IioMeter final : public Meter {
 public:
  // `transport` is a folder as OpenSysfs reads it and outlives the meter.
  IioMeter(Transport& transport, const MeterSetup& setup)
      : transport_(transport), serial_(setup.serial), timing_(setup.timing) {}

  Result<MeterIdentity> Identify() override;
  // Reads the illuminance twice and keeps the second: some drivers power up on the first.
  Result<MeterReading> Measure(const Cancellation& cancellation) override;

 private:
  // The content of an attribute; absent when the sensor has none of this name.
  Result<std::optional<std::string>> Text(const std::string& attribute);
  Result<std::optional<Number>> Ask(const std::string& attribute);
  // <prefix>_input, or <prefix>_raw with <shared>_offset and <shared>_scale.
  Result<std::optional<Number>> AskChannel(const std::string& prefix, const std::string& shared);
  Result<void> AddColor(MeterReading& result);

  Transport& transport_;
  std::string serial_;
  MeterTiming timing_;
  std::string name_;  // known after Identify
};

// For the meter table.
[[nodiscard]] std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup);

}  // namespace lightcal::devices::iio
