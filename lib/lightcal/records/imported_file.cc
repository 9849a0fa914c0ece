// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/imported_file.h"

#include <algorithm>
#include <cmath>

#include "lightcal/core/numbers_text.h"

namespace lightcal {

Result<std::size_t> FindSpectrum(const ImportedFile& file, std::string_view column) {
  const auto named = std::ranges::find(file.spectra, column, &ImportedSpectrum::name);
  if (named != file.spectra.end()) {
    return static_cast<std::size_t>(named - file.spectra.begin());
  }
  const auto number = ParseNumber(column);
  const auto count = static_cast<double>(file.spectra.size());
  if (number && *number >= 1.0 && *number <= count && *number == std::floor(*number)) {
    return static_cast<std::size_t>(*number) - 1;
  }
  std::string names;
  for (const ImportedSpectrum& spectrum : file.spectra) {
    if (!spectrum.name.empty()) names += (names.empty() ? "" : ", ") + spectrum.name;
  }
  return Refused("unknown_column", std::string(column),
                 "the file has " + std::to_string(file.spectra.size()) +
                     " spectra; name one by its number from 1" +
                     (names.empty() ? "" : " or its name: " + names));
}

const Warning* IlluminanceDoubt(const Warnings& warnings) {
  const auto doubt = std::ranges::find(warnings, "spectrum_disagrees", &Warning::code);
  return doubt == warnings.end() ? nullptr : &*doubt;
}

Warnings WarningsAbout(const ImportedFile& file, std::size_t spectrum) {
  const std::string& where = file.spectra[spectrum].where;
  Warnings about = file.warnings;
  std::erase_if(about, [&](const Warning& warning) {
    const bool of_a_spectrum = std::ranges::find(file.spectra, warning.subject,
                                                 &ImportedSpectrum::where) != file.spectra.end();
    return of_a_spectrum && warning.subject != where;
  });
  return about;
}

}  // namespace lightcal
