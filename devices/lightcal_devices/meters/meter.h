// SPDX-License-Identifier: Apache-2.0
// What every instrument answers, whatever its wire.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/result.h"
#include "lightcal/records/reading.h"
#include "lightcal_devices/transport/cancellation.h"

namespace lightcal::devices {

struct MeterIdentity {
  std::string model;     // "C-800"
  std::string firmware;  // as the device spells it, "" = not asked
  Warnings warnings;     // untested_model
};

// One measurement. `reading` carries what the meter knows: illuminance, colour, sigma, device; the
// caller adds light, place and time.
struct MeterReading {
  Reading reading;
  std::optional<Spectrum> spectrum;  // W m^-2 nm^-1
  std::optional<double> cri_Ra;
  std::vector<double> cri_R;      // R1 .. R15, or R1 .. R14, or empty
  std::optional<double> tlci_Qa;  // television lighting consistency, EBU Tech 3355
  std::optional<double> tm30_Rf;  // as the instrument computes them, IES TM-30
  std::optional<double> tm30_Rg;
  Warnings warnings;  // low_light_color, cct_out_of_range, self_check, not_restored, ...
};

// How long to wait. Polls are counted, not timed, so that a replayed dialogue is the recorded one.
struct MeterTiming {
  std::chrono::milliseconds reply{1000};  // longest wait for one transfer
  std::chrono::milliseconds drain{50};    // silence after which the line counts as empty
  std::chrono::milliseconds poll{50};     // between two questions for the state
  int ready_polls = 100;                  // until the meter is idle: 5 s
  int measure_polls = 400;                // until a measurement is done: 20 s
  bool live = true;                       // false on a tape or a fake: Pause returns at once

  // Waits as the protocol asks between two exchanges.
  void Pause(std::chrono::milliseconds duration) const;
};

// What a meter is made with.
struct MeterSetup {
  std::string serial;  // "" = the device has none
  MeterTiming timing;
  std::map<std::string, std::string> options;  // by name; MeterRow::options lists them
};

class Meter {
 public:
  Meter() = default;
  virtual ~Meter() = default;
  Meter(const Meter&) = delete;
  Meter& operator=(const Meter&) = delete;

  virtual Result<MeterIdentity> Identify() = 0;
  // One measurement. Leaves the device as it was found (remote control off), also after an error or
  // a cancellation, which fails as "interrupted".
  virtual Result<MeterReading> Measure(const Cancellation& cancellation) = 0;
  // A reading the instrument keeps in its memory, numbered from 0. Refused: no_memory (this driver
  // reads none), no_such_reading.
  virtual Result<MeterReading> ReadMemory(int index, const Cancellation& cancellation);
};

}  // namespace lightcal::devices
