// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/meter_table.h"

#include <array>

#include "lightcal_devices/meters/sekonic/meter.h"
#include "lightcal_devices/transport/usb.h"

namespace lightcal {
namespace {

// clang-format off
constexpr std::array<MeterRow, 1> kMeters = {{
  // driver    models                           line            vendor  product  verified                   make
  {"sekonic", "Sekonic C-700, C-800, C-7000",  MeterLine::kUsb, 0x0a41, 0x7003, Verified::kCapturedReply, sekonic::MakeMeter},
}};
// clang-format on

}  // namespace

std::span<const MeterRow> MeterTable() { return kMeters; }

const MeterRow* FindDriver(std::string_view driver) {
  for (const MeterRow& row : kMeters) {
    if (row.driver == driver) return &row;
  }
  return nullptr;
}

std::string_view LineName(MeterLine line) {
  switch (line) {
    case MeterLine::kUsb:
      return "usb";
  }
  return "";
}

std::string_view VerifiedName(Verified how) {
  switch (how) {
    case Verified::kHardware:
      return "hardware";
    case Verified::kCapturedReply:
      return "captured_replay";
    case Verified::kDocumentation:
      return "documentation";
  }
  return "";
}

std::string UdevRule(const MeterRow& row) {
  const std::string id = UsbIdText(row.usb_vendor, row.usb_product);
  return "SUBSYSTEM==\"usb\", ENV{DEVTYPE}==\"usb_device\", ATTR{idVendor}==\"" + id.substr(0, 4) +
         "\", ATTR{idProduct}==\"" + id.substr(5) + "\", MODE=\"0660\", TAG+=\"uaccess\"";
}

}  // namespace lightcal
