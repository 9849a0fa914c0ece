// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lightcal_devices/transport/tape.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices {

// Passes everything on to `inner` and writes it down in `tape`, faults included. Both outlive it.
class RecordingTransport final : public Transport {
 public:
  RecordingTransport(Transport& inner, Tape& tape)
      : inner_(inner), tape_(tape), start_(std::chrono::steady_clock::now()) {}

  Result<void> Write(std::span<const std::byte> bytes, std::chrono::milliseconds timeout) override;
  Result<Bytes> Read(std::size_t max, std::chrono::milliseconds timeout) override;
  Result<Bytes> Control(std::string_view verb, std::span<const std::byte> bytes, std::size_t max,
                        std::chrono::milliseconds timeout) override;
  [[nodiscard]] std::string Name() const override { return inner_.Name(); }

 private:
  // Stamps the time and keeps the exchange.
  void Keep(TapeExchange exchange);

  Transport& inner_;
  Tape& tape_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace lightcal::devices
