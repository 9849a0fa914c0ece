// SPDX-License-Identifier: Apache-2.0
#include "report_html.h"

#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/punctual_light.h"
#include "lightcal/report/page.h"

namespace lightcal::app {
namespace {

constexpr int kDigits = 5;

std::string ColorText(const Rgb& c) {
  return RoundedText(c.r, 4) + ", " + RoundedText(c.g, 4) + ", " + RoundedText(c.b, 4);
}

void AddFigures(const PunctualLight& light, std::vector<EngineFigure>& figures) {
  const std::string unit = light.type == PunctualType::kDirectional ? "lx" : "cd";
  const std::string as = light.substitution.empty() ? "" : "; " + light.substitution;
  figures.push_back({light.name, "White light", "intensity",
                     RoundedText(light.photometric, kDigits) + " " + unit,
                     "with the engine's colour left white" + as});
  if (!light.color.xy) return;
  figures.push_back({light.name, "Coloured light, as in glTF", "intensity",
                     RoundedText(light.intensity, kDigits) + " " + unit,
                     "with linear Rec. 709 colour " + ColorText(light.color.max_normalised) + as});
}

}  // namespace

std::string ReportHtml(const LightFile& lights, std::string_view title) {
  std::vector<EngineFigure> figures;
  for (const FittedLight& light : lights.lights) {
    LightFile one;
    one.lights = {light};
    Warnings shown_by_export;
    const auto punctual = PunctualLightsFrom(one, shown_by_export);
    if (punctual) AddFigures(punctual->front(), figures);
  }
  return ReportPage(lights, title, figures);
}

}  // namespace lightcal::app
