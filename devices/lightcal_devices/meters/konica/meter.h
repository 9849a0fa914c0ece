// SPDX-License-Identifier: Apache-2.0
// The dialogue with a Konica Minolta T-10A or CL-200A. README.md tells the protocol.
#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <string>
#include <string_view>

#include "lightcal_devices/meters/konica/frame.h"
#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/meters/meter_table.h"
#include "lightcal_devices/transport/framing.h"
#include "lightcal_devices/transport/transport.h"
#include "lightcal_devices/transport/tty.h"

namespace lightcal::devices::konica {

inline constexpr SerialSettings kSerial = {9600, 7, Parity::kEven, 1, true};
inline constexpr std::array<MeterOption, 1> kOptions = {
    {{"head", "receptor head of a multi-point set-up, 0 to 29 (0)"}}};

// What both models share: commands, replies, pauses.
class Link {
 public:
  Link(Transport& transport, const MeterSetup& setup, std::string_view driver,
       std::string_view model);

  // PC connection mode. Wrong usage: a head that is none.
  Result<void> Connect();
  // A command to our head that answers with its status.
  Result<Condition> Order(int command, std::string_view parameters);
  // A command to all heads, after which the meter is given `pause`; whatever it answers is not
  // listened to.
  Result<void> Announce(int command, std::string_view parameters, std::chrono::milliseconds pause);
  // A question to our head. A damaged reply is asked for once more; a state that makes the
  // measurement worthless is an error: head_power_off, memory_error, battery_low.
  Result<LongReply> Ask(int command, std::string_view parameters);
  // Fails: interrupted.
  Result<void> Wait(std::chrono::milliseconds duration, const Cancellation& cancellation) const;

  [[nodiscard]] const std::string& device() const { return device_; }
  [[nodiscard]] const std::string& model() const { return model_; }

 private:
  Result<void> Send(int head, int command, std::string_view parameters);
  Result<LongReply> AskOnce(int command, std::string_view parameters);
  [[nodiscard]] tl::unexpected<Error> InCommand(int command, Error error) const;

  Transport& transport_;
  StreamReader reader_;
  MeterTiming timing_;
  std::string head_text_;
  int head_ = -1;  // known after Connect
  std::string model_;
  std::string device_;
};

// Errors besides the transport's own: bad_reply (after one more try), head_power_off, memory_error,
// battery_low, ext_refused (CL-200A), interrupted.
class T10aMeter final : public Meter {
 public:
  T10aMeter(Transport& transport, const MeterSetup& setup)
      : link_(transport, setup, "konica_t10a", "T-10A") {}
  Result<MeterIdentity> Identify() override;
  Result<MeterReading> Measure(const Cancellation& cancellation) override;

 private:
  Link link_;
  bool connected_ = false;
  bool ranged_ = false;  // automatic range is set and had its 3 s
};

class Cl200aMeter final : public Meter {
 public:
  Cl200aMeter(Transport& transport, const MeterSetup& setup)
      : link_(transport, setup, "konica_cl200a", "CL-200A") {}
  Result<MeterIdentity> Identify() override;
  // Holds the meter, measures, and sets it running again.
  Result<MeterReading> Measure(const Cancellation& cancellation) override;

 private:
  Result<void> Hold(const Cancellation& cancellation);
  Result<void> SetExternalMode(const Cancellation& cancellation);
  Result<MeterReading> MeasureHeld(const Cancellation& cancellation);

  Link link_;
  bool connected_ = false;
};

// For the meter table.
[[nodiscard]] std::unique_ptr<Meter> MakeT10a(Transport& transport, const MeterSetup& setup);
[[nodiscard]] std::unique_ptr<Meter> MakeCl200a(Transport& transport, const MeterSetup& setup);

}  // namespace lightcal::devices::konica
