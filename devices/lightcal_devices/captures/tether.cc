// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/tether.h"

#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "lightcal/core/joined.h"
#include "lightcal_devices/captures/gphoto_module.h"
#include "lightcal_devices/transport/module_door.h"
#include "lightcal_devices/transport/sysfs.h"
#include "lightcal_devices/transport/transport.h"
#include "lightcal_devices/transport/usb.h"

namespace lightcal::devices {
namespace {

// USB Still Image Capture Device Definition 1.0, 4.2: class 6, subclass 1.
constexpr int kStillImageClass = 6, kStillCaptureSubclass = 1;
constexpr std::string_view kNodeFolder = "/dev/bus/usb/";
constexpr std::string_view kNetworkPort = "ptpip:";

const SysfsUsbInterface* PictureInterface(const SysfsUsbDevice& device) {
  const auto found = std::ranges::find_if(device.interfaces, [](const SysfsUsbInterface& i) {
    return i.device_class == kStillImageClass && i.subclass == kStillCaptureSubclass;
  });
  return found == device.interfaces.end() ? nullptr : &*found;
}

// "/dev/bus/usb/001/004" -> "usb:001,004"
std::string PortOf(const std::string& node) {
  std::string port = "usb:" + node.substr(kNodeFolder.size());
  std::ranges::replace(port, '/', ',');
  return port;
}

void SeeAccess(const SysfsUsbDevice& device, const SysfsUsbInterface& interface,
               FoundCamera& camera) {
  if (::access(device.node.c_str(), R_OK | W_OK) != 0) {
    camera.access = CameraAccess::kNoPermission;
    camera.remedy =
        "you may not open this camera; the package libgphoto2-6 brings the udev rule that lets "
        "whoever sits at the machine use it: install it and plug the camera in again";
  } else if (interface.driver == "usbfs") {
    camera.access = CameraAccess::kBusy;
    camera.remedy =
        "another program holds it, mostly the desktop that shows its card as a folder; eject it "
        "there, or: gio mount -s gphoto2";
  }
}

// "ptpip:HOST:PORT" -> "ptpip:HOST:PORT:PORT": libgphoto2 takes events from port 15740 else.
std::string WithEventPort(std::string port) {
  const auto first = port.find(':', kNetworkPort.size());
  if (first == std::string::npos || port.find(':', first + 1) != std::string::npos) return port;
  return port + port.substr(first);
}

Result<GphotoOpen> OpenTetherModule() {
  auto symbol = OpenModule(kGphotoModuleName, kGphotoOpenSymbol, "no_tether_module",
                           "the part that speaks to cameras");
  if (!symbol) return Propagate(std::move(symbol));
  return reinterpret_cast<GphotoOpen>(*symbol);
}

Result<GphotoOpen> TetherModule() {
  static const Result<GphotoOpen> module = OpenTetherModule();
  return module;
}

}  // namespace

std::vector<FoundCamera> FindCameras() {
  std::vector<FoundCamera> found;
  for (const SysfsUsbDevice& device : UsbDevicesInSysfs()) {
    const SysfsUsbInterface* interface = PictureInterface(device);
    if (interface == nullptr || device.node.empty()) continue;
    FoundCamera camera;
    camera.port = PortOf(device.node);
    camera.id = std::string(kCameraDriver) + ":" + camera.port;
    camera.model = device.name;
    camera.serial = device.serial;
    camera.usb = UsbIdText(device.vendor, device.product);
    SeeAccess(device, *interface, camera);
    found.push_back(std::move(camera));
  }
  return found;
}

Result<FoundCamera> ChooseCamera(const std::vector<FoundCamera>& found, std::string_view wanted) {
  const std::string prefix = std::string(kCameraDriver) + ":";
  if (wanted.starts_with(prefix + std::string(kNetworkPort)) &&
      wanted.size() > prefix.size() + kNetworkPort.size()) {
    FoundCamera camera;
    camera.id = wanted;
    camera.port = WithEventPort(std::string(wanted.substr(prefix.size())));
    return camera;
  }
  if (!wanted.empty() && wanted != kCameraDriver && !wanted.starts_with(prefix)) {
    return WrongUsage("{meter.device} " + std::string(wanted),
                      "names no camera; give gphoto2:ptpip:HOST, or an id of {FindMeters}");
  }
  std::vector<FoundCamera> fitting;
  std::ranges::copy_if(found, std::back_inserter(fitting), [&](const FoundCamera& camera) {
    return wanted.empty() || wanted == kCameraDriver || camera.id == wanted;
  });
  if (fitting.size() == 1) return fitting.front();
  if (fitting.empty()) {
    return Failed(std::string(fault::kNoDevice), wanted.empty() ? "camera" : std::string(wanted),
                  "no camera is plugged in; switch it on, set it to PTP (PC remote) where it asks, "
                  "or name one in the network: {meter.device} gphoto2:ptpip:HOST");
  }
  return WrongUsage("{meter.device}", "several cameras are plugged in; name one of " +
                                          Joined(fitting, ", ", &FoundCamera::id));
}

Result<std::unique_ptr<TetheredCamera>> OpenCamera(const FoundCamera& camera) {
  const auto open = TetherModule();
  if (!open) return tl::unexpected(open.error());
  Error error;
  std::unique_ptr<TetheredCamera> opened((*open)(camera, error));
  if (opened == nullptr) {
    error.subject = camera.id;
    if (!camera.remedy.empty()) error.message += "; " + camera.remedy;
    return tl::unexpected(std::move(error));
  }
  return opened;
}

}  // namespace lightcal::devices
