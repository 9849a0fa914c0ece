// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fake_sekonic.h"
#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::test {

// A FakeSekonic as a Transport, without waiting.
class FakeTransport final : public devices::Transport {
 public:
  explicit FakeTransport(SekonicSetting setting) : meter_(std::move(setting)) {}

  Result<void> Write(std::span<const std::byte> bytes, std::chrono::milliseconds) override {
    if (meter_.Take(bytes)) return {};
    return Failed(std::string(devices::fault::kUnplugged), Name(), "gone");
  }
  Result<devices::Bytes> Read(std::size_t, std::chrono::milliseconds) override {
    devices::Bytes bytes;
    switch (meter_.Give(bytes)) {
      case FakeSekonic::Answer::kBytes:
        return bytes;
      case FakeSekonic::Answer::kNothing:
        return Failed(std::string(devices::fault::kTimeout), Name(), "silent");
      case FakeSekonic::Answer::kStall:
        return Failed(std::string(devices::fault::kStalled), Name(), "stalled");
      case FakeSekonic::Answer::kGone:
        return Failed(std::string(devices::fault::kUnplugged), Name(), "gone");
    }
    return devices::Bytes();
  }
  [[nodiscard]] std::string Name() const override { return "fake"; }
  [[nodiscard]] const FakeSekonic& meter() const { return meter_; }

 private:
  FakeSekonic meter_;
};

// No test waits longer than this for what will not come.
inline devices::MeterSetup QuickSetup(const std::string& serial = "") {
  devices::MeterSetup setup;
  setup.serial = serial;
  devices::MeterTiming& timing = setup.timing;
  timing.live = false;
  timing.reply = std::chrono::milliseconds(100);
  timing.drain = std::chrono::milliseconds(10);
  timing.ready_polls = 5;
  timing.measure_polls = 10;
  return setup;
}

inline SekonicSetting Answering407lx() {
  SekonicSetting setting;
  setting.measurement = RecordedReply(kReply407lx);
  return setting;
}

}  // namespace lightcal::test
