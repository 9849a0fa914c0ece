// SPDX-License-Identifier: Apache-2.0
#include "color_metrics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "lightcal/colorimetry/illuminants.h"
#include "lightcal/colorimetry/rendering_input.h"
#include "lightcal/colorimetry/ssi.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal::app {
namespace {

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

Node BinNode(const HueBin& bin) {
  if (bin.samples == 0) return {{"samples", 0}};
  return {{"samples", bin.samples},
          {"rf", bin.Rf},
          {"rcs", bin.chroma_shift},
          {"rhs_rad", bin.hue_shift_rad},
          {"test_ab", {bin.test_a, bin.test_b}},
          {"reference_ab", {bin.reference_a, bin.reference_b}}};
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

Node MetricsNode(const ColorMetrics& metrics) {
  Node node = Node::Table();
  if (const auto& rendering = metrics.rendering) {
    node.Put({{"cri",
               {{"Ra", rendering->cri.Ra},
                {"R", rendering->cri.R},
                {"reference_distance_uv", rendering->cri.chromaticity_difference}}},
              {"cie2017_rf", rendering->fidelity.Rf},
              {"tm30",
               {{"rf", rendering->fidelity.Rf},
                {"rg", rendering->gamut.Rg},
                {"bins", Node::List(rendering->gamut.bins, BinNode)}}},
              {"tm30_2015", {{"rf", rendering->rf_2015}, {"rg", rendering->rg_2015}}}});
  }
  node.Put("ssi", Node::UnlessEmpty({{"P3200", metrics.ssi_P3200},
                                     {"D55", metrics.ssi_D55},
                                     {"matching", metrics.ssi_matching}}));
  return node;
}

Node ReportedMetricsNode(const ReportedColor& reported) {
  Node indices = Node::Table();
  for (std::size_t i = 0; i < reported.cri_R.size(); ++i) {
    indices.Put("R" + std::to_string(i + 1), reported.cri_R[i]);
  }
  return {{"cri_Ra", reported.cri_Ra},
          {"cri_R", Node::UnlessEmpty(indices)},
          {"tm30_rf", reported.tm30_rf},
          {"tm30_rg", reported.tm30_rg}};
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
