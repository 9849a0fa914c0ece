// SPDX-License-Identifier: Apache-2.0
#include "color_source.h"

#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

#include "input_files.h"
#include "lightcal/colorimetry/illuminants.h"
#include "lightcal/colorimetry/light_models.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal::app {
namespace {

constexpr std::string_view kIlluminant = "illuminant:";
constexpr std::string_view kGaussian = "gaussian:";
constexpr std::string_view kLed = "led:";

// "530:30" -> 530, 30; "4000" -> 4000 and nothing.
struct Parameters {
  double first = 0.0;
  std::optional<double> second;
};
Result<Parameters> ParseParameters(const std::string& source, std::string_view text) {
  const std::size_t colon = text.find(':');
  const auto first = ParseNumber(text.substr(0, colon));
  const bool has_second = colon != std::string_view::npos;
  const auto second = has_second ? ParseNumber(text.substr(colon + 1)) : std::nullopt;
  if (!first || (has_second && !second)) {
    return WrongUsage("--spectrum", "\"" + source +
                                        "\" is not gaussian:PEAK_NM:WIDTH_NM or "
                                        "led:KELVIN[:PHOSPHOR_NM]");
  }
  return Parameters{*first, second};
}

Result<Spectrum> NamedSpectrum(const std::string& source) {
  if (source.starts_with(kIlluminant)) return IlluminantSpectrum(source.substr(kIlluminant.size()));
  const bool led = source.starts_with(kLed);
  const auto parameters =
      ParseParameters(source, std::string_view(source).substr((led ? kLed : kGaussian).size()));
  if (!parameters) return tl::unexpected(parameters.error());
  const auto [first, second] = *parameters;
  if (!led) return GaussianSpectrum(Nanometres(first), Nanometres(second.value_or(20.0)));
  return second ? PhosphorLedSpectrum(Kelvin(first), Nanometres(*second))
                : PhosphorLedSpectrum(Kelvin(first));
}

}  // namespace

bool NamesIlluminant(const std::string& source) {
  return source.starts_with(kIlluminant) || source.starts_with(kGaussian) ||
         source.starts_with(kLed);
}

Result<ImportedFile> ReadSpectrumSource(const std::string& source) {
  if (!NamesIlluminant(source)) {
    NoteInput(source);
    auto file = devices::ImportFile(source);
    if (!file) {
      // Here a table says itself what its columns are.
      constexpr std::string_view kColumns = "{import.columns}";
      Error error = std::move(file).error();
      if (const auto at = error.message.find(kColumns); at != std::string::npos) {
        error.message.replace(at, kColumns.size(),
                              "wavelength_nm,irradiance_W_m2_nm (or relative) in its first line");
      }
      return tl::unexpected(std::move(error));
    }
    return file;
  }
  auto spectrum = NamedSpectrum(source);
  if (!spectrum) return Propagate(std::move(spectrum));
  ImportedFile file;
  const std::string name =
      source.starts_with(kIlluminant) ? source.substr(kIlluminant.size()) : source;
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
  file.warnings = WarningsAbout(file, *index);
  return std::vector<ImportedSpectrum>{std::move(file.spectra[*index])};
}

}  // namespace lightcal::app
