// SPDX-License-Identifier: Apache-2.0
// The files a session names.
#pragma once

#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/session.h"
#include "lightcal/records/sources.h"

namespace lightcal {

// Counts the file among what was read, once.
void NoteInputFile(const std::string& path, Session& session);

struct OneSpectrum {
  ImportedSpectrum imported;
  std::string format;  // ImportedFile::format
  Warnings warnings;
};
// The only spectrum of a meter's file.  Refused: several_spectra, whose subject is `where`, and as
// Sources::read_spectra.
[[nodiscard]] Result<OneSpectrum> ReadTheOneSpectrum(const Sources& sources,
                                                     const std::string& path,
                                                     const std::string& where);

}  // namespace lightcal
