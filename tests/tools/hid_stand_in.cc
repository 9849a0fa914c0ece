// SPDX-License-Identifier: Apache-2.0
#include "hid_stand_in.h"

#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>

#include <cstring>
#include <deque>
#include <string>

#include "usbfs_node.h"

namespace lightcal::test {
namespace {

// One configuration with the HID interface 2 alone: interrupt IN 0x83 and OUT 0x03, 64 bytes.
constexpr const char* kDevice =
    "P: /devices/pci0000:00/usb1/1-1\nN: bus/usb/001/002\n"
    "E: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nE: DRIVER=usb\nE: BUSNUM=001\nE: DEVNUM=002\n"
    "E: DEVNAME=/dev/bus/usb/001/002\nE: MAJOR=189\nE: MINOR=1\n"
    "A: busnum=1\\n\nA: devnum=2\\n\nA: bConfigurationValue=1\\n\nA: speed=12\\n\n"
    "A: idVendor=04d8\\n\nA: idProduct=00dd\\n\nA: product=MCP2221 USB-I2C/UART Combo\\n\n"
    "H: descriptors=1201000200000040D804DD00000101020001"
    "09022900010100803209040200020300000009211101000122"
    "1C0007058303400001070503034000010A\n\n";

std::string Interface(const BridgeSetting& usb) {
  std::string text =
      "P: /devices/pci0000:00/usb1/1-1/1-1:1.2\n"
      "E: SUBSYSTEM=usb\nE: DEVTYPE=usb_interface\n"
      "A: bInterfaceNumber=02\\n\nA: bInterfaceClass=03\\n\n";
  text += std::string("L: driver=../../../../../bus/usb/drivers/") +
          (usb.held_by_another ? "usbfs" : "usbhid") + "\n\n";
  if (usb.kernel_driver && !usb.held_by_another) {
    text +=
        "P: /devices/pci0000:00/usb1/1-1/1-1:1.2/0003:04D8:00DD.0001\n"
        "E: SUBSYSTEM=hid\nE: DRIVER=mcp2221\nE: HID_ID=0003:000004D8:000000DD\n"
        "L: driver=../../../../../../bus/hid/drivers/mcp2221\n\n";
  }
  return text;
}

}  // namespace

struct BridgeStandIn::Impl final : UsbfsInstrument {
  Impl(Mcp2221Setting bridge_setting, BridgeSetting usb_setting)
      : bridge(std::move(bridge_setting)),
        usb(usb_setting),
        attached(usb.kernel_driver),
        node(*this, std::string(kRootHub) + kDevice + Interface(usb), usb.forbidden) {}

  int Claim() override { return usb.held_by_another || attached ? EBUSY : 0; }

  bool gone() const override { return bridge.gone(); }

  int Control(gulong request, UMockdevIoctlData* argument) override {
    switch (request) {
      case USBDEVFS_GETDRIVER:
        return GetDriver(argument);
      case USBDEVFS_IOCTL:  // detach, and at the end attach
        if (usb.driver_stays) return EBUSY;
        attached = !attached;
        return 0;
      default:
        return ENOTTY;
    }
  }

  int GetDriver(UMockdevIoctlData* argument) const {
    if (!attached) return ENODATA;
    const Owned<UMockdevIoctlData> data(
        umockdev_ioctl_data_resolve(argument, 0, sizeof(usbdevfs_getdriver), nullptr));
    std::strcpy(reinterpret_cast<usbdevfs_getdriver*>(data->data)->driver, "usbhid");
    return 0;
  }

  int Take(UsbTransfer& transfer) override {
    if (bridge.gone()) return ENODEV;
    if (transfer.type() == USBDEVFS_URB_TYPE_CONTROL) {
      transfer.Fail(EPIPE);
    } else if (!transfer.in()) {
      const auto report = transfer.sent();
      if (auto reply = bridge.Answer(devices::Bytes(report.begin(), report.end()))) {
        replies.push_back(*std::move(reply));
      }
      if (bridge.gone()) {
        transfer.Fail(ENODEV);
      } else {
        transfer.Accept();
      }
    }
    return 0;
  }

  void Serve(UsbTransfer& waiting) override {
    if (bridge.gone()) return waiting.Fail(ENODEV);
    if (replies.empty()) return;
    waiting.Answer(replies.front());
    replies.pop_front();
  }

  FakeMcp2221 bridge;
  BridgeSetting usb;
  bool attached;
  std::deque<devices::Bytes> replies;
  UsbfsNode node;
};

BridgeStandIn::BridgeStandIn(Mcp2221Setting bridge, BridgeSetting usb)
    : impl_(std::make_unique<Impl>(std::move(bridge), usb)) {}
BridgeStandIn::~BridgeStandIn() = default;

bool BridgeStandIn::engine_idle() const {
  const std::lock_guard lock(impl_->node.mutex());
  return impl_->bridge.engine() == 0;
}

std::size_t BridgeStandIn::requests() const {
  const std::lock_guard lock(impl_->node.mutex());
  return impl_->bridge.commands().size();
}

bool BridgeStandIn::driver_attached() const {
  const std::lock_guard lock(impl_->node.mutex());
  return impl_->attached;
}

}  // namespace lightcal::test
