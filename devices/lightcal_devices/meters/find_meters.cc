// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/find_meters.h"

#include <algorithm>
#include <iterator>
#include <thread>

#include "lightcal/core/nearest_word.h"

namespace lightcal {
namespace {

std::string DriverOf(std::string_view wanted) {
  return std::string(wanted.substr(0, wanted.find(':')));
}

tl::unexpected<Error> UnknownDriver(std::string_view wanted) {
  std::vector<std::string_view> names;
  for (const MeterRow& row : MeterTable()) names.push_back(row.driver);
  const std::string nearest = NearestWord(DriverOf(wanted), names);
  std::string message = "no such device or driver";
  if (!nearest.empty()) message += "; did you mean " + nearest + "?";
  return WrongUsage("--device " + std::string(wanted), message + " (see lightcal devices)");
}

tl::unexpected<Error> NotThere(std::string_view wanted) {
  return Failed(std::string(fault::kNoDevice), std::string(wanted),
                "none is plugged in; plug it in and switch it on, or type the reading: --lux 192");
}

}  // namespace

Result<std::vector<FoundMeter>> FindMeters() {
  std::vector<FoundMeter> found;
  for (const MeterRow& row : MeterTable()) {
    auto devices = ListUsbDevices(row.usb_vendor, row.usb_product);
    if (!devices) return Propagate(std::move(devices));
    for (UsbDeviceInfo& device : *devices) {
      const std::string& which = device.serial.empty() ? device.port : device.serial;
      std::string id = std::string(row.driver) + ":" + which;
      found.push_back({&row, std::move(id), std::move(device)});
    }
  }
  return found;
}

Result<FoundMeter> ChooseMeter(const std::vector<FoundMeter>& found, std::string_view wanted) {
  if (!wanted.empty() && FindDriver(DriverOf(wanted)) == nullptr) return UnknownDriver(wanted);
  std::vector<FoundMeter> fitting;
  std::ranges::copy_if(found, std::back_inserter(fitting), [&](const FoundMeter& meter) {
    return wanted.empty() || meter.id == wanted || meter.row->driver == wanted;
  });
  if (fitting.empty()) return NotThere(wanted.empty() ? "meter" : wanted);
  if (fitting.size() == 1) return fitting.front();
  std::string ids;
  for (const FoundMeter& meter : fitting) ids += (ids.empty() ? "" : ", ") + meter.id;
  return WrongUsage("--device", "several meters are plugged in; name one of " + ids);
}

Result<std::unique_ptr<Transport>> OpenMeter(const FoundMeter& meter,
                                             std::chrono::milliseconds pause) {
  auto line = OpenUsb(meter.usb);
  for (int retry = 0; retry < kBusyRetries && !line && line.error().code == fault::kBusy; ++retry) {
    std::this_thread::sleep_for(pause);
    line = OpenUsb(meter.usb);
  }
  if (!line) {
    Error error = line.error();
    error.subject = meter.id;
    if (error.code == fault::kNoPermission) {
      error.message =
          "you may not open this meter; put this line into /etc/udev/rules.d/70-lightcal.rules, "
          "run "
          "`sudo udevadm control --reload`, and plug it in again:\n" +
          UdevRule(*meter.row);
    }
    return tl::unexpected(std::move(error));
  }
  return line;
}

}  // namespace lightcal
