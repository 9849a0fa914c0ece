// SPDX-License-Identifier: Apache-2.0
// The television lighting consistency index, as ArgyllCMS computes it.
#pragma once

#include <string>

#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/result.h"

namespace lightcal::app {

// Qa of TLCI-2012 (EBU Tech 3355), 0 to 100. Its camera and monitor are data we may not pass on, so
// the number is that of ArgyllCMS's program specplot, if it is installed.
struct Tlci {
  double qa = 0.0;
  bool far_from_white = false;  // specplot calls the index invalid: too far from the reference
  std::string by;               // "ArgyllCMS 2.3.1"
};

// Runs specplot, at most five seconds. Equal steps of 1 nm and more go to it as they are, all
// others and more than 600 samples as 1 nm by area. Fails: no_program when specplot is not on PATH,
// io, and program_failed when it prints no index; refused/"no_tlci" when it finds that the light
// has none.
[[nodiscard]] Result<Tlci> TlciByArgyll(const Spectrum& spectrum);

}  // namespace lightcal::app
