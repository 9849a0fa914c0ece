// SPDX-License-Identifier: Apache-2.0
// Reports of a HID ambient light sensor as values. Pure.
// Source: HID Sensor Usages (HUTRR39), as the kernel's hid-sensor-ids.h lists them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal_devices/meters/hid_als/descriptor.h"

namespace lightcal::devices::hid_als {

inline constexpr std::string_view kBadReply = "bad_reply";

// A feature field that switches the sensor on, and the raw number that does.
struct Switch {
  Field field;
  std::int64_t raw = 0;
};

// The fields of the ambient light sensor a descriptor describes.
struct Layout {
  Field illuminance;
  std::optional<Field> cct, x, y;  // of the same report
  std::optional<Field> state;      // of the same report
  std::vector<Switch> power_up;    // report all events, full power
  bool numbered = false;
  std::size_t input_bytes = 0;
};

// Fails: bad_descriptor when it describes no ambient light sensor (usage page 0x20, usage 0x41)
// with an illuminance (usage 0x04D1) in an input report.
[[nodiscard]] Result<Layout> FindAmbientLight(const ReportDescriptor& descriptor);

enum class SensorState { kReady, kNotReady, kAccessDenied, kError };

// One input report.
struct AmbientLight {
  SensorState state = SensorState::kReady;
  double illuminance_lx = 0.0;
  double step_lx = 0.0;     // one count
  bool over_range = false;  // at the end of its scale: the light is at least this
  std::optional<double> cct_K;
  std::optional<Xy> xy;
  bool color_dropped = false;  // xy was there and impossible: it and the CCT are left out
};

// Any number within its logical range is taken; xy outside (0, 1), or 0, is not believed, nor is
// the CCT beside it (AMD's sensors scale xy by 10^0).   Fails: bad_reply.
[[nodiscard]] Result<AmbientLight> DecodeInput(const Layout& layout,
                                               std::span<const std::byte> report);

}  // namespace lightcal::devices::hid_als
