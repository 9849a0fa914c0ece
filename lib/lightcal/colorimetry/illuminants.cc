// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/illuminants.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lightcal/colorimetry/cie_tables/illuminant_tables.h"
#include "lightcal/colorimetry/cie_tables/tables.h"
#include "lightcal/colorimetry/daylight.h"
#include "lightcal/colorimetry/planckian.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal {
namespace {

constexpr double kNanometresPerMetre = 1e9;
constexpr double kCentreNm = 560.0;
constexpr double kIlluminantAKelvin = 2848.0;
constexpr double kColdestPlanckKelvin = 400.0;

// 100 at 560 nm: (560/l)^4 g(c2/(l T)) / g(c2/(560 T)).
Spectrum PlanckSpectrum(double c2_over_t_nm) {
  Spectrum spectrum;
  const double centre = PlanckRatio(c2_over_t_nm / kCentreNm);
  for (int nm = kCmfFirstNm; nm <= kCmfLastNm; ++nm) {
    spectrum.wavelengths_nm.push_back(nm);
    spectrum.values.push_back(100.0 * std::pow(kCentreNm / nm, 4) * PlanckRatio(c2_over_t_nm / nm) /
                              centre);
  }
  return spectrum;
}

Spectrum IlluminantA() {
  return PlanckSpectrum(kC2OfIlluminantAMetreKelvin * kNanometresPerMetre / kIlluminantAKelvin);
}

Spectrum EqualEnergy() {
  Spectrum spectrum;
  for (int nm = kCmfFirstNm; nm <= kCmfLastNm; ++nm) spectrum.wavelengths_nm.push_back(nm);
  spectrum.values.assign(spectrum.wavelengths_nm.size(), 100.0);
  return spectrum;
}

Spectrum FromTable(const IlluminantTable& table) {
  Spectrum spectrum;
  spectrum.values.assign(table.values.begin(), table.values.end());
  for (int i = 0; i < static_cast<int>(table.values.size()); ++i) {
    spectrum.wavelengths_nm.push_back(table.first_nm + i * kIlluminantStepNm);
  }
  return spectrum;
}

bool AllDigits(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

// "d65" -> 6500 K, "d104" -> 10400 K.
std::optional<Kelvin> DaylightName(std::string_view name) {
  if (!name.starts_with('d') || !AllDigits(name.substr(1))) return std::nullopt;
  if (name.size() < 3 || name.size() > 4) return std::nullopt;
  return Kelvin(100.0 * *ParseNumber(name.substr(1)));
}

// "p3200" -> 3200 K.
std::optional<Kelvin> BlackBodyName(std::string_view name) {
  if (!name.starts_with('p') || !AllDigits(name.substr(1)) || name.size() > 8) return std::nullopt;
  return Kelvin(*ParseNumber(name.substr(1)));
}

// "f11" -> "fl11": the older name of the same lamp.
std::string FullName(std::string name) {
  if (name.starts_with('f') && !name.starts_with("fl")) name.insert(1, "l");
  return name;
}

}  // namespace

Result<Spectrum> BlackBodySpectrum(Kelvin temperature) {
  if (!(temperature.value() >= kColdestPlanckKelvin)) {
    return Refused("out_of_range", "black body",
                   "give a temperature of 400 K or more; colder bodies shine too little in the "
                   "visible range to be computed");
  }
  return PlanckSpectrum(kC2MetreKelvin * kNanometresPerMetre / temperature.value());
}

Result<Spectrum> IlluminantSpectrum(std::string_view name) {
  const std::string wanted = FullName(LowerAscii(TrimBlanks(name)));
  if (wanted == "a") return IlluminantA();
  if (wanted == "e") return EqualEnergy();
  if (const auto named = DaylightName(wanted)) {
    return DaylightSpectrum(DaylightTemperatureOfName(*named));
  }
  if (const auto temperature = BlackBodyName(wanted)) return BlackBodySpectrum(*temperature);
  for (const IlluminantTable& table : IlluminantTables()) {
    if (LowerAscii(table.name) == wanted) return FromTable(table);
  }
  return Refused("unknown_illuminant", std::string(name),
                 "is no illuminant of the CIE; known are " + Joined(IlluminantNames()) +
                     ", any daylight such as D56 and any black body such as P3200");
}

std::vector<std::string> IlluminantNames() {
  std::vector<std::string> names = {"A", "D50", "D55", "D65", "D75", "E"};
  for (const IlluminantTable& table : IlluminantTables()) names.emplace_back(table.name);
  return names;
}

}  // namespace lightcal
