// SPDX-License-Identifier: Apache-2.0
// What `lightcal color --spectrum` says about how a light renders colours.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "console.h"
#include "lightcal/colorimetry/color_fidelity.h"
#include "lightcal/colorimetry/cri.h"
#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/result.h"
#include "lightcal_devices/files/import_file.h"

namespace lightcal::app {

struct RenderingMetrics {
  ColorRendering cri;
  ColorFidelity fidelity;
  GamutAndBins gamut;
  double rf_2015 = 0.0, rg_2015 = 0.0;  // TM-30-15, as meters of its time show them
};

// Absent where the light has no reference (no CCT): colour rendering and ssi_matching. All absent
// where the spectrum is too narrow or too coarse.
struct ColorMetrics {
  std::optional<RenderingMetrics> rendering;
  std::optional<double> ssi_P3200, ssi_D55, ssi_matching;
};

// Adds a warning (truncated_spectrum, coarse_spectrum) where the spectrum cannot be judged.
[[nodiscard]] ColorMetrics ColorMetricsOf(const Spectrum& spectrum, const std::string& subject,
                                          Warnings& warnings);

// "cri", "cie2017_rf", "tm30", "tm30_2015" and "ssi".
[[nodiscard]] Node MetricsNode(const ColorMetrics& metrics);
// What the file's header claims of them.
[[nodiscard]] Node ReportedMetricsNode(const ReportedColor& reported);

// Rows for the table of one colour: what, value, what the file says.
struct MetricRow {
  std::string what, value, claim;
};
[[nodiscard]] std::vector<MetricRow> MetricRows(const ColorMetrics& metrics,
                                                const ReportedColor& reported);

}  // namespace lightcal::app
