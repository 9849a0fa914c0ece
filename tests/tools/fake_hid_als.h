// SPDX-License-Identifier: Apache-2.0
// A HID light sensor as a Transport, without waiting.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "lightcal_devices/transport/transport.h"

namespace lightcal::test {

class FakeHidAls final : public devices::Transport {
 public:
  devices::Bytes descriptor;
  devices::Bytes feature;             // report 1, its number first; empty = it has none
  std::deque<devices::Bytes> inputs;  // those that come by themselves
  devices::Bytes polled;              // what get_input brings; empty = it refuses
  bool unplugged_at_read = false;
  std::vector<devices::Bytes> features_set;

  Result<void> Write(std::span<const std::byte>, std::chrono::milliseconds) override {
    return Failed(std::string(devices::fault::kIo), Name(), "takes no output report");
  }
  Result<devices::Bytes> Read(std::size_t, std::chrono::milliseconds) override {
    if (unplugged_at_read) return Failed(std::string(devices::fault::kUnplugged), Name(), "gone");
    if (inputs.empty()) return Failed(std::string(devices::fault::kTimeout), Name(), "silent");
    devices::Bytes report = inputs.front();
    inputs.pop_front();
    return report;
  }
  Result<devices::Bytes> Control(std::string_view verb, std::span<const std::byte> bytes,
                                 std::size_t max, std::chrono::milliseconds timeout) override {
    if (verb == "report_descriptor") return descriptor;
    if (verb == "get_feature" && !feature.empty()) return feature;
    if (verb == "get_input" && !polled.empty()) return polled;
    if (verb == "set_feature" && !feature.empty()) {
      feature.assign(bytes.begin(), bytes.end());
      features_set.push_back(feature);
      return devices::Bytes();
    }
    return devices::Transport::Control(verb, bytes, max, timeout);
  }
  [[nodiscard]] std::string Name() const override { return "fake sensor"; }
};

}  // namespace lightcal::test
