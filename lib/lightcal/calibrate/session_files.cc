// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/session_files.h"

#include <algorithm>
#include <utility>

namespace lightcal {

void NoteInputFile(const std::string& path, Session& session) {
  if (std::ranges::find(session.input_files, path) != session.input_files.end()) return;
  session.input_files.push_back(path);
}

Result<OneSpectrum> ReadTheOneSpectrum(const Sources& sources, const std::string& path,
                                       const std::string& where) {
  auto imported = sources.read_spectra(path);
  if (!imported) return Propagate(std::move(imported));
  if (imported->spectra.size() != 1) {
    return Refused("several_spectra", where,
                   path + " holds " + std::to_string(imported->spectra.size()) +
                       " spectra, one is needed; import the column you mean with "
                       "{ImportFile} {import.column} NAME");
  }
  return OneSpectrum{std::move(imported->spectra.front()), std::move(imported->format),
                     std::move(imported->warnings)};
}

}  // namespace lightcal
