// SPDX-License-Identifier: Apache-2.0
// Every meter lightcal can talk to, as one table.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/transport/transport.h"
#include "lightcal_devices/transport/tty.h"

namespace lightcal::devices {

struct FoundMeter;
struct MeterLine;

// How sure we are that the driver does what the instrument wants.
enum class Verified {
  kHardware,       // we held one
  kCapturedReply,  // tested on bytes a real one sent
  kDocumentation,  // built from its manual
};

struct UsbId {
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
};

// One option of a driver, name and value.
struct MeterOption {
  std::string_view name;
  std::string_view help;
};

struct MeterRow {
  std::string_view driver;          // "sekonic"
  std::string_view models;          // for people
  const MeterLine* line = nullptr;  // of lines.h
  std::span<const UsbId> usb;       // of the meter, or of the cable in it
  bool usb_is_any_bridge = false;   // the ids are a chip's that other devices have too
  SerialSettings serial = {};       // of a meter on a serial port
  Verified verified = Verified::kDocumentation;
  std::span<const MeterOption> options;
  std::unique_ptr<Meter> (*make)(Transport& transport, const MeterSetup& setup) = nullptr;
  // More about one that was found, for people: a program's version. Absent = nothing more.
  std::string (*describe)(const FoundMeter& meter) = nullptr;
};

[[nodiscard]] std::span<const MeterRow> MeterTable();
// The row of a driver's name, or nullptr.
[[nodiscard]] const MeterRow* FindDriver(std::string_view driver);

[[nodiscard]] std::string_view VerifiedName(Verified how);  // "captured_replay"
// The udev rules that let whoever sits at the machine use this meter, one per USB id; none for a
// serial cable, whose chip is in a thousand other devices. devices/70-lightcal.rules holds those of
// the meters' own ids; of a bridge that other devices have too the person decides.
[[nodiscard]] std::vector<std::string> UdevRules(const MeterRow& row);

}  // namespace lightcal::devices
