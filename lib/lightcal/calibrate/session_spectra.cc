// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/session_spectra.h"

#include <optional>
#include <string>
#include <utility>

#include "lightcal/calibrate/session_files.h"
#include "lightcal/calibrate/spectral_doubt.h"
#include "lightcal/calibrate/spectrum_agreement.h"
#include "lightcal/colorimetry/resample.h"
#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/fit/states/emitters.h"
#include "lightcal/records/session_reader.h"

namespace lightcal {
namespace {

// The spectrum at a wider step, where it has a finer one.
Spectrum ThinnedTo(const Spectrum& spectrum, double step_nm) {
  if (!(step_nm > 0.0) || spectrum.wavelengths_nm.size() < 2) return spectrum;
  const std::vector<double> edges = BinEdgesNm(spectrum);
  const int count = static_cast<int>((edges.back() - edges.front()) / step_nm * (1.0 + 1e-12));
  if (static_cast<std::size_t>(count) >= spectrum.wavelengths_nm.size()) return spectrum;
  auto wider = ResampleByArea(spectrum, Nanometres(edges.front() + 0.5 * step_nm),
                              Nanometres(step_nm), count);
  return wider ? *std::move(wider) : spectrum;
}

// A table that a meter's own driver wrote holds means over its steps as the meter's own file does.
SpectralDoubt DoubtOfFile(const OneSpectrum& one, const Reading& reading, Evidence& evidence) {
  const Spectrum& spectrum = one.imported.spectrum;
  const bool by_driver = one.format == "csv" && !reading.device.empty();
  const auto error =
      SpectralErrorOf(spectrum, by_driver ? Sampling::kBandAverage : SamplingOfFormat(one.format));
  if (!error) return {};
  const auto warn = [&](const std::optional<Warning>& warning) {
    if (warning) evidence.AddWarnings({*warning});
  };
  warn(WarningOfRange(spectrum, reading.spectrum_file));
  warn(WarningOfClip(spectrum, reading.spectrum_file));
  warn(WarningOfSampling(
      spectrum, *error, reading.spectrum_file,
      "the interval holds what is usual of lamps with lines; give a table of 1 nm, "
      "or the file that the instrument's program wrote"));
  return DoubtOf(spectrum, *error);
}

}  // namespace

Result<Reading> WithSpectrum(const Session& session, const SessionReading& row, double step_nm,
                             const Sources& sources, Evidence& evidence,
                             std::vector<ReadSpectrum>& read) {
  Reading reading = row.reading;
  if (reading.spectrum_file.empty()) return reading;
  const std::string path = PathInSession(session, reading.spectrum_file);
  const auto one = ReadTheOneSpectrum(sources, path, row.where);
  if (!one) return tl::unexpected(one.error());
  evidence.AddWarnings(one->warnings);
  const Spectrum spectrum = ThinnedTo(one->imported.spectrum, step_nm);
  const auto xyz = XyzFromSpectrum(spectrum);
  if (!xyz) return tl::unexpected(xyz.error());
  WarnOfDisagreement(session, row, one->imported, *xyz, evidence.warnings);
  reading.xy = XyFromXyz(*xyz);
  if (reading.color_source == ColorSource::kUnknown) {
    reading.color_source = ColorSource::kSpectrometer;
  }
  const bool absolute = spectrum.quantity == SpectralQuantity::kIrradiance;
  if (!reading.illuminance && absolute) {
    if (const Warning* const doubt = IlluminanceDoubt(one->warnings)) {
      return Refused("illuminance_ambiguous", path,
                     doubt->message + ": write illuminance_lx beside it, or mend the file");
    }
    reading.illuminance = Lux(xyz->Y);
  }
  evidence.AddFile(path);
  read.push_back({row, one->imported.spectrum, DoubtOfFile(*one, row.reading, evidence)});
  read.back().row.reading = reading;
  return reading;
}

void AddSpectraOfCaptures(const Session& session, const Sources& sources, Evidence& evidence) {
  for (const CaptureDescription& capture : session.captures) {
    if (capture.spectrum_file.empty()) continue;
    const std::string& file = capture.spectrum_file;
    const auto one = ReadTheOneSpectrum(sources, PathInSession(session, file), file);
    if (one) evidence.AddSpectrum(capture.light, file, one->imported.spectrum);
  }
}

void TakeSpectra(const std::vector<NamedSpectrum>& spectra, FittedLight& light) {
  constexpr double kKept_nm = 5.0;
  const auto thinned = [](const Spectrum& whole) { return ThinnedTo(whole, kKept_nm); };
  for (const NamedSpectrum& one : spectra) {
    if (one.light != light.name) continue;
    if (SameState(one.state, light.state) && !light.spectrum) {
      light.spectrum = thinned(one.spectrum);
      WidenBy(one.doubt, light.color);
    }
    for (MeasuredState& state : light.states) {
      if (state.spectrum || !SameState(one.state, state.state)) continue;
      WidenBy(one.doubt, state.color);
      state.spectrum = thinned(one.spectrum);
    }
  }
  fit::FindEmitters(light);
}

}  // namespace lightcal
