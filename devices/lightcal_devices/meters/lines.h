// SPDX-License-Identifier: Apache-2.0
// The kinds of line a meter hangs on: how meters on one are found, opened and permitted. One file
// of lines/ each; this is the whole list.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal_devices/meters/meter_table.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices {

enum class MeterAccess { kReady, kNoPermission, kBusy };

struct FoundMeter {
  const MeterRow* row = nullptr;
  std::string id;       // "sekonic:<serial>", or "sekonic:<address>" where it has none
  std::string address;  // what the line opens: "1-1.4", "/dev/ttyUSB0"
  std::string serial;   // "" = none
  std::string usb;      // "0a41:7003", "" = not on USB
  MeterAccess access = MeterAccess::kReady;
  // The device's own folder in sysfs, links resolved; "" = not asked. One instrument may be found
  // by two drivers, one folder then lies within the other.
  std::string sysfs_parent;
  std::string remedy;  // what to do when it is not ready, "" = what the access says
};

struct MeterLine {
  std::string_view name;  // "usb"
  // The meters of this row that are there. Nothing is sent to any of them. Fails: io.
  Result<std::vector<FoundMeter>> (*find)(const MeterRow& row) = nullptr;
  // Fails: no_device, no_permission, busy, io.
  Result<std::unique_ptr<Transport>> (*open)(const FoundMeter& meter) = nullptr;
  // The rule that permits a device with this id.
  std::string (*udev_rule)(UsbId id) = nullptr;
  // "driver:address" opens it without its having been found. A line that cannot tell one
  // meter from another (a serial port) is only ever opened so, or when it is the only one.
  bool takes_address = false;
  // Found meters of this line may be chosen without being named.
  bool tells_meters_apart = true;
  // How a person gains permission without a udev rule, "" = only with one.
  std::string_view permission_remedy;
};

extern const MeterLine kUsbLine;
// Serial ports. A port is listed for each driver whose cable it may be.
extern const MeterLine kTtyLine;
// Lines of text from a serial port, a FIFO or a program; and from the person who typed them.
extern const MeterLine kTextLine;
extern const MeterLine kTypedLine;
// A program of the driver's name on PATH, which runs when the driver starts it. Found while one of
// the row's USB instruments is plugged in.
extern const MeterLine kProcessLine;
// Light sensors of the kernel's Industrial I/O.
extern const MeterLine kSysfsLine;
// HID sensors, known by their usage: ambient light on the sensor page.
extern const MeterLine kHidLine;
// HID devices known by their USB id, taken from the kernel's driver while they are read.
extern const MeterLine kHidUsbLine;

}  // namespace lightcal::devices
