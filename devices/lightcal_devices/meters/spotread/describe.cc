// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/lines.h"
#include "lightcal_devices/meters/spotread/meter.h"
#include "lightcal_devices/transport/process.h"
#include "lightcal_devices/transport/sysfs.h"
#include "lightcal_devices/transport/usb.h"

namespace lightcal::devices::spotread {
namespace {

constexpr std::chrono::milliseconds kLongestUsage{2000};
constexpr std::size_t kUsageBytes = 4096;

// A program of the same ArgyllCMS that tells its version and knows no instruments.
std::optional<std::string> VersionBeside(const std::string& spotread) {
  const auto slash = spotread.rfind('/');
  if (slash == std::string::npos) return std::nullopt;
  const auto xicclu = ProgramOnPath(spotread.substr(0, slash) + "/xicclu");
  if (!xicclu) return std::nullopt;
  const auto line =
      OpenProcess({.program = *xicclu, .environment = {}, .longest_run = kLongestUsage});
  if (!line->Control("start", StartArguments({"-?"}), 0, kLongestUsage)) return std::nullopt;
  std::string usage;
  while (usage.size() < kUsageBytes) {
    const auto bytes = line->Read(kUsageBytes, kLongestUsage);
    if (!bytes) break;
    usage.append(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  }
  return VersionIn(usage);
}

}  // namespace

std::string Describe(const FoundMeter& meter) {
  std::string text = "ArgyllCMS";
  if (const auto version = VersionBeside(meter.address)) text += " " + *version;
  std::string plugged;
  for (const SysfsUsbDevice& device : UsbDevicesInSysfs()) {
    for (const UsbId& id : meter.row->usb) {
      if (device.vendor != id.vendor || device.product != id.product) continue;
      plugged += (plugged.empty() ? "" : ", ") + (device.name.empty() ? "" : device.name + " ") +
                 "(" + UsbIdText(id.vendor, id.product) + ")";
    }
  }
  return text + (plugged.empty() ? "; none of its USB instruments is plugged in"
                                 : "; plugged in: " + plugged);
}

}  // namespace lightcal::devices::spotread
