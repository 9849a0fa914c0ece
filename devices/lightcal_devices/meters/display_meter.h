// SPDX-License-Identifier: Apache-2.0
// Hand-held lux meters that send what their display shows, and do not tell who they are.
#pragma once

#include <string>
#include <string_view>

#include "lightcal_devices/meters/frame_search.h"
#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal {

struct DisplayMeterName {
  std::string_view driver;  // "gm1020"
  std::string_view model;   // "GM1020": what the device is called when no serial number is given
};

class DisplayMeter : public Meter {
 public:
  // `transport` outlives the meter.
  DisplayMeter(Transport& transport, const MeterSetup& setup, const DisplayMeterName& name);

  Result<MeterIdentity> Identify() final;  // asks nothing: the meter does not tell

 protected:
  [[nodiscard]] Transport& transport() const { return transport_; }
  [[nodiscard]] const MeterTiming& timing() const { return timing_; }
  [[nodiscard]] const std::string& device() const { return device_; }  // "gm1020:GM1020"

 private:
  Transport& transport_;
  MeterTiming timing_;
  std::string model_, device_;
};

// What a meter sends unasked, frame after frame.
struct DisplayStream {
  FrameSearch search;
  int most_frames = 1;  // that are listened to, as FirstDecoded does
  Result<MeterReading> (*reading)(const Bytes& frame, const std::string& device) = nullptr;
};

// Listens, and says nothing.
class StreamMeter final : public DisplayMeter {
 public:
  StreamMeter(Transport& transport, const MeterSetup& setup, const DisplayMeterName& name,
              DisplayStream stream);

  Result<MeterReading> Measure(const Cancellation& cancellation) override;

 private:
  DisplayStream stream_;
};

}  // namespace lightcal
