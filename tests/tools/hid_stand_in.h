// SPDX-License-Identifier: Apache-2.0
// A USB HID device of 64-byte reports for the real hidapi-libusb, simulated in the test's own
// process by umockdev. Programs the test starts see it too. Needs umockdev-wrapper.
#pragma once

#include <memory>

#include "fake_mcp2221.h"

namespace lightcal::test {

struct BridgeSetting {
  bool kernel_driver = true;     // hid_mcp2221 owns the interface
  bool driver_stays = false;     // ... and cannot be detached
  bool held_by_another = false;  // a program has claimed it (the kernel then shows usbfs)
  bool forbidden = false;        // its node belongs to nobody
};

// A MCP2221A at 1-1, its HID interface 1-1:1.2.
class BridgeStandIn {
 public:
  BridgeStandIn(Mcp2221Setting bridge, BridgeSetting usb);
  explicit BridgeStandIn(Mcp2221Setting bridge)
      : BridgeStandIn(std::move(bridge), BridgeSetting{}) {}
  ~BridgeStandIn();
  BridgeStandIn(const BridgeStandIn&) = delete;
  BridgeStandIn& operator=(const BridgeStandIn&) = delete;

  [[nodiscard]] bool engine_idle() const;
  [[nodiscard]] std::size_t requests() const;
  [[nodiscard]] bool driver_attached() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lightcal::test
