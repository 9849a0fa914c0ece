// SPDX-License-Identifier: Apache-2.0
// The ioctls are those of Linux usbfs (linux/usbdevice_fs.h), as libusb 1.0 issues them.
#include "usb_stand_in.h"

#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <umockdev-1.0/umockdev.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <deque>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace lightcal::test {
namespace {

constexpr const char* kNode = "/dev/bus/usb/001/002";
constexpr const char* kRootHub =
    "P: /devices/pci0000:00/usb1\n"
    "N: bus/usb/001/001\n"
    "E: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nE: DRIVER=usb\nE: BUSNUM=001\nE: DEVNUM=001\n"
    "E: DEVNAME=/dev/bus/usb/001/001\nE: MAJOR=189\nE: MINOR=0\n"
    "A: busnum=1\\n\nA: devnum=1\\n\nA: bConfigurationValue=1\\n\nA: speed=480\\n\n"
    "A: idVendor=1d6b\\n\nA: idProduct=0002\\n\n"
    "H: descriptors=12010002090000406B1D020006060302010109021900010100E0000904000001090000000705"
    "8103040000\n";
// Vendor class, one interface, bulk OUT 0x02 and bulk IN 0x81 of 64 bytes.
constexpr const char* kSekonic =
    "P: /devices/pci0000:00/usb1/1-1\n"
    "N: bus/usb/001/002\n"
    "E: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nE: DRIVER=usb\nE: BUSNUM=001\nE: DEVNUM=002\n"
    "E: DEVNAME=/dev/bus/usb/001/002\nE: MAJOR=189\nE: MINOR=1\n"
    "A: busnum=1\\n\nA: devnum=2\\n\nA: bConfigurationValue=1\\n\nA: speed=12\\n\n"
    "A: idVendor=0a41\\n\nA: idProduct=7003\\n\n"
    "H: descriptors=1201000200000040410A037000010102030109022000010100803209040000"
    "02FF0000000705020240000007058102400000\n";

UMockdevTestbed* NewTestbed() {
  UMockdevTestbed* testbed = umockdev_testbed_new();
  if (umockdev_in_mock_environment() == 0) {
    throw std::runtime_error("run this test under umockdev-wrapper");
  }
  return testbed;
}

void Check(gboolean done, GError* error) {
  if (done == 0) throw std::runtime_error(error != nullptr ? error->message : "umockdev");
}

}  // namespace

std::string SekonicDescription(const std::string& serial) {
  std::string description = std::string(kRootHub) + "\n" + kSekonic;
  if (!serial.empty()) description += "A: serial=" + serial + "\\n\n";
  return description;
}

struct UsbStandIn::Impl {
  // A submitted transfer; an IN transfer waits until the meter has something to say.
  struct Urb {
    UMockdevIoctlData* urb = nullptr;
    UMockdevIoctlData* buffer = nullptr;
    bool done = false;
  };

  Impl(SekonicSetting setting, UsbSetting usb_setting)
      : meter(std::move(setting)), usb(std::move(usb_setting)) {
    testbed = NewTestbed();
    handler = umockdev_ioctl_base_new();
    g_signal_connect(handler, "handle-ioctl", G_CALLBACK(&Impl::OnIoctl), this);
    GError* error = nullptr;
    Check(umockdev_testbed_attach_ioctl(testbed, kNode, handler, &error), error);
    std::string description = SekonicDescription(usb.serial);
    if (usb.interrupt) {
      const std::string bulk =
          "07050202400000"
          "07058102400000";
      const std::string interrupt =
          "07050203400001"
          "07058103400001";
      description.replace(description.find(bulk), bulk.size(), interrupt);
    }
    Check(umockdev_testbed_add_from_string(testbed, description.c_str(), &error), error);
    if (usb.forbidden) {
      const std::unique_ptr<gchar, decltype(&g_free)> root_text(
          umockdev_testbed_get_root_dir(testbed), &g_free);
      const std::string root = root_text.get();
      if (::chmod((root + kNode).c_str(), 0) != 0) throw std::runtime_error("chmod");
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
    int error = 0;
    const glong result = impl->Answer(umockdev_ioctl_client_get_request(client),
                                      umockdev_ioctl_client_get_arg(client), error);
    umockdev_ioctl_client_complete(client, result, error);
    return 1;
  }

  static void Free(const Urb& urb) {
    g_object_unref(urb.urb);
    if (urb.buffer != nullptr) g_object_unref(urb.buffer);
  }

  static usbdevfs_urb* Header(const Urb& urb) {
    return reinterpret_cast<usbdevfs_urb*>(urb.urb->data);
  }

  glong Answer(gulong request, UMockdevIoctlData* argument, int& error) {
    switch (request) {
      case USBDEVFS_GET_CAPABILITIES: {
        auto* data = umockdev_ioctl_data_resolve(argument, 0, 4, nullptr);
        const guint32 capabilities =
            USBDEVFS_CAP_NO_PACKET_SIZE_LIM | USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
        std::memcpy(data->data, &capabilities, sizeof capabilities);
        g_object_unref(data);
        return 0;
      }
      case USBDEVFS_CLAIMINTERFACE:
        if (!usb.held_by_another) return 0;
        error = EBUSY;
        return -1;
      case USBDEVFS_RELEASEINTERFACE:
      case USBDEVFS_CLEAR_HALT:
        return 0;
      case USBDEVFS_SUBMITURB:
        return Submit(argument, error);
      case USBDEVFS_DISCARDURB:
        return Discard(argument, error);
      case USBDEVFS_REAPURB:
      case USBDEVFS_REAPURBNDELAY:
        return Reap(argument, error);
      default:
        error = ENOTTY;
        return -1;
    }
  }

  glong Submit(UMockdevIoctlData* argument, int& error) {
    Urb urb;
    urb.urb = umockdev_ioctl_data_resolve(argument, 0, sizeof(usbdevfs_urb), nullptr);
    usbdevfs_urb* header = Header(urb);
    urb.buffer = umockdev_ioctl_data_resolve(urb.urb, offsetof(usbdevfs_urb, buffer),
                                             static_cast<gsize>(header->buffer_length), nullptr);
    header->status = 0;
    const int type = usb.interrupt ? USBDEVFS_URB_TYPE_INTERRUPT : USBDEVFS_URB_TYPE_BULK;
    if (header->type != type) {
      Free(urb);
      error = EINVAL;
      return -1;
    }
    if ((header->endpoint & 0x80U) == 0) {
      const std::span command(reinterpret_cast<const std::byte*>(urb.buffer->data),
                              static_cast<std::size_t>(header->buffer_length));
      if (!meter.Take(command)) {
        Free(urb);
        error = ENODEV;
        return -1;
      }
      header->actual_length = header->buffer_length;
      urb.done = true;
    } else if (meter.has_answer()) {
      std::vector<std::byte> bytes;
      const auto kind = meter.Give(bytes);
      if (kind == FakeSekonic::Answer::kGone) {
        Free(urb);
        error = ENODEV;
        return -1;
      }
      const auto room = static_cast<std::size_t>(header->buffer_length);
      if (bytes.size() > room) bytes.resize(room);
      std::ranges::copy(bytes, reinterpret_cast<std::byte*>(urb.buffer->data));
      header->actual_length = static_cast<int>(bytes.size());
      if (kind == FakeSekonic::Answer::kStall) header->status = -EPIPE;
      urb.done = true;
    }
    urbs.push_back(urb);
    return 0;
  }

  glong Discard(UMockdevIoctlData* argument, int& error) {
    gulong address = 0;
    std::memcpy(&address, argument->data, sizeof address);
    for (Urb& urb : urbs) {
      if (urb.urb->client_addr != address) continue;
      Header(urb)->status = -ENOENT;
      urb.done = true;
      return 0;
    }
    error = EINVAL;
    return -1;
  }

  glong Reap(UMockdevIoctlData* argument, int& error) {
    for (auto it = urbs.begin(); it != urbs.end(); ++it) {
      if (!it->done) continue;
      auto* target = umockdev_ioctl_data_resolve(argument, 0, sizeof(void*), nullptr);
      umockdev_ioctl_data_set_ptr(target, 0, it->urb);
      g_object_unref(target);
      Free(*it);
      urbs.erase(it);
      return 0;
    }
    error = EAGAIN;
    return -1;
  }

  mutable std::mutex mutex;
  FakeSekonic meter;
  UsbSetting usb;
  UMockdevTestbed* testbed = nullptr;
  UMockdevIoctlBase* handler = nullptr;
  std::deque<Urb> urbs;
};

UsbStandIn::UsbStandIn(SekonicSetting meter, UsbSetting usb)
    : impl_(std::make_unique<Impl>(std::move(meter), std::move(usb))) {}
UsbStandIn::~UsbStandIn() = default;

std::vector<std::string> UsbStandIn::commands() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->meter.commands();
}

bool UsbStandIn::remote() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->meter.remote();
}

bool UsbStandIn::WaitForCommand(const std::string& command) const {
  for (int i = 0; i < 1000; ++i) {
    for (const std::string& taken : commands()) {
      if (taken == command) return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

std::vector<std::string> UsbStandIn::WithoutRootPowers() {
  if (::geteuid() != 0) return {};
  return {"setpriv", "--bounding-set=-dac_override,-dac_read_search",
          "--inh-caps=-dac_override,-dac_read_search"};
}

struct NoUsb::Impl {
  UMockdevTestbed* testbed = NewTestbed();
};
NoUsb::NoUsb() : impl_(std::make_unique<Impl>()) {}
NoUsb::~NoUsb() { g_object_unref(impl_->testbed); }

}  // namespace lightcal::test
