// SPDX-License-Identifier: Apache-2.0
// What `lightcal color` says about a colour, as JSON and as a table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "color_extras.h"
#include "color_metrics.h"
#include "color_tlci.h"
#include "console.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/units.h"
#include "lightcal_devices/files/import_file.h"

namespace lightcal::app {

// Everything said about one colour.
struct ColorAnswer {
  Xy xy;
  CctResult cct;
  std::string name;                // of a spectrum
  std::optional<Xyz> xyz;          // of a spectrum: Y in lx for an irradiance, else 100
  std::optional<Lux> illuminance;  // of an irradiance
  std::optional<LumensPerWatt> efficacy;
  std::optional<double> melanopic_der;  // of a spectrum
  std::optional<Tlci> tlci;
  std::optional<ReportedColor> reported;
  ColorMetrics metrics;  // of a spectrum
  ColorExtras extras;
  ColorFindings findings;
  [[nodiscard]] bool has_cct() const { return cct.valid() && !findings.too_noisy(); }
};

[[nodiscard]] Node ToJson(const ColorAnswer& answer);
// Every quantity of one colour, a row each.
[[nodiscard]] std::string TableOfOne(const ColorAnswer& answer);
// One row for each spectrum.
[[nodiscard]] std::string TableOfMany(const std::vector<ColorAnswer>& answers);

}  // namespace lightcal::app
