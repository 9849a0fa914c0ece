// SPDX-License-Identifier: Apache-2.0
// What ArgyllCMS' spotread prints, as values. Pure: no program, no clock.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/result.h"

namespace lightcal::devices::spotread {

inline constexpr std::string_view kBadReply = "bad_reply";

// The output of one run of spotread -a -x -T [-s] -O. What was not printed is absent.
struct Report {
  std::optional<double> illuminance_lx;  // Y with six decimals; in ambient mode it is lux
  std::optional<Xyz> xyz;                // absent of a head with one channel
  std::optional<double> cct_K;
  std::optional<double> duv;
  std::optional<double> cri_Ra;
  std::vector<double> cri_R;  // R1 .. R14, or empty
  std::optional<double> tlci_Qa;
  std::optional<double> tm30_Rf;
  std::optional<double> tm30_Rg;
  bool rendering_doubtful = false;   // an index came with "(Caution)"
  std::optional<Spectrum> spectrum;  // W m^-2 nm^-1; spotread prints mW
  std::string instrument;            // "i1 Pro 2", as -v tells, "" = it did not
  std::string serial;
};

// Fails: bad_reply (a Y that is no number of lux, a spectrum with another number of samples than it
// says). A figure besides these that is no number is left out.
[[nodiscard]] Result<Report> DecodeReport(std::string_view text);

// What spotread has come to, as far as its text goes.
enum class Situation {
  kNone,
  kAsksToRetry,    // waits for a key: q ends it. At the end of its input it would retry for ever.
  kWrongPosition,  // repeats itself for ever: the sensor's dial is not at ambient
};
// The first situation in `text` from `from` on; `from` is moved behind it.
[[nodiscard]] Situation NextSituation(std::string_view text, std::size_t& from);

// Why a run ended without a result, from its whole text.
enum class Ending {
  kUnknown,
  kNoInstrument,       // none detected, or none at that port
  kNoConnection,       // one is there and does not answer
  kNoAmbient,          // it cannot measure illuminance
  kNoSpectrum,         // -s was asked of a colorimeter
  kCalibrated,         // by itself; a further run measures
  kPlacedToCalibrate,  // in a position the person had to put it into
  kWrongPosition,
  kTooDark,  // no light to compute a colour temperature of
  kSaturated,
  kMisread,
  kCommunication,
  kFatal,
  kBadOption,
};
[[nodiscard]] Ending EndingOf(std::string_view text);

// The lines that tell the person where to put the instrument, joined by blanks; "" = none.
[[nodiscard]] std::string CalibrationInstructions(std::string_view text);

// The line that tells the ending, or else the last one that says anything; shortened to what fits a
// message.
[[nodiscard]] std::string TellingLine(std::string_view text, Ending ending);

// "Lookup ICC or CAL colors, Version 2.3.1\n..." -> "2.3.1", absent when there is none.
[[nodiscard]] std::optional<std::string> VersionIn(std::string_view usage);

}  // namespace lightcal::devices::spotread
