// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightcal_devices/transport/tape.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal {

// Plays a tape: the driver must write what was written then, and hears what was answered then,
// faults included, without waiting. A different write fails as tape_mismatch and shows both; a
// question after the last line fails as tape_ended.
class ReplayTransport final : public Transport {
 public:
  explicit ReplayTransport(Tape tape) : tape_(std::move(tape)) {}

  Result<void> Write(std::span<const std::byte> bytes, std::chrono::milliseconds timeout) override;
  Result<Bytes> Read(std::size_t max, std::chrono::milliseconds timeout) override;
  [[nodiscard]] std::string Name() const override { return "tape of " + tape_.driver; }

  // Lines not yet played; above 0 at the end means the driver now asks less than it did.
  [[nodiscard]] std::size_t Unconsumed() const { return tape_.lines.size() - next_; }

 private:
  [[nodiscard]] Result<const TapeLine*> Next(const std::string& asked) const;
  [[nodiscard]] tl::unexpected<Error> Mismatch(const TapeLine& line,
                                               const std::string& asked) const;
  [[nodiscard]] tl::unexpected<Error> RecordedFault();  // plays the fault that comes next

  Tape tape_;
  std::size_t next_ = 0;
};

}  // namespace lightcal
