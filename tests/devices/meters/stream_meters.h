// SPDX-License-Identifier: Apache-2.0
// What the tests of the small serial meters share.
#pragma once

#include <gmock/gmock.h>

#include "fake_transport.h"
#include "hex_bytes.h"
#include "lightcal_devices/transport/recording.h"
#include "lightcal_devices/transport/replay.h"
#include "lightcal_devices/transport/tape_codec.h"
#include "stream_instrument.h"

namespace lightcal::test {

inline std::string Hex(const std::string& text) { return AsText(FromHex(text)); }

inline std::vector<std::string> CodesOf(const devices::MeterReading& reading) {
  std::vector<std::string> codes;
  for (const Warning& warning : reading.warnings) codes.push_back(warning.code);
  return codes;
}

using Make = std::unique_ptr<devices::Meter> (*)(devices::Transport&, const devices::MeterSetup&);

// One measurement of a meter in memory.
inline Result<devices::MeterReading> MeasuredOn(StreamFake& line, Make make) {
  return make(line, QuickSetup())->Measure(devices::Cancellation());
}
inline Result<devices::MeterReading> Measured(Speak speak, Make make) {
  StreamFake line(std::move(speak));
  return MeasuredOn(line, make);
}

// Whether what is recorded, through the tape's file, plays to the same reading or error.
inline void ExpectReplaysToTheSame(Speak speak, Make make) {
  StreamFake line(std::move(speak));
  devices::Tape tape;
  tape.driver = "any";
  devices::RecordingTransport recording(line, tape);
  const auto first = make(recording, QuickSetup())->Measure(devices::Cancellation());
  const auto read_back = devices::TapeFromText(devices::TapeToText(tape), "tape");
  ASSERT_TRUE(read_back) << read_back.error().message;
  devices::ReplayTransport replay(*read_back);
  const auto again = make(replay, QuickSetup())->Measure(devices::Cancellation());
  EXPECT_EQ(replay.Unconsumed(), 0U);
  ASSERT_EQ(first.has_value(), again.has_value());
  if (!first) {
    EXPECT_EQ(first.error().code, again.error().code);
    return;
  }
  EXPECT_EQ(first->reading.illuminance->value(), again->reading.illuminance->value());
  EXPECT_EQ(first->reading.over_range, again->reading.over_range);
  EXPECT_EQ(CodesOf(*first), CodesOf(*again));
}

// Cancels at the n-th read, as Ctrl-C would in the middle.
class CancelAtRead final : public devices::Transport {
 public:
  CancelAtRead(devices::Transport& inner, devices::Cancellation& cancellation, int reads)
      : inner_(inner), cancellation_(cancellation), left_(reads) {}
  Result<void> Write(std::span<const std::byte> bytes, std::chrono::milliseconds t) override {
    return inner_.Write(bytes, t);
  }
  Result<devices::Bytes> Read(std::size_t max, std::chrono::milliseconds t) override {
    if (--left_ == 0) cancellation_.Request();
    return inner_.Read(max, t);
  }
  [[nodiscard]] std::string Name() const override { return inner_.Name(); }

 private:
  devices::Transport& inner_;
  devices::Cancellation& cancellation_;
  int left_;
};

}  // namespace lightcal::test
