// SPDX-License-Identifier: Apache-2.0
// A MCP2221A with chips on its bus, in memory.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lightcal_devices/transport/transport.h"

namespace lightcal::test {

// One transfer with a chip: a write (bytes, 0) or a read ({}, count). Absent = it does not
// acknowledge.
using FakeChip =
    std::function<std::optional<devices::Bytes>(const devices::Bytes& written, std::size_t count)>;

struct Mcp2221Setting {
  std::map<std::uint8_t, FakeChip> chips;
  // What goes wrong, at the first request of this command and after it.
  enum class Fault { kNone, kSilent, kShort, kBusHeld, kAlwaysBusy, kUnplug };
  Fault fault = Fault::kNone;
  std::uint8_t fault_command = 0;
  bool busy_at_first = false;  // its engine is in the middle of something when it is opened
};

class FakeMcp2221 {
 public:
  explicit FakeMcp2221(Mcp2221Setting setting) : setting_(std::move(setting)) {}
  // The reply to one 64-byte request; absent = silence.
  [[nodiscard]] std::optional<devices::Bytes> Answer(const devices::Bytes& request);
  [[nodiscard]] bool gone() const { return gone_; }
  [[nodiscard]] unsigned engine() const { return engine_; }
  [[nodiscard]] const std::vector<std::uint8_t>& commands() const { return commands_; }

 private:
  void AnswerStatus(const devices::Bytes& request, devices::Bytes& reply);
  void AnswerTransfer(const devices::Bytes& request, devices::Bytes& reply);
  void AnswerFetch(devices::Bytes& reply);

  Mcp2221Setting setting_;
  unsigned engine_ = 0;
  bool nack_ = false;
  bool started_ = false;
  bool gone_ = false;
  devices::Bytes fetched_;
  std::vector<std::uint8_t> commands_;
};

// The bridge as a Transport of transport/hid.h, without waiting.
class FakeMcp2221Line final : public devices::Transport {
 public:
  explicit FakeMcp2221Line(Mcp2221Setting setting) : bridge_(std::move(setting)) {}
  Result<void> Write(std::span<const std::byte> bytes, std::chrono::milliseconds) override;
  Result<devices::Bytes> Read(std::size_t max, std::chrono::milliseconds) override;
  [[nodiscard]] std::string Name() const override { return "fake bridge"; }
  [[nodiscard]] const FakeMcp2221& bridge() const { return bridge_; }

 private:
  FakeMcp2221 bridge_;
  std::optional<devices::Bytes> reply_;
};

// Registers of a chip: what is in them, and what was written.
struct FakeRegisters {
  std::map<std::uint8_t, devices::Bytes> content;
  std::vector<devices::Bytes> written;
  std::function<void(FakeRegisters&)> after_write;
};
[[nodiscard]] FakeChip ChipOf(std::shared_ptr<FakeRegisters> registers);

// A BH1750 that answers these two bytes; `orders` keeps what it was told.
[[nodiscard]] FakeChip Bh1750(std::uint16_t counts, std::shared_ptr<devices::Bytes> orders);
// An OPT3001 and an OPT4048 with these results, ready after a single shot.
[[nodiscard]] std::shared_ptr<FakeRegisters> Opt3001(std::uint16_t result,
                                                     std::uint16_t ready = 0x0080);
[[nodiscard]] std::shared_ptr<FakeRegisters> Opt4048(const devices::Bytes& channels,
                                                     std::uint16_t status = 0x0004);
// A VEML7700 in light of this many lux a linear chip would see.
[[nodiscard]] std::shared_ptr<FakeRegisters> Veml7700(double linear_lx);

}  // namespace lightcal::test
