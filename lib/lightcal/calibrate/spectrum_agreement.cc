// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/spectrum_agreement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/irradiance_units.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"

namespace lightcal {
namespace {

constexpr double kMostOffXy = 0.01;
constexpr double kSigmaSpectrometer = 0.05;  // of its illuminance

struct TypedUnit {
  std::string_view name;
  double lx;
};
constexpr std::array kTypedUnits = {TypedUnit{"footcandles", kLuxPerFootcandle},
                                    TypedUnit{"thousands of lx", 1000.0}};

void SayOnce(Warning warning, const std::string& remedy, Warnings& warnings) {
  const bool said = std::ranges::any_of(warnings, [&](const Warning& one) {
    return one.code == warning.code && one.subject == warning.subject &&
           one.message.ends_with(remedy);
  });
  if (said) return;
  warning.message += remedy;
  warnings.push_back(std::move(warning));
}

double MostOff(const Session& session, const Reading& reading) {
  const MeterDescription* const meter = FindMeter(session, reading.meter);
  const double sigma = reading.sigma_relative.value_or(meter != nullptr ? meter->sigma_relative
                                                                        : kSigmaUnnamedMeter);
  return 2.0 * std::hypot(sigma, kSigmaSpectrometer);
}

// What would make a reading of `read_lx` one of `spectrum_lx`.
std::string RemedyOf(double read_lx, double spectrum_lx, double most_off,
                     const ImportedSpectrum& imported) {
  const double needed = read_lx / spectrum_lx;
  const std::string_view unit =
      IrradianceUnitOf(imported.file_unit_W_m2_nm * needed, std::min(most_off, 0.05));
  const auto off = [&](const TypedUnit& typed) { return std::abs(std::log(typed.lx * needed)); };
  const TypedUnit& typed = *std::ranges::min_element(kTypedUnits, {}, off);
  if (off(typed) <= std::log1p(most_off)) {
    return "they would agree if the reading were in " + std::string(typed.name);
  }
  if (!unit.empty()) {
    return "they would agree if the spectrum's values were " + std::string(unit);
  }
  return "no unit makes them agree, so one of the two is wrong";
}

void CompareIlluminance(const Session& session, const SessionReading& row,
                        const ImportedSpectrum& imported, double spectrum_lx, Warnings& warnings) {
  const Reading& reading = row.reading;
  if (!reading.illuminance || reading.over_range || reading.under_range) return;
  if (imported.spectrum.quantity != SpectralQuantity::kIrradiance) return;
  const double read_lx = reading.illuminance->value() / reading.calibration_factor.value_or(1.0);
  if (!(read_lx > 0.0)) return;
  const auto& claimed_lx = imported.reported.illuminance_lx;
  if (claimed_lx && std::abs(*claimed_lx - read_lx) <= 1e-3 * read_lx) return;
  const double most_off = MostOff(session, reading);
  if (std::abs(std::log(read_lx / spectrum_lx)) <= std::log1p(most_off)) return;
  SayOnce({"spectrum_disagrees", reading.light,
           row.where + " says " + RoundedText(read_lx, 4) + " lx, its spectrum adds up to " +
               RoundedText(spectrum_lx, 4) + " lx; the reading's is taken; "},
          RemedyOf(read_lx, spectrum_lx, most_off, imported), warnings);
}

std::string TextOf(Xy xy) { return "x, y = " + RoundedText(xy.x, 4) + ", " + RoundedText(xy.y, 4); }

void CompareColor(const SessionReading& row, const ImportedSpectrum& imported, Xy spectrum,
                  Warnings& warnings) {
  const Reading& reading = row.reading;
  const ReportedColor& claimed = imported.reported;
  const auto compare = [&](Xy read, const std::string& says, const std::string& has) {
    if (std::hypot(read.x - spectrum.x, read.y - spectrum.y) <= kMostOffXy) return;
    SayOnce({"color_disagrees", reading.light,
             row.where + " says " + says + ", its spectrum has " + has + "; "},
            "the spectrum is taken, and one of the two is of another light or setting", warnings);
  };
  if (reading.xy && !claimed.xy) compare(*reading.xy, TextOf(*reading.xy), TextOf(spectrum));
  const CctResult cct = CctFromXy(spectrum);
  if (!reading.cct || !(reading.cct->value() > 0.0) || claimed.cct_K || !cct.valid()) return;
  const double duv = std::clamp(reading.duv.value_or(cct.duv), -0.1, 0.1);
  compare(XyFromCct(*reading.cct, duv), RoundedText(reading.cct->value(), 4) + " K",
          RoundedText(cct.temperature.value(), 4) + " K");
}

}  // namespace

void WarnOfDisagreement(const Session& session, const SessionReading& row,
                        const ImportedSpectrum& imported, const Xyz& spectrum, Warnings& warnings) {
  CompareIlluminance(session, row, imported, spectrum.Y, warnings);
  CompareColor(row, imported, XyFromXyz(spectrum), warnings);
}

}  // namespace lightcal
