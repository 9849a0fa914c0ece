// SPDX-License-Identifier: Apache-2.0
// Where `lightcal color --spectrum` takes its spectra from.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal_devices/files/import_file.h"

namespace lightcal::app {

// "illuminant:FL11", "gaussian:530:30" (peak and width in nm, 20 where absent) or "led:4000:580"
// (CCT and phosphor peak) rather than a file.
[[nodiscard]] bool NamesIlluminant(const std::string& source);

// An instrument's file, or the named illuminant or model as a file of one spectrum that claims
// nothing. Fails as ImportFile, IlluminantSpectrum, GaussianSpectrum and PhosphorLedSpectrum.
[[nodiscard]] Result<ImportedFile> ReadSpectrumSource(const std::string& source);

// The spectra asked for, taken out of the file: the one of `column`, or all where it is empty. The
// file keeps the warnings that concern them.
// Refused: no_spectrum, unknown_column.
[[nodiscard]] Result<std::vector<ImportedSpectrum>> ChosenSpectra(ImportedFile& file,
                                                                  const std::string& source,
                                                                  const std::string& column);

}  // namespace lightcal::app
