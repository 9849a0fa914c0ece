// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/evidence.h"

#include <algorithm>

namespace lightcal {

void Evidence::AddFile(const std::string& path) {
  if (std::ranges::find(files, path) == files.end()) files.push_back(path);
}

void Evidence::AddSpectrum(const std::string& light, const std::string& file,
                           const Spectrum& spectrum) {
  const bool known = std::ranges::any_of(
      spectra, [&](const NamedSpectrum& one) { return one.light == light && one.state.empty(); });
  if (!known) spectra.push_back({light, file, spectrum});
}

void Evidence::AddWarnings(const Warnings& more) {
  warnings.insert(warnings.end(), more.begin(), more.end());
}

}  // namespace lightcal
