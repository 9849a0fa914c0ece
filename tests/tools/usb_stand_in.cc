// SPDX-License-Identifier: Apache-2.0
#include "usb_stand_in.h"

#include <linux/usbdevice_fs.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "usbfs_node.h"

namespace lightcal::test {
namespace {

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

std::string Description(const UsbSetting& usb) {
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
  return description;
}

}  // namespace

std::string SekonicDescription(const std::string& serial) {
  std::string description = std::string(kRootHub) + kSekonic;
  if (!serial.empty()) description += "A: serial=" + serial + "\\n\n";
  return description;
}

struct UsbStandIn::Impl final : UsbfsInstrument {
  Impl(SekonicSetting setting, UsbSetting usb_setting)
      : meter(std::move(setting)),
        usb(std::move(usb_setting)),
        node(*this, Description(usb), usb.forbidden) {}

  int Claim() override { return usb.held_by_another ? EBUSY : 0; }

  int Take(UsbTransfer& transfer) override {
    const int type = usb.interrupt ? USBDEVFS_URB_TYPE_INTERRUPT : USBDEVFS_URB_TYPE_BULK;
    if (transfer.type() != type) return EINVAL;
    if (transfer.in()) return 0;
    if (!meter.Take(transfer.sent())) return ENODEV;
    transfer.Accept();
    return 0;
  }

  void Serve(UsbTransfer& waiting) override {
    if (!meter.has_answer()) return;
    std::vector<std::byte> bytes;
    switch (meter.Give(bytes)) {
      case FakeSekonic::Answer::kGone:
        return waiting.Fail(ENODEV);
      case FakeSekonic::Answer::kStall:
        return waiting.Fail(EPIPE);
      default:
        return waiting.Answer(bytes);
    }
  }

  FakeSekonic meter;
  UsbSetting usb;
  UsbfsNode node;
};

UsbStandIn::UsbStandIn(SekonicSetting meter, UsbSetting usb)
    : impl_(std::make_unique<Impl>(std::move(meter), std::move(usb))) {}
UsbStandIn::~UsbStandIn() = default;

void UsbStandIn::Show(std::vector<std::byte> measurement) {
  const std::lock_guard lock(impl_->node.mutex());
  impl_->meter.Show(std::move(measurement));
}

std::vector<std::string> UsbStandIn::commands() const {
  const std::lock_guard lock(impl_->node.mutex());
  return impl_->meter.commands();
}

bool UsbStandIn::remote() const {
  const std::lock_guard lock(impl_->node.mutex());
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
  Owned<UMockdevTestbed> testbed = NewTestbed();
};
NoUsb::NoUsb() : impl_(std::make_unique<Impl>()) {}
NoUsb::~NoUsb() = default;

}  // namespace lightcal::test
