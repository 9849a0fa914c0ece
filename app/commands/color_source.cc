// SPDX-License-Identifier: Apache-2.0
#include "color_source.h"

#include <string_view>
#include <utility>

#include "lightcal/colorimetry/illuminants.h"

namespace lightcal::app {
namespace {

constexpr std::string_view kIlluminant = "illuminant:";

}  // namespace

bool NamesIlluminant(const std::string& source) { return source.starts_with(kIlluminant); }

Result<ImportedFile> ReadSpectrumSource(const std::string& source) {
  if (!NamesIlluminant(source)) return ImportFile(source);
  const std::string name = source.substr(kIlluminant.size());
  auto spectrum = IlluminantSpectrum(name);
  if (!spectrum) return Propagate(std::move(spectrum));
  ImportedFile file;
  file.spectra.push_back({name, std::move(*spectrum), {}, source});
  return file;
}

Result<std::vector<ImportedSpectrum>> ChosenSpectra(ImportedFile& file, const std::string& source,
                                                    const std::string& column) {
  if (file.spectra.empty()) {
    return Refused("no_spectrum", source,
                   "holds readings but no spectrum; import it into a session instead");
  }
  if (column.empty()) return std::move(file.spectra);
  auto index = FindSpectrum(file, column);
  if (!index) return Propagate(std::move(index));
  return std::vector<ImportedSpectrum>{std::move(file.spectra[*index])};
}

Warnings WarningsOfChosen(const Warnings& warnings, const std::string& chosen_name) {
  constexpr std::string_view kColumn = ", column ";
  Warnings kept;
  for (const Warning& warning : warnings) {
    const auto at = warning.subject.rfind(kColumn);
    const bool of_another = !chosen_name.empty() && at != std::string::npos &&
                            warning.subject.substr(at + kColumn.size()) != chosen_name;
    if (!of_another) kept.push_back(warning);
  }
  return kept;
}

}  // namespace lightcal::app
