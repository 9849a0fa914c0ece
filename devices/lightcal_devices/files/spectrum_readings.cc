// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/spectrum_readings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lightcal/core/numbers_text.h"

namespace lightcal::files {
namespace {

constexpr double kTolerance = 0.01;

struct IrradianceUnit {
  std::string_view name;
  double W_m2_nm;
};
constexpr std::array kUnits = {
    IrradianceUnit{"W m-2 nm-1", 1.0},        IrradianceUnit{"mW m-2 nm-1", 1e-3},
    IrradianceUnit{"uW m-2 nm-1", 1e-6},      IrradianceUnit{"W cm-2 nm-1", 1e4},
    IrradianceUnit{"mW cm-2 nm-1", 10.0},     IrradianceUnit{"uW cm-2 nm-1", 1e-2},
    IrradianceUnit{"nW cm-2 nm-1", 1e-5},     IrradianceUnit{"W m-2 per 5 nm", 0.2},
    IrradianceUnit{"mW m-2 per 5 nm", 2e-4},  IrradianceUnit{"W m-2 per 10 nm", 0.1},
    IrradianceUnit{"mW m-2 per 10 nm", 1e-4},
};

bool IsDark(const Spectrum& spectrum) {
  return std::ranges::none_of(spectrum.values, [](double value) { return value > 0.0; });
}

Result<void> CheckSamples(const FoundSpectrum& found) {
  const Spectrum& spectrum = found.imported.spectrum;
  const std::size_t size = spectrum.wavelengths_nm.size();
  if (size < 2 || spectrum.values.size() != size) {
    return Refused("bad_spectrum", found.where,
                   "holds " + std::to_string(size) +
                       " spectral samples, at least 2 are needed; the file is cut short");
  }
  for (std::size_t i = 0; i < size; ++i) {
    const double wavelength = spectrum.wavelengths_nm[i];
    if (!std::isfinite(spectrum.values[i]) || !std::isfinite(wavelength)) {
      return Refused("bad_spectrum", found.where,
                     "sample " + std::to_string(i + 1) + " is not a finite number");
    }
    if (i > 0 && wavelength <= spectrum.wavelengths_nm[i - 1]) {
      return Refused("bad_spectrum", found.where,
                     "wavelengths must increase, but " + ShortestText(wavelength) + " nm follows " +
                         ShortestText(spectrum.wavelengths_nm[i - 1]) + " nm");
    }
  }
  return {};
}

Reading ReadingOf(const FoundSpectrum& found, const std::optional<Xyz>& xyz) {
  const ReportedColor& reported = found.imported.reported;
  Reading reading;
  if (reported.illuminance_lx) {
    reading.illuminance = Lux(*reported.illuminance_lx);
  } else if (xyz && found.imported.spectrum.quantity == SpectralQuantity::kIrradiance) {
    reading.illuminance = Lux(xyz->Y);
  }
  if (reported.cct_K) reading.cct = Kelvin(*reported.cct_K);
  reading.duv = reported.duv;
  reading.xy = reported.xy;
  if (!reading.xy && xyz) reading.xy = XyFromXyz(*xyz);
  reading.time = found.time;
  reading.device = found.device;
  reading.color_source = ColorSource::kSpectrometer;
  return reading;
}

// Absent for a dark spectrum, which has no colour.
Result<std::optional<Xyz>> Tristimulus(const FoundSpectrum& found) {
  if (IsDark(found.imported.spectrum)) return std::nullopt;
  auto xyz = XyzFromSpectrum(found.imported.spectrum);
  if (!xyz) return Refused(xyz.error().code, found.where, xyz.error().message);
  return *xyz;
}

}  // namespace

std::optional<Warning> IlluminanceDisagreement(const FoundSpectrum& found, double spectrum_lx) {
  const ReportedColor& reported = found.imported.reported;
  const bool absolute = found.imported.spectrum.quantity == SpectralQuantity::kIrradiance;
  if (!absolute || !reported.illuminance_lx) return std::nullopt;
  const double header_lx = *reported.illuminance_lx;
  const double tolerance =
      std::max(kTolerance * std::abs(header_lx), 0.5 * reported.illuminance_last_digit_lx);
  if (std::abs(spectrum_lx - header_lx) <= tolerance) return std::nullopt;

  std::string message = "its spectrum adds up to " + RoundedText(spectrum_lx, 5) +
                        " lx, its header says " + RoundedText(header_lx, 5) + " lx; ";
  const double lx_per_file_unit = spectrum_lx / found.file_unit_W_m2_nm;
  const auto fitting = std::ranges::find_if(kUnits, [&](const IrradianceUnit& unit) {
    return std::abs(lx_per_file_unit * unit.W_m2_nm - header_lx) <= tolerance;
  });
  if (fitting == kUnits.end()) {
    message += "no unit of irradiance makes it fit, so one of the two is wrong";
  } else {
    message += "it would fit if the values were " + std::string(fitting->name);
  }
  return Warning{"spectrum_disagrees", found.where, message};
}

Result<ImportedFile> ImportedFromSpectra(std::string_view format,
                                         std::vector<FoundSpectrum> found) {
  ImportedFile file;
  file.format = format;
  bool all_dark = true;
  for (FoundSpectrum& one : found) {
    if (auto samples = CheckSamples(one); !samples) return Propagate(std::move(samples));
    const auto xyz = Tristimulus(one);
    if (!xyz) return tl::unexpected(xyz.error());
    if (*xyz) {
      all_dark = false;
      if (auto warning = IlluminanceDisagreement(one, (*xyz)->Y)) {
        file.warnings.push_back(std::move(*warning));
      }
    } else {
      file.warnings.push_back({"dark_spectrum", one.where, "no sample is above 0, so no colour"});
    }
    file.readings.push_back(ReadingOf(one, *xyz));
    file.spectra.push_back(std::move(one.imported));
  }
  if (all_dark) {
    return Refused("bad_spectrum", found.empty() ? std::string(format) : found.front().where,
                   found.empty() ? "holds no spectrum" : "no sample is above 0: nothing but dark");
  }
  return file;
}

}  // namespace lightcal::files
