// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/spectrum_readings.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/irradiance_units.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal::devices::files {
namespace {

constexpr double kTolerance = 0.01;
constexpr double kCctTolerance = 0.01;
constexpr double kDuvTolerance = 0.001;
constexpr double kXyTolerance = 0.003;

bool IsDark(const Spectrum& spectrum) {
  return std::ranges::none_of(spectrum.values, [](double value) { return value > 0.0; });
}

// A file may list its samples from red to blue.
void ReverseFalling(Spectrum& spectrum) {
  const auto& nm = spectrum.wavelengths_nm;
  const bool falls = nm.size() > 1 && nm.size() == spectrum.values.size() &&
                     std::ranges::adjacent_find(nm, std::less_equal<>()) == nm.end();
  if (!falls) return;
  std::ranges::reverse(spectrum.wavelengths_nm);
  std::ranges::reverse(spectrum.values);
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
    if (wavelength <= 0.0) {
      return Refused("bad_spectrum", found.where,
                     "a wavelength of " + ShortestText(wavelength) + " nm is none");
    }
    if (i > 0 && wavelength <= spectrum.wavelengths_nm[i - 1]) {
      if (wavelength == spectrum.wavelengths_nm[i - 1]) {
        return Refused("bad_spectrum", found.where,
                       "has two values at " + ShortestText(wavelength) + " nm; keep one");
      }
      return Refused("bad_spectrum", found.where,
                     "wavelengths must increase, but " + ShortestText(wavelength) + " nm follows " +
                         ShortestText(spectrum.wavelengths_nm[i - 1]) +
                         " nm; correct it, or put it where it belongs");
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
  const double relative = header_lx > 0.0 ? tolerance / header_lx : kTolerance;
  const std::string fitting(
      IrradianceUnitOf(found.imported.file_unit_W_m2_nm * header_lx / spectrum_lx, relative));
  message += fitting.empty() ? "no unit of irradiance makes it fit, so one of the two is wrong"
                             : "it would fit if the values were " + fitting;
  return Warning{"spectrum_disagrees", found.where, message};
}

std::optional<Warning> HeaderContradiction(const FoundSpectrum& found) {
  const ReportedColor& reported = found.imported.reported;
  if (!reported.cct_K || !reported.xy) return std::nullopt;
  const CctResult cct = CctFromXy(*reported.xy);
  const bool same_cct = std::abs(cct.temperature.value() - *reported.cct_K) <=
                        kCctTolerance * *reported.cct_K + 0.5 * reported.cct_last_digit_K;
  const bool same_duv = !reported.duv || std::abs(cct.duv - *reported.duv) <=
                                             kDuvTolerance + 0.5 * reported.duv_last_digit;
  if (same_cct && same_duv) return std::nullopt;
  const std::string claim = ShortestText(*reported.cct_K) + " K" +
                            (reported.duv ? " and Duv " + ShortestText(*reported.duv) : "");
  const std::string truth =
      cct.valid()
          ? RoundedText(cct.temperature.value(), 4) + " K and Duv " + RoundedText(cct.duv, 2)
          : "no colour temperature (Duv " + RoundedText(cct.duv, 2) + ")";
  return Warning{
      "color_disagrees", found.where,
      "its header says " + claim + ", but the header's own x, y have " + truth + "; x, y are used"};
}

std::optional<Warning> ColorDisagreement(const FoundSpectrum& found, Xy spectrum_xy) {
  const auto& header = found.imported.reported.xy;
  if (!header) return std::nullopt;
  if (std::hypot(header->x - spectrum_xy.x, header->y - spectrum_xy.y) <= kXyTolerance) {
    return std::nullopt;
  }
  return Warning{"color_disagrees", found.where,
                 "its spectrum has x, y = " + RoundedText(spectrum_xy.x, 4) + ", " +
                     RoundedText(spectrum_xy.y, 4) + ", its header says " +
                     RoundedText(header->x, 4) + ", " + RoundedText(header->y, 4) +
                     ", so one of the two is damaged"};
}

namespace {

void CheckAgainstHeader(const FoundSpectrum& found, const Xyz& xyz, Reading& reading,
                        Warnings& warnings) {
  const auto warn = [&](std::optional<Warning> warning) {
    if (warning) warnings.push_back(std::move(*warning));
  };
  warn(IlluminanceDisagreement(found, xyz.Y));
  warn(ColorDisagreement(found, XyFromXyz(xyz)));
  auto contradiction = HeaderContradiction(found);
  if (contradiction) {
    reading.cct.reset();
    reading.duv.reset();
  }
  warn(std::move(contradiction));
}

}  // namespace

Result<ImportedFile> ImportedFromSpectra(std::string_view format, std::vector<FoundSpectrum> found,
                                         Warnings warnings) {
  ImportedFile file;
  file.format = format;
  file.warnings = std::move(warnings);
  bool all_dark = true;
  for (FoundSpectrum& one : found) {
    ReverseFalling(one.imported.spectrum);
    if (auto samples = CheckSamples(one); !samples) return Propagate(std::move(samples));
    const auto tristimulus = Tristimulus(one);
    if (!tristimulus) return tl::unexpected(tristimulus.error());
    const std::optional<Xyz>& xyz = *tristimulus;
    file.readings.push_back(ReadingOf(one, xyz));
    if (xyz) {
      all_dark = false;
      CheckAgainstHeader(one, *xyz, file.readings.back(), file.warnings);
    } else {
      file.warnings.push_back({"dark_spectrum", one.where, "no sample is above 0, so no colour"});
    }
    one.imported.where = one.where;
    file.spectra.push_back(std::move(one.imported));
  }
  if (all_dark) {
    return Refused("bad_spectrum", found.empty() ? std::string(format) : found.front().where,
                   found.empty() ? "holds no spectrum" : "no sample is above 0: nothing but dark");
  }
  return file;
}

}  // namespace lightcal::devices::files
