// SPDX-License-Identifier: Apache-2.0
#include "report_html.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "lightcal/calibrate/states/control_sweeps.h"
#include "lightcal/colorimetry/cri.h"
#include "lightcal/colorimetry/rendering_input.h"
#include "lightcal/presets/check/engine_answers.h"
#include "lightcal/report/page.h"
#include "raster_png.h"

namespace lightcal::app {
namespace {

constexpr int kReportScaleRows = 256;

std::optional<LightSpectrum::Rendering> RenderingOf(const Spectrum& spectrum) {
  const auto input = PrepareRendering(spectrum);
  if (!input) return std::nullopt;
  LightSpectrum::Rendering rendering;
  rendering.Ra = ColorRenderingOf(*input).Ra;
  rendering.fidelity = ColorFidelityOf(*input);
  rendering.gamut = GamutAndBinsOf(rendering.fidelity);
  return rendering;
}

LuminancePicture InFalseColors(const RecordedPicture& picture) {
  const View2d<const float> nits(picture.nits.data(), picture.width, picture.height);
  LuminancePicture out;
  out.light = picture.light;
  out.what = picture.use;
  out.width = picture.width;
  out.height = picture.height;
  out.scale = report::ScaleFor(nits);
  const std::vector<std::uint8_t> colors = report::FalseColors(nits, out.scale);
  out.image_uri = PngUri({colors.data(), picture.width, picture.height, 3});
  const std::vector<std::uint8_t> scale = report::ScaleColors(kReportScaleRows);
  out.scale_uri = PngUri({scale.data(), 1, kReportScaleRows, 3});
  out.region = picture.region;
  return out;
}

}  // namespace

ReportExtras ExtrasOf(const LightFile& lights,
                      const std::vector<std::shared_ptr<const EnvironmentPicture>>& environments) {
  ReportExtras extras;
  extras.engines = EngineAnswersOf(lights, environments);
  extras.sweeps = ControlSweepsOf(lights);
  return extras;
}

std::vector<LightSpectrum> SpectraOf(const CalibratedSession& calibrated) {
  std::vector<LightSpectrum> spectra;
  for (const NamedSpectrum& one : calibrated.spectra) {
    const bool known = std::ranges::any_of(
        spectra, [&](const LightSpectrum& known_one) { return known_one.light == one.light; });
    if (!known) spectra.push_back({one.light, one.file, one.spectrum, RenderingOf(one.spectrum)});
  }
  return spectra;
}

ReportExtras ExtrasOf(const CalibratedSession& calibrated, EngineAnswers answers,
                      std::vector<ControlSweep> sweeps) {
  ReportExtras extras;
  extras.engines = std::move(answers);
  extras.sweeps = std::move(sweeps);
  extras.spectra = SpectraOf(calibrated);
  for (const RecordedPicture& picture : calibrated.pictures) {
    extras.pictures.push_back(InFalseColors(picture));
  }
  return extras;
}

const std::string& TitleOf(const Session& session) {
  return session.name.empty() ? session.stem : session.name;
}

std::string ReportHtml(const LightFile& lights, std::string_view title) {
  return ReportPage(lights, title, ExtrasOf(lights));
}

std::string ReportHtml(const CalibratedSession& calibrated, EngineAnswers answers,
                       std::vector<ControlSweep> sweeps, const std::vector<std::string>& engines,
                       std::vector<LightAdvice> advice) {
  ReportExtras extras = ExtrasOf(calibrated, std::move(answers), std::move(sweeps));
  if (!engines.empty()) {
    std::erase_if(extras.engines.figures, [&](const EngineFigure& figure) {
      return std::ranges::find(engines, figure.engine) == engines.end();
    });
  }
  extras.advice = std::move(advice);
  return ReportPage(calibrated.lights, TitleOf(calibrated.session), extras);
}

}  // namespace lightcal::app
