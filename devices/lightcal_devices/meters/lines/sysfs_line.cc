// SPDX-License-Identifier: Apache-2.0
// Light sensors of the kernel's Industrial I/O: world-readable files, nothing to open.
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "lightcal_devices/meters/lines.h"
#include "lightcal_devices/transport/sysfs.h"

namespace lightcal::devices {
namespace {

bool MeasuresIlluminance(const std::string& folder) {
  return std::ranges::any_of(FoldersIn(folder), [](const std::string& path) {
    const std::string name = path.substr(path.rfind('/') + 1);
    return name == "in_illuminance_input" || name == "in_illuminance_raw";
  });
}

bool MayRead(const std::string& folder) {
  return std::ranges::any_of(
      std::initializer_list<const char*>{"/in_illuminance_input", "/in_illuminance_raw"},
      [&](const char* name) { return ::access((folder + name).c_str(), R_OK) == 0; });
}

// The folder itself, not the link under bus/iio.
std::string Resolved(const std::string& folder) {
  std::error_code error;
  const auto path = std::filesystem::canonical(folder, error);
  return error ? std::string() : path.string();
}

Result<std::vector<FoundMeter>> FindSensors(const MeterRow& row) {
  std::vector<FoundMeter> found;
  for (const std::string& folder : FoldersIn(std::string(kIioDevices))) {
    if (!MeasuresIlluminance(folder)) continue;
    FoundMeter meter;
    meter.row = &row;
    meter.address = folder;
    meter.sysfs_parent = Resolved(folder);
    if (!MayRead(folder)) meter.access = MeterAccess::kNoPermission;
    found.push_back(std::move(meter));
  }
  return found;
}

Result<std::unique_ptr<Transport>> OpenSensor(const FoundMeter& meter) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(meter.address, ignored)) {
    return Failed(std::string(fault::kNoDevice), "sysfs " + meter.address,
                  "no such device; is it plugged in, and its kernel driver loaded?");
  }
  return OpenSysfs(meter.address);
}

std::string NoUdevRule(UsbId /*id*/) { return ""; }

}  // namespace

const MeterLine kSysfsLine = {
    .name = "sysfs",
    .find = FindSensors,
    .open = OpenSensor,
    .udev_rule = NoUdevRule,
    .takes_address = true,
    .tells_meters_apart = true,
    .permission_remedy = "make its files under /sys/bus/iio/devices readable (chmod a+r)"};

}  // namespace lightcal::devices
