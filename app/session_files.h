// SPDX-License-Identifier: Apache-2.0
// The files a session names.
#pragma once

#include <string>

#include "lightcal/core/result.h"
#include "lightcal/records/session.h"
#include "lightcal_devices/files/import_file.h"

namespace lightcal::app {

// Names in a session are relative to its directory.
[[nodiscard]] std::string PathInSession(const Session& session, const std::string& name);

// Counts the file among what was read, once.
void NoteInputFile(const std::string& path, Session& session);

struct OneSpectrum {
  ImportedSpectrum imported;
  Warnings warnings;
};
// The only spectrum of a meter's file.  Refused: several_spectra, and as ImportFile; the subject is
// `where`.
[[nodiscard]] Result<OneSpectrum> ReadTheOneSpectrum(const std::string& path,
                                                     const std::string& where);

}  // namespace lightcal::app
