// SPDX-License-Identifier: Apache-2.0
// The dialogue with ArgyllCMS' spotread. README.md tells how.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/meters/spotread/frame.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices {
struct FoundMeter;
}  // namespace lightcal::devices

namespace lightcal::devices::spotread {

// Errors besides the transport's own: bad_reply, no_ambient, calibrated (put the instrument back
// and read again), wrong_position, too_dark, over_range, misread, communication, instrument_error,
// no_device, interrupted; usage for an option that is no such value.
class SpotreadMeter final : public Meter {
 public:
  // `transport` is a program as OpenProcess runs it and outlives the meter. Options: port (a number
  // of the list spotread -? prints), ccss (a .ccss or .ccmx file), hires (yes or no), spotread (the
  // program's path).
  SpotreadMeter(Transport& transport, const MeterSetup& setup)
      : transport_(transport),
        serial_(setup.serial),
        timing_(setup.timing),
        options_(setup.options) {}

  // Starts nothing: spotread talks to every serial port it sees.
  Result<MeterIdentity> Identify() override;
  // Runs spotread, again when it first had to calibrate itself or is a colorimeter asked for a
  // spectrum; at most four times in all.
  Result<MeterReading> Measure(const Cancellation& cancellation) override;

 private:
  [[nodiscard]] Result<void> ReadOptions();
  [[nodiscard]] std::vector<std::string> Arguments() const;
  // Everything one run prints; it is over when this returns.
  Result<std::string> RunOnce(const Cancellation& cancellation);
  Result<std::string> Listen(const Cancellation& cancellation);
  // Answers what spotread waits for. False: it must be stopped.
  Result<bool> Answer(Situation situation);
  void Stop();
  Result<Report> Measured(const Cancellation& cancellation, Warnings& warnings);
  [[nodiscard]] tl::unexpected<Error> Explain(Ending ending, std::string_view text) const;
  [[nodiscard]] std::string DeviceName(const Report& report) const;

  Transport& transport_;
  std::string serial_;
  MeterTiming timing_;
  std::map<std::string, std::string> options_;
  std::vector<std::string> chosen_;  // arguments the options ask for
  bool options_read_ = false;
  bool with_spectrum_ = true;  // until the instrument turns out to have none
  int prompts_ = 0;            // answered in this run
};

// What the report may be believed to say. Absent where it has no illuminance.
[[nodiscard]] MeterReading ReadingFromReport(const Report& report, const std::string& device);

// For the meter table.
[[nodiscard]] std::unique_ptr<Meter> MakeMeter(Transport& transport, const MeterSetup& setup);
// "ArgyllCMS 2.3.1; plugged in: i1 Display Pro (0765:5020)". The version comes from xicclu beside
// spotread, the instruments from sysfs: neither touches a port.
[[nodiscard]] std::string Describe(const FoundMeter& meter);

}  // namespace lightcal::devices::spotread
