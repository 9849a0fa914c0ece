// SPDX-License-Identifier: Apache-2.0
// Anything that prints lux, and a person who types it. README.md tells the lines.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/meters/meter_table.h"
#include "lightcal_devices/meters/text/frame.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices::text {

inline constexpr std::array<MeterOption, 2> kOptions = {
    {{"sigma", "1 sigma of a reading: 0.05 or 5%"},
     {"quality", "photometer, colorimeter, spectral or bare_sensor"}}};

// A source nobody vouches for: a photodiode without cosine corrector, in its maker's scale.
inline constexpr double kUndeclaredSigma = 0.30;
// Lines that are no readings, before a source is given up; and lines of any kind.
inline constexpr int kMostBadLines = 16;
inline constexpr int kMostLines = 256;

struct TextKind {
  std::string driver;           // "line"
  std::optional<double> sigma;  // of a reading whose sigma nobody declared; absent = the session's
  MeterQuality quality = MeterQuality::kUnknown;
  int most_bad_lines = 0;
};

// Errors besides the transport's own: bad_reply (too many lines that are no readings), interrupted;
// wrong usage: an option that makes no sense.
class TextMeter final : public Meter {
 public:
  TextMeter(Transport& transport, const MeterSetup& setup, TextKind kind);
  Result<MeterIdentity> Identify() override;
  // The next line that is a reading. Warns bad_lines where others came before it.
  Result<MeterReading> Measure(const Cancellation& cancellation) override;

 private:
  Result<TextReading> NextReading(const Cancellation& cancellation, int& bad_lines);
  [[nodiscard]] std::string DeviceName() const;

  Transport& transport_;
  MeterSetup setup_;
  TextKind kind_;
};

// For the meter table: "line" and "typed".
[[nodiscard]] std::unique_ptr<Meter> MakeLine(Transport& transport, const MeterSetup& setup);
[[nodiscard]] std::unique_ptr<Meter> MakeTyped(Transport& transport, const MeterSetup& setup);

}  // namespace lightcal::devices::text
