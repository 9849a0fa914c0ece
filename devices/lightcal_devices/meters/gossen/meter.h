// SPDX-License-Identifier: Apache-2.0
// The dialogue with a Gossen MAVOLUX 5032 B or C USB. README.md tells the protocol.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "lightcal_devices/meters/gossen/frame.h"
#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/meters/meter_table.h"
#include "lightcal_devices/transport/framing.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices::gossen {

inline constexpr std::array<MeterOption, 1> kOptions = {
    {{"class", "accuracy class of the meter after DIN 5032-7: B or C (C)"}}};

// 1 sigma, beside one digit of the display: the limits of the two classes taken as they stand.
inline constexpr double kSigmaRelativeClassB = 0.05;
inline constexpr double kSigmaRelativeClassC = 0.10;
// The top of the highest range: what "over range" means in automatic range.
inline constexpr double kHighestIlluminanceLx = 199900.0;
// The meter measures every two seconds; an answer that is a measurement may take this many times
// as long as another.
inline constexpr int kMeasurementReplies = 5;

// Errors besides the transport's own: bad_reply and serial_error (after one more try),
// luminance_head, and those of ErrorOf.
class GossenMeter final : public Meter {
 public:
  // `transport` outlives the meter. Without a serial the one the meter tells names the device.
  GossenMeter(Transport& transport, const MeterSetup& setup);

  Result<MeterIdentity> Identify() override;
  Result<MeterReading> Measure(const Cancellation& cancellation) override;

 private:
  // A command and the line that answers it; an "ERROR = n" is that error.
  Result<std::string> AskOnce(std::string_view command, std::chrono::milliseconds timeout);
  template <class Decode>
  auto Ask(std::string_view command, Decode decode, int timeouts = 1)
      -> decltype(decode(std::string()));
  Result<void> SetAutomaticRange();
  [[nodiscard]] std::string DeviceName() const { return "gossen:" + serial_; }

  Transport& transport_;
  StreamReader reader_;
  MeterTiming timing_;
  std::string class_;
  std::string serial_;
  bool identified_ = false;
  bool automatic_ = false;  // automatic range is set
};

// For the meter table.
[[nodiscard]] std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup);

}  // namespace lightcal::devices::gossen
