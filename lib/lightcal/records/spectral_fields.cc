// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/spectral_fields.h"

#include <array>
#include <string_view>

#include "lightcal/records/field_reader.h"
#include "lightcal/records/field_writer.h"

namespace lightcal::records {
namespace {

constexpr std::array<std::string_view, 2> kSpectralQuantityWords = {"irradiance", "relative"};

constexpr auto kVisitSpectrum = [](auto& archive, auto& spectrum) {
  archive.Word("quantity", spectrum.quantity, kSpectralQuantityWords);
  archive.Numbers("wavelengths_nm", spectrum.wavelengths_nm, kPositive);
  archive.Numbers("values", spectrum.values, kAnyNumber);
  archive.Require({"quantity", "wavelengths_nm", "values"});
};

constexpr auto kVisitEmitter = [](auto& archive, auto& one) {
  archive.Numbers("values", one.values, kNotNegative);
  archive.Chromaticity("xy", one.xy);
  archive.Controls("purest", one.purest);
  archive.Number("purest_share", one.purest_share, kNotNegative);
  archive.Require({"values", "purest", "purest_share"});
};

constexpr auto kVisitEmitters = [](auto& archive, auto& emitters) {
  archive.Numbers("wavelengths_nm", emitters.wavelengths_nm, kPositive);
  archive.List("found", emitters.found, kVisitEmitter);
  archive.Integer("spectra", emitters.spectra);
  archive.Number("residual", emitters.residual, kNotNegative);
  archive.Require({"wavelengths_nm", "found", "spectra", "residual"});
};

}  // namespace

void VisitSpectrumOf(FieldReader& reader, std::optional<Spectrum>& spectrum) {
  reader.Object("spectrum", spectrum, kVisitSpectrum);
  if (!spectrum || reader.Failed()) return;
  if (const auto xyz = XyzFromSpectrum(*spectrum); !xyz) {
    reader.Fail("spectrum", "spectrum: " + xyz.error().message);
  }
}
void VisitSpectrumOf(FieldWriter& writer, const std::optional<Spectrum>& spectrum) {
  writer.Object("spectrum", spectrum, kVisitSpectrum);
}

void VisitEmittersOf(FieldReader& reader, FittedLight& light) {
  reader.Object("emitters", light.emitters, kVisitEmitters);
  if (reader.Failed()) return;
  const std::size_t count = light.emitters ? light.emitters->found.size() : 0;
  if (light.emitters && count == 0) reader.Fail("emitters", "emitters: holds none");
  for (std::size_t k = 0; k < count; ++k) {
    const auto xyz =
        XyzFromSpectrum({light.emitters->wavelengths_nm, light.emitters->found[k].values, {}});
    if (!xyz) reader.Fail("emitters", "emitters: " + xyz.error().message);
  }
  for (const MeasuredState& state : light.states) {
    if (!state.emitter_amounts.empty() && state.emitter_amounts.size() != count) {
      reader.Fail("states", "states: one of emitter_amounts for each of the light's emitters");
    }
  }
}
void VisitEmittersOf(FieldWriter& writer, const FittedLight& light) {
  writer.Object("emitters", light.emitters, kVisitEmitters);
}

void VisitAmounts(FieldReader& reader, std::vector<double>& amounts) {
  reader.Numbers("emitter_amounts", amounts, kNotNegative);
}
void VisitAmounts(FieldWriter& writer, const std::vector<double>& amounts) {
  if (!amounts.empty()) writer.Numbers("emitter_amounts", amounts, kNotNegative);
}

}  // namespace lightcal::records
