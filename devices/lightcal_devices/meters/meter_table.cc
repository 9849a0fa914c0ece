// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/meter_table.h"

#include <array>

#include "lightcal_devices/meters/display_meter.h"
#include "lightcal_devices/meters/gossen/meter.h"
#include "lightcal_devices/meters/hid_als/meter.h"
#include "lightcal_devices/meters/iio/meter.h"
#include "lightcal_devices/meters/konica/meter.h"
#include "lightcal_devices/meters/lines.h"
#include "lightcal_devices/meters/mcp2221/meter.h"
#include "lightcal_devices/meters/sekonic/meter.h"
#include "lightcal_devices/meters/spotread/meter.h"
#include "lightcal_devices/meters/text/meter.h"
#include "lightcal_devices/meters/torchbearer/meter.h"

namespace lightcal::devices {
namespace {

constexpr std::array<UsbId, 1> kSekonicIds = {{{0x0a41, 0x7003}}};
// The FT232 of many meters and of many cables.
constexpr std::array<UsbId, 1> kFtdiIds = {{{0x0403, 0x6001}}};
// Instruments that ArgyllCMS lets measure ambient light: i1 Display (1, 2), i1 Display Pro and its
// successors, i1 Pro (1, 2, 3), ColorMunki, i1 Studio, Huey, Spyder 3, 4, 5 and X. JETI specbos
// hang on serial ports.
constexpr std::array<UsbId, 12> kSpotreadIds = {{{0x0765, 0x5001},
                                                 {0x0765, 0x5020},
                                                 {0x0765, 0x6008},
                                                 {0x0765, 0x6009},
                                                 {0x085c, 0x0300},
                                                 {0x085c, 0x0400},
                                                 {0x085c, 0x0500},
                                                 {0x085c, 0x0a00},
                                                 {0x0971, 0x2000},
                                                 {0x0971, 0x2003},
                                                 {0x0971, 0x2005},
                                                 {0x0971, 0x2007}}};
constexpr std::array<MeterOption, 4> kSpotreadOptions = {
    {{"port", "number of the instrument in the list spotread -? prints"},
     {"ccss", "a .ccss or .ccmx file that corrects a colorimeter for this kind of lamp"},
     {"hires", "yes: the spectrometer's high resolution"},
     {"spotread", "path of the program"}}};

// Sensors on the HID sensor page are found by their usage; this one is known by name.
constexpr std::array<UsbId, 1> kHidAlsIds = {{{0x273f, 0x1008}}};
constexpr std::array<UsbId, 1> kMcp2221Ids = {{{0x04d8, 0x00dd}}};
constexpr std::array<MeterOption, 2> kMcp2221Options = {
    {{"sensor", "opt4048, opt3001, bh1750 or veml7700; the first two are found without it"},
     {"address", "of the sensor on the I2C bus, 0x23; needs sensor"}}};

// The CP2102 of many meters and of many cables.
constexpr std::array<UsbId, 1> kCp210xIds = {{{0x10c4, 0xea60}}};

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
    {.driver = "pce174",
     .models = "PCE-174, Extech HD450",
     .line = &kTtyLine,
     .usb = kCp210xIds,
     .serial = k9600_8N1,
     .verified = Verified::kDocumentation,
     .options = {},
     .make = MakeDisplayMeter<pce174::kProtocol>},
    {.driver = "ut382",
     .models = "UNI-T UT382",
     .line = &kTtyLine,
     .usb = {},
     .serial = k19200_8N1,
     .verified = Verified::kDocumentation,
     .options = {},
     .make = MakeDisplayMeter<ut382::kProtocol>},
    {.driver = "gm1020",
     .models = "Benetech GM1020",
     .line = &kTtyLine,
     .usb = {},
     .serial = k19200_8N1,
     .verified = Verified::kDocumentation,
     .options = {},
     .make = MakeDisplayMeter<gm1020::kProtocol>},
    {.driver = "lutron16",
     .models = "Lutron YK-2005LX and its family (Extech SDL400, PCE)",
     .line = &kTtyLine,
     .usb = {},
     .serial = k9600_8N1,
     .verified = Verified::kDocumentation,
     .options = {},
     .make = MakeDisplayMeter<lutron16::kProtocol>},
    {.driver = "torchbearer",
     .models = "Torch Bearer Y21B7W (experimental)",
     .line = &kTtyLine,
     .usb = {},
     .serial = k115200_8N1,
     .verified = Verified::kDocumentation,
     .options = {},
     .make = torchbearer::MakeMeter},
    {.driver = "spotread",
     .models = "i1 Display Pro, i1 Pro, ColorMunki, Spyder, Huey, JETI specbos (ArgyllCMS)",
     .line = &kProcessLine,
     .usb = kSpotreadIds,
     .verified = Verified::kDocumentation,
     .options = kSpotreadOptions,
     .make = spotread::MakeMeter,
     .describe = spotread::Describe},
    {.driver = "iio",
     .models = "light sensors of Linux Industrial I/O",
     .line = &kSysfsLine,
     .usb = {},
     .verified = Verified::kDocumentation,
     .options = {},
     .make = iio::MakeMeter},
    {.driver = "hid_als",
     .models = "HID ambient light sensors (ColorHugALS, laptops)",
     .line = &kHidLine,
     .usb = kHidAlsIds,
     .verified = Verified::kDocumentation,
     .options = {},
     .make = hid_als::MakeMeter},
    {.driver = "mcp2221",
     .models = "OPT4048, OPT3001, BH1750, VEML7700 on a MCP2221A",
     .line = &kHidUsbLine,
     .usb = kMcp2221Ids,
     .usb_is_any_bridge = true,
     .verified = Verified::kDocumentation,
     .options = kMcp2221Options,
     .make = mcp2221::MakeMeter},
    {.driver = "line",
     .models = "anything that prints lux: line:/dev/ttyACM0, line:FIFO, line:!PROGRAM",
     .line = &kTextLine,
     .usb = {},
     .verified = Verified::kDocumentation,
     .options = text::kOptions,
     .make = text::MakeLine},
    {.driver = "typed",
     .models = "a meter without a cable: typed:192lx",
     .line = &kTypedLine,
     .usb = {},
     .verified = Verified::kDocumentation,
     .options = text::kOptions,
     .make = text::MakeTyped},
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
  for (const UsbId& id : row.usb) {
    if (std::string rule = row.line->udev_rule(id); !rule.empty()) rules.push_back(std::move(rule));
  }
  return rules;
}

}  // namespace lightcal::devices
