// SPDX-License-Identifier: Apache-2.0
#include "color_metrics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>

#include "lightcal/colorimetry/illuminants.h"
#include "lightcal/colorimetry/rendering_input.h"
#include "lightcal/colorimetry/ssi.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal::app {
namespace {

using Json = nlohmann::ordered_json;

std::optional<double> SimilarityTo(const Spectrum& light, const Result<Spectrum>& reference) {
  if (!reference) return std::nullopt;
  const auto similarity = SpectralSimilarity(light, *reference);
  return similarity ? std::optional<double>(*similarity) : std::nullopt;
}

RenderingMetrics RenderingOf(const RenderingInput& input) {
  RenderingMetrics metrics;
  metrics.cri = ColorRenderingOf(input);
  metrics.fidelity = ColorFidelityOf(input);
  metrics.gamut = GamutAndBinsOf(metrics.fidelity);
  const ColorFidelity former = ColorFidelityOf(input, kTm30Of2015);
  metrics.rf_2015 = former.Rf;
  metrics.rg_2015 = GamutAndBinsOf(former).Rg;
  return metrics;
}

Json BinJson(const HueBin& bin) {
  Json json = {{"samples", bin.samples}};
  if (bin.samples == 0) return json;
  json["rf"] = bin.Rf;
  json["rcs"] = bin.chroma_shift;
  json["rhs_rad"] = bin.hue_shift_rad;
  json["test_ab"] = {bin.test_a, bin.test_b};
  json["reference_ab"] = {bin.reference_a, bin.reference_b};
  return json;
}

Json Tm30Json(const RenderingMetrics& metrics) {
  Json json;
  json["rf"] = metrics.fidelity.Rf;
  json["rg"] = metrics.gamut.Rg;
  json["bins"] = Json::array();
  for (const HueBin& bin : metrics.gamut.bins) json["bins"].push_back(BinJson(bin));
  return json;
}

// One decimal, as meters print them; 0 never as "-0.0".
std::string OneDecimal(double value) {
  const double rounded = std::round(10.0 * value) / 10.0;
  std::string text = ShortestText(rounded == 0.0 ? 0.0 : rounded);
  if (text.find('.') == std::string::npos) text += ".0";
  return text;
}
std::string OneDecimal(const std::optional<double>& value) {
  return value ? OneDecimal(*value) : std::string();
}

std::string OneDecimals(std::span<const double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : "  ") + OneDecimal(value);
  return text;
}
std::string OneDecimals(std::span<const std::optional<double>> values) {
  std::string text;
  for (const auto& value : values) {
    if (value) text += (text.empty() ? "" : "  ") + OneDecimal(*value);
  }
  return text;
}

std::string RaText(const ColorRendering& cri) {
  const std::string text = OneDecimal(cri.Ra);
  if (cri.chromaticity_difference <= kLargestCriChromaticityDifference) return text;
  return text + " (" + RoundedText(cri.chromaticity_difference, 2) +
         " uv from white; CIE 13.3 ends at 0.0054)";
}

std::string SimilarityText(const ColorMetrics& metrics) {
  std::string text;
  const auto add = [&](const char* reference, const std::optional<double>& value) {
    if (!value) return;
    const std::string similarity = ShortestText(std::round(*value));
    text += (text.empty() ? "" : "  ") + std::string(reference) + " " + similarity;
  };
  add("P3200", metrics.ssi_P3200);
  add("D55", metrics.ssi_D55);
  add("own CCT", metrics.ssi_matching);
  return text;
}

}  // namespace

ColorMetrics ColorMetricsOf(const Spectrum& spectrum, const std::string& subject,
                            Warnings& warnings) {
  ColorMetrics metrics;
  const auto input = PrepareRendering(spectrum);
  if (!input && input.error().code != "no_reference") {
    warnings.push_back({input.error().code, subject, input.error().message});
    return metrics;
  }
  metrics.ssi_P3200 = SimilarityTo(spectrum, IlluminantSpectrum("P3200"));
  metrics.ssi_D55 = SimilarityTo(spectrum, IlluminantSpectrum("D55"));
  if (!input) return metrics;
  metrics.ssi_matching = SimilarityTo(spectrum, SimilarityReference(input->color.temperature));
  metrics.rendering = RenderingOf(*input);
  return metrics;
}

void AddMetrics(Json& json, const ColorMetrics& metrics) {
  if (const auto& rendering = metrics.rendering) {
    json["cri"] = {{"Ra", rendering->cri.Ra},
                   {"R", rendering->cri.R},
                   {"reference_distance_uv", rendering->cri.chromaticity_difference}};
    json["cie2017_rf"] = rendering->fidelity.Rf;
    json["tm30"] = Tm30Json(*rendering);
    json["tm30_2015"] = {{"rf", rendering->rf_2015}, {"rg", rendering->rg_2015}};
  }
  Json ssi = Json::object();
  if (metrics.ssi_P3200) ssi["P3200"] = *metrics.ssi_P3200;
  if (metrics.ssi_D55) ssi["D55"] = *metrics.ssi_D55;
  if (metrics.ssi_matching) ssi["matching"] = *metrics.ssi_matching;
  if (!ssi.empty()) json["ssi"] = std::move(ssi);
}

void AddReportedMetrics(Json& json, const ReportedColor& reported) {
  if (reported.cri_Ra) json["cri_Ra"] = *reported.cri_Ra;
  Json indices = Json::object();
  for (std::size_t i = 0; i < reported.cri_R.size(); ++i) {
    if (reported.cri_R[i]) indices["R" + std::to_string(i + 1)] = *reported.cri_R[i];
  }
  if (!indices.empty()) json["cri_R"] = std::move(indices);
  if (reported.tm30_rf) json["tm30_rf"] = *reported.tm30_rf;
  if (reported.tm30_rg) json["tm30_rg"] = *reported.tm30_rg;
}

std::vector<MetricRow> MetricRows(const ColorMetrics& metrics, const ReportedColor& reported) {
  std::vector<MetricRow> rows;
  if (const auto& rendering = metrics.rendering) {
    const std::span<const double> r(rendering->cri.R);
    const std::span<const std::optional<double>> claimed(reported.cri_R);
    rows.push_back({"CRI Ra", RaText(rendering->cri), OneDecimal(reported.cri_Ra)});
    rows.push_back({"R1 to R8", OneDecimals(r.first(8)), OneDecimals(claimed.first(8))});
    rows.push_back({"R9 to R15", OneDecimals(r.subspan(8)), OneDecimals(claimed.subspan(8))});
    rows.push_back(
        {"CIE 224, TM-30 Rf", OneDecimal(rendering->fidelity.Rf), OneDecimal(reported.tm30_rf)});
    rows.push_back({"TM-30 Rg", OneDecimal(rendering->gamut.Rg), OneDecimal(reported.tm30_rg)});
    if (reported.tm30_rf) {
      const double edition_2015[] = {rendering->rf_2015, rendering->rg_2015};
      rows.push_back({"Rf, Rg by TM-30-15", OneDecimals(edition_2015), ""});
    }
  }
  if (const std::string text = SimilarityText(metrics); !text.empty()) {
    rows.push_back({"SSI to", text, ""});
  }
  return rows;
}

}  // namespace lightcal::app
