// SPDX-License-Identifier: Apache-2.0
// Every meter lightcal can talk to, as one table.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal {

enum class MeterLine { kUsb };

// How sure we are that the driver does what the instrument wants.
enum class Verified {
  kHardware,       // we held one
  kCapturedReply,  // tested on bytes a real one sent
  kDocumentation,  // built from its manual
};

struct MeterRow {
  std::string_view driver;  // "sekonic"
  std::string_view models;  // for people
  MeterLine line = MeterLine::kUsb;
  std::uint16_t usb_vendor = 0;
  std::uint16_t usb_product = 0;
  Verified verified = Verified::kDocumentation;
  std::unique_ptr<Meter> (*make)(Transport& transport, const std::string& serial,
                                 const MeterTiming& timing) = nullptr;
};

[[nodiscard]] std::span<const MeterRow> MeterTable();
// The row of a driver's name, or nullptr.
[[nodiscard]] const MeterRow* FindDriver(std::string_view driver);

[[nodiscard]] std::string_view LineName(MeterLine line);    // "usb"
[[nodiscard]] std::string_view VerifiedName(Verified how);  // "captured_replay"
// The udev rule that lets whoever sits at the machine use this meter; devices/udev/ holds them all.
[[nodiscard]] std::string UdevRule(const MeterRow& row);

}  // namespace lightcal
