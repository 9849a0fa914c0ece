// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightcal_devices/transport/tape.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices {

// Plays a tape: the driver must ask what was asked then, and hears what was answered then, faults
// included, without waiting. Another question fails as tape_mismatch, shows both and plays nothing;
// a question after the last exchange fails as tape_ended.
class ReplayTransport final : public Transport {
 public:
  explicit ReplayTransport(Tape tape) : tape_(std::move(tape)) {}

  Result<void> Write(std::span<const std::byte> bytes, std::chrono::milliseconds timeout) override;
  Result<Bytes> Read(std::size_t max, std::chrono::milliseconds timeout) override;
  Result<Bytes> Control(std::string_view verb, std::span<const std::byte> bytes, std::size_t max,
                        std::chrono::milliseconds timeout) override;
  [[nodiscard]] std::string Name() const override { return "tape of " + tape_.driver; }

  // Exchanges not yet played; above 0 at the end means the driver now asks less than it did.
  [[nodiscard]] std::size_t Unconsumed() const { return tape_.exchanges.size() - next_; }

 private:
  Result<Bytes> Play(const TapeExchange& asked, std::size_t max);

  Tape tape_;
  std::size_t next_ = 0;
};

}  // namespace lightcal::devices
