// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/meter_table.h"

#include <array>

#include "lightcal_devices/meters/gossen/meter.h"
#include "lightcal_devices/meters/konica/meter.h"
#include "lightcal_devices/meters/lines.h"
#include "lightcal_devices/meters/sekonic/meter.h"

namespace lightcal {
namespace {

constexpr std::array<UsbId, 1> kSekonicIds = {{{0x0a41, 0x7003}}};
// The FT232 of many meters and of many cables.
constexpr std::array<UsbId, 1> kFtdiIds = {{{0x0403, 0x6001}}};

constexpr auto kMeters = std::to_array<MeterRow>({
    {.driver = "sekonic",
     .models = "Sekonic C-700, C-800, C-7000",
     .line = &kUsbLine,
     .usb = kSekonicIds,
     .verified = Verified::kCapturedReply,
     .options = {},
     .make = sekonic::MakeMeter},
    {.driver = "konica_t10a",
     .models = "Konica Minolta T-10A, T-10MA",
     .line = &kTtyLine,
     .usb = kFtdiIds,
     .serial = konica::kSerial,
     .verified = Verified::kDocumentation,
     .options = konica::kOptions,
     .make = konica::MakeT10a},
    {.driver = "konica_cl200a",
     .models = "Konica Minolta CL-200A",
     .line = &kTtyLine,
     .usb = kFtdiIds,
     .serial = konica::kSerial,
     .verified = Verified::kCapturedReply,
     .options = konica::kOptions,
     .make = konica::MakeCl200a},
    {.driver = "gossen",
     .models = "Gossen MAVOLUX 5032 B USB, 5032 C USB",
     .line = &kTtyLine,
     .usb = kFtdiIds,
     .serial = k9600_7E2,
     .verified = Verified::kDocumentation,
     .options = gossen::kOptions,
     .make = gossen::MakeMeter},
});

}  // namespace

std::span<const MeterRow> MeterTable() { return kMeters; }

const MeterRow* FindDriver(std::string_view driver) {
  for (const MeterRow& row : kMeters) {
    if (row.driver == driver) return &row;
  }
  return nullptr;
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

std::vector<std::string> UdevRules(const MeterRow& row) {
  std::vector<std::string> rules;
  for (const UsbId& id : row.usb) rules.push_back(row.line->udev_rule(id));
  return rules;
}

}  // namespace lightcal
