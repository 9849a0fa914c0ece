// SPDX-License-Identifier: Apache-2.0
// A USB instrument for the real libusb, simulated in the test's own process by umockdev. Programs
// the test starts see it too. Needs the test to run under umockdev-wrapper.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fake_sekonic.h"

namespace lightcal::test {

struct UsbSetting {
  std::string serial;            // "" = the device has none
  bool held_by_another = false;  // claiming its interface answers EBUSY
  bool forbidden = false;        // its node belongs to nobody
  bool interrupt = false;        // its endpoints are interrupt ones and take no bulk transfer
};

// The device as a umockdev file describes it (for umockdev-run -d), and its place in sysfs.
[[nodiscard]] std::string SekonicDescription(const std::string& serial);
inline constexpr const char* kSekonicSysfs = "/sys/devices/pci0000:00/usb1/1-1";

class UsbStandIn {
 public:
  UsbStandIn(SekonicSetting meter, UsbSetting usb);
  explicit UsbStandIn(SekonicSetting meter) : UsbStandIn(std::move(meter), UsbSetting{}) {}
  ~UsbStandIn();
  UsbStandIn(const UsbStandIn&) = delete;
  UsbStandIn& operator=(const UsbStandIn&) = delete;

  // The meter's next measurement answers with this reply.
  void Show(std::vector<std::byte> measurement);
  [[nodiscard]] std::vector<std::string> commands() const;
  [[nodiscard]] bool remote() const;
  // Waits (5 s at most) until the device has taken this command; whether it has.
  [[nodiscard]] bool WaitForCommand(const std::string& command) const;

  // Put before a program so that permissions bind it even when the tests run as root; empty when
  // they bind anyway.
  [[nodiscard]] static std::vector<std::string> WithoutRootPowers();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// An empty machine: no USB device at all.
class NoUsb {
 public:
  NoUsb();
  ~NoUsb();
  NoUsb(const NoUsb&) = delete;
  NoUsb& operator=(const NoUsb&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lightcal::test
