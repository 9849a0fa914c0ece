// SPDX-License-Identifier: Apache-2.0
// The ioctls are those of Linux usbfs (linux/usbdevice_fs.h), as libusb 1.0 issues them.
#include "hid_stand_in.h"

#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <umockdev-1.0/umockdev.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <deque>
#include <mutex>
#include <stdexcept>
#include <string>

namespace lightcal::test {
namespace {

constexpr const char* kNode = "/dev/bus/usb/001/002";
constexpr const char* kHub =
    "P: /devices/pci0000:00/usb1\nN: bus/usb/001/001\n"
    "E: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nE: DRIVER=usb\nE: BUSNUM=001\nE: DEVNUM=001\n"
    "E: DEVNAME=/dev/bus/usb/001/001\nE: MAJOR=189\nE: MINOR=0\n"
    "A: busnum=1\\n\nA: devnum=1\\n\nA: bConfigurationValue=1\\n\nA: speed=480\\n\n"
    "A: idVendor=1d6b\\n\nA: idProduct=0002\\n\n"
    "H: descriptors=12010002090000406B1D020006060302010109021900010100E0000904000001090000000705"
    "8103040000\n\n";
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

struct BridgeStandIn::Impl {
  struct Urb {
    UMockdevIoctlData* urb = nullptr;
    UMockdevIoctlData* buffer = nullptr;
    bool done = false;
  };

  Impl(Mcp2221Setting bridge_setting, BridgeSetting usb_setting)
      : bridge(std::move(bridge_setting)), usb(usb_setting), attached(usb.kernel_driver) {
    testbed = umockdev_testbed_new();
    if (umockdev_in_mock_environment() == 0) {
      throw std::runtime_error("run this test under umockdev-wrapper");
    }
    handler = umockdev_ioctl_base_new();
    g_signal_connect(handler, "handle-ioctl", G_CALLBACK(&Impl::OnIoctl), this);
    GError* error = nullptr;
    const std::string text = std::string(kHub) + kDevice + Interface(usb);
    if (umockdev_testbed_attach_ioctl(testbed, kNode, handler, &error) == 0 ||
        umockdev_testbed_add_from_string(testbed, text.c_str(), &error) == 0) {
      throw std::runtime_error(error != nullptr ? error->message : "umockdev");
    }
    if (!usb.forbidden) return;
    const std::unique_ptr<gchar, decltype(&g_free)> root(umockdev_testbed_get_root_dir(testbed),
                                                         &g_free);
    if (::chmod((std::string(root.get()) + kNode).c_str(), 0) != 0) {
      throw std::runtime_error("chmod");
    }
  }

  ~Impl() {
    GError* error = nullptr;
    umockdev_testbed_detach_ioctl(testbed, kNode, &error);
    if (error != nullptr) g_error_free(error);
    g_signal_handlers_disconnect_by_data(handler, this);
    g_object_unref(handler);
    g_object_unref(testbed);
    for (const Urb& urb : urbs) Free(urb);
  }

  static gboolean OnIoctl(UMockdevIoctlBase* /*base*/, UMockdevIoctlClient* client, gpointer self) {
    auto* impl = static_cast<Impl*>(self);
    const std::lock_guard lock(impl->mutex);
    const int error = impl->Answer(umockdev_ioctl_client_get_request(client),
                                   umockdev_ioctl_client_get_arg(client));
    umockdev_ioctl_client_complete(client, error == 0 ? 0 : -1, error);
    return 1;
  }

  static void Free(const Urb& urb) {
    g_object_unref(urb.urb);
    if (urb.buffer != nullptr) g_object_unref(urb.buffer);
  }

  static usbdevfs_urb* Header(const Urb& urb) {
    return reinterpret_cast<usbdevfs_urb*>(urb.urb->data);
  }

  // 0, or the errno of the ioctl.
  int Answer(gulong request, UMockdevIoctlData* argument) {
    switch (request) {
      case USBDEVFS_GET_CAPABILITIES: {
        auto* data = umockdev_ioctl_data_resolve(argument, 0, 4, nullptr);
        const guint32 capabilities =
            USBDEVFS_CAP_NO_PACKET_SIZE_LIM | USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
        std::memcpy(data->data, &capabilities, sizeof capabilities);
        g_object_unref(data);
        return 0;
      }
      case USBDEVFS_GETDRIVER:
        return GetDriver(argument);
      case USBDEVFS_IOCTL:  // detach, and at the end attach
        if (usb.driver_stays) return EBUSY;
        attached = !attached;
        return 0;
      case USBDEVFS_CLAIMINTERFACE:
        return usb.held_by_another || attached ? EBUSY : 0;
      case USBDEVFS_RELEASEINTERFACE:
      case USBDEVFS_CLEAR_HALT:
        return 0;
      case USBDEVFS_SUBMITURB:
        return Submit(argument);
      case USBDEVFS_DISCARDURB:
        return Discard(argument);
      case USBDEVFS_REAPURB:
      case USBDEVFS_REAPURBNDELAY:
        return Reap(argument);
      default:
        return ENOTTY;
    }
  }

  int GetDriver(UMockdevIoctlData* argument) {
    if (!attached) return ENODATA;
    auto* data = umockdev_ioctl_data_resolve(argument, 0, sizeof(usbdevfs_getdriver), nullptr);
    std::strcpy(reinterpret_cast<usbdevfs_getdriver*>(data->data)->driver, "usbhid");
    g_object_unref(data);
    return 0;
  }

  int Submit(UMockdevIoctlData* argument) {
    if (bridge.gone()) return ENODEV;
    Urb urb;
    urb.urb = umockdev_ioctl_data_resolve(argument, 0, sizeof(usbdevfs_urb), nullptr);
    usbdevfs_urb* header = Header(urb);
    urb.buffer = umockdev_ioctl_data_resolve(urb.urb, offsetof(usbdevfs_urb, buffer),
                                             static_cast<gsize>(header->buffer_length), nullptr);
    header->status = 0;
    if (header->type == USBDEVFS_URB_TYPE_CONTROL) {
      header->status = -EPIPE;
      urb.done = true;
    } else if ((header->endpoint & 0x80U) == 0) {
      Take(urb);
    }
    urbs.push_back(urb);
    Deliver();
    return 0;
  }

  void Take(Urb& urb) {
    usbdevfs_urb* header = Header(urb);
    const auto* bytes = reinterpret_cast<const std::byte*>(urb.buffer->data);
    const auto reply = bridge.Answer(Bytes(bytes, bytes + header->buffer_length));
    if (reply) replies.push_back(*reply);
    header->actual_length = header->buffer_length;
    header->status = bridge.gone() ? -ENODEV : 0;
    urb.done = true;
  }

  // Gives replies to the IN transfers that wait for one; a gone device ends them all.
  void Deliver() {
    for (Urb& urb : urbs) {
      usbdevfs_urb* header = Header(urb);
      if (urb.done || (header->endpoint & 0x80U) == 0) continue;
      if (bridge.gone()) {
        header->status = -ENODEV;
        urb.done = true;
      } else if (!replies.empty()) {
        const std::size_t count =
            std::min(replies.front().size(), static_cast<std::size_t>(header->buffer_length));
        std::memcpy(urb.buffer->data, replies.front().data(), count);
        header->actual_length = static_cast<int>(count);
        replies.pop_front();
        urb.done = true;
      }
    }
  }

  int Discard(UMockdevIoctlData* argument) {
    gulong address = 0;
    std::memcpy(&address, argument->data, sizeof address);
    for (Urb& urb : urbs) {
      if (urb.urb->client_addr != address) continue;
      Header(urb)->status = -ENOENT;
      urb.done = true;
      return 0;
    }
    return EINVAL;
  }

  int Reap(UMockdevIoctlData* argument) {
    const auto it = std::ranges::find(urbs, true, &Urb::done);
    if (it == urbs.end()) return bridge.gone() ? ENODEV : EAGAIN;
    auto* target = umockdev_ioctl_data_resolve(argument, 0, sizeof(void*), nullptr);
    umockdev_ioctl_data_set_ptr(target, 0, it->urb);
    g_object_unref(target);
    Free(*it);
    urbs.erase(it);
    return 0;
  }

  mutable std::mutex mutex;
  FakeMcp2221 bridge;
  BridgeSetting usb;
  bool attached;
  UMockdevTestbed* testbed = nullptr;
  UMockdevIoctlBase* handler = nullptr;
  std::deque<Urb> urbs;
  std::deque<Bytes> replies;
};

BridgeStandIn::BridgeStandIn(Mcp2221Setting bridge, BridgeSetting usb)
    : impl_(std::make_unique<Impl>(std::move(bridge), usb)) {}
BridgeStandIn::~BridgeStandIn() = default;

bool BridgeStandIn::engine_idle() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->bridge.engine() == 0;
}

std::size_t BridgeStandIn::requests() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->bridge.commands().size();
}

bool BridgeStandIn::driver_attached() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->attached;
}

}  // namespace lightcal::test
