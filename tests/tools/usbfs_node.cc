// SPDX-License-Identifier: Apache-2.0
// The ioctls are those of Linux usbfs (linux/usbdevice_fs.h), as libusb 1.0 issues them.
#include "usbfs_node.h"

#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace lightcal::test {
namespace {

constexpr const char* kNode = "/dev/bus/usb/001/002";

void Check(gboolean done, const GError* error) {
  if (done == 0) throw std::runtime_error(error != nullptr ? error->message : "umockdev");
}

}  // namespace

const char* const kRootHub =
    "P: /devices/pci0000:00/usb1\n"
    "N: bus/usb/001/001\n"
    "E: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nE: DRIVER=usb\nE: BUSNUM=001\nE: DEVNUM=001\n"
    "E: DEVNAME=/dev/bus/usb/001/001\nE: MAJOR=189\nE: MINOR=0\n"
    "A: busnum=1\\n\nA: devnum=1\\n\nA: bConfigurationValue=1\\n\nA: speed=480\\n\n"
    "A: idVendor=1d6b\\n\nA: idProduct=0002\\n\n"
    "H: descriptors=12010002090000406B1D020006060302010109021900010100E0000904000001090000000705"
    "8103040000\n\n";

Owned<UMockdevTestbed> NewTestbed() {
  Owned<UMockdevTestbed> testbed(umockdev_testbed_new());
  if (umockdev_in_mock_environment() == 0) {
    throw std::runtime_error("run this test under umockdev-wrapper");
  }
  return testbed;
}

UsbTransfer::UsbTransfer(UMockdevIoctlData* argument)
    : urb_(umockdev_ioctl_data_resolve(argument, 0, sizeof(usbdevfs_urb), nullptr)) {
  buffer_.reset(umockdev_ioctl_data_resolve(urb_.get(), offsetof(usbdevfs_urb, buffer),
                                            static_cast<gsize>(urb().buffer_length), nullptr));
  urb().status = 0;
}

usbdevfs_urb& UsbTransfer::urb() const { return *reinterpret_cast<usbdevfs_urb*>(urb_->data); }

int UsbTransfer::type() const { return urb().type; }

bool UsbTransfer::in() const { return (urb().endpoint & 0x80U) != 0; }

std::span<const std::byte> UsbTransfer::sent() const {
  return {reinterpret_cast<const std::byte*>(buffer_->data),
          static_cast<std::size_t>(urb().buffer_length)};
}

void UsbTransfer::Accept() {
  urb().actual_length = urb().buffer_length;
  done_ = true;
}

void UsbTransfer::Answer(std::span<const std::byte> bytes) {
  const auto given = bytes.first(std::min(bytes.size(), sent().size()));
  std::ranges::copy(given, reinterpret_cast<std::byte*>(buffer_->data));
  urb().actual_length = static_cast<int>(given.size());
  done_ = true;
}

void UsbTransfer::Fail(int error) {
  urb().status = -error;
  done_ = true;
}

UsbfsNode::UsbfsNode(UsbfsInstrument& instrument, const std::string& description, bool forbidden)
    : instrument_(instrument), testbed_(NewTestbed()), handler_(umockdev_ioctl_base_new()) {
  g_signal_connect(handler_.get(), "handle-ioctl", G_CALLBACK(&UsbfsNode::OnIoctl), this);
  GError* error = nullptr;
  Check(umockdev_testbed_attach_ioctl(testbed_.get(), kNode, handler_.get(), &error), error);
  Check(umockdev_testbed_add_from_string(testbed_.get(), description.c_str(), &error), error);
  if (!forbidden) return;
  const std::unique_ptr<gchar, decltype(&g_free)> root(
      umockdev_testbed_get_root_dir(testbed_.get()), &g_free);
  if (::chmod((std::string(root.get()) + kNode).c_str(), 0) != 0) throw std::runtime_error("chmod");
}

UsbfsNode::~UsbfsNode() {
  GError* error = nullptr;
  umockdev_testbed_detach_ioctl(testbed_.get(), kNode, &error);
  if (error != nullptr) g_error_free(error);
  g_signal_handlers_disconnect_by_data(handler_.get(), this);
}

gboolean UsbfsNode::OnIoctl(UMockdevIoctlBase* /*base*/, UMockdevIoctlClient* client,
                            gpointer self) {
  auto* node = static_cast<UsbfsNode*>(self);
  const std::lock_guard lock(node->mutex_);
  const int error = node->Answer(umockdev_ioctl_client_get_request(client),
                                 umockdev_ioctl_client_get_arg(client));
  umockdev_ioctl_client_complete(client, error == 0 ? 0 : -1, error);
  return 1;
}

int UsbfsNode::Answer(gulong request, UMockdevIoctlData* argument) {
  switch (request) {
    case USBDEVFS_GET_CAPABILITIES: {
      const Owned<UMockdevIoctlData> data(umockdev_ioctl_data_resolve(argument, 0, 4, nullptr));
      const guint32 capabilities =
          USBDEVFS_CAP_NO_PACKET_SIZE_LIM | USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
      std::memcpy(data->data, &capabilities, sizeof capabilities);
      return 0;
    }
    case USBDEVFS_CLAIMINTERFACE:
      return instrument_.Claim();
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
      return instrument_.Control(request, argument);
  }
}

int UsbfsNode::Submit(UMockdevIoctlData* argument) {
  UsbTransfer transfer(argument);
  if (const int error = instrument_.Take(transfer); error != 0) return error;
  transfers_.push_back(std::move(transfer));
  for (UsbTransfer& each : transfers_) {
    if (each.in() && !each.done()) instrument_.Serve(each);
  }
  return 0;
}

int UsbfsNode::Discard(UMockdevIoctlData* argument) {
  gulong address = 0;
  std::memcpy(&address, argument->data, sizeof address);
  const auto it = std::ranges::find_if(
      transfers_, [&](const UsbTransfer& each) { return each.urb_->client_addr == address; });
  if (it == transfers_.end()) return EINVAL;
  it->Fail(ENOENT);
  return 0;
}

int UsbfsNode::Reap(UMockdevIoctlData* argument) {
  const auto it = std::ranges::find_if(transfers_, &UsbTransfer::done);
  if (it == transfers_.end()) return instrument_.gone() ? ENODEV : EAGAIN;
  const Owned<UMockdevIoctlData> target(
      umockdev_ioctl_data_resolve(argument, 0, sizeof(void*), nullptr));
  umockdev_ioctl_data_set_ptr(target.get(), 0, it->urb_.get());
  transfers_.erase(it);
  return 0;
}

}  // namespace lightcal::test
