// SPDX-License-Identifier: Apache-2.0
#include "report_html.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "lightcal/calibrate/session_files.h"
#include "lightcal/colorimetry/cri.h"
#include "lightcal/colorimetry/rendering_input.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/punctual_light.h"
#include "lightcal/report/page.h"
#include "lightcal_devices/disk_sources.h"
#include "raster_png.h"
#include "report/engines.h"
#include "report/parity.h"

namespace lightcal::app {
namespace {

constexpr int kDigits = 5;
constexpr int kScaleRows = 256;

// What any engine that takes candela or lux gets while its colour stays white.
void AddWhite(const FittedLight& lamp, std::vector<EngineFigure>& figures) {
  LightFile alone;
  alone.lights = {lamp};
  Warnings said_by_export;
  const auto punctual = PunctualLightsFrom(alone, said_by_export);
  if (!punctual) return;
  const PunctualLight& light = punctual->front();
  const std::string unit = light.type == PunctualType::kDirectional ? "lx" : "cd";
  figures.push_back({lamp.name, "Any engine", "colour left white",
                     RoundedText(light.photometric, kDigits), unit, light.substitution});
}

std::vector<EngineFigure> FiguresOf(const LightFile& lights,
                                    const std::vector<EngineExport>& exports) {
  std::vector<EngineFigure> figures;
  for (std::size_t i = 0; i < lights.lights.size(); ++i) {
    const FittedLight& lamp = lights.lights[i];
    AddWhite(lamp, figures);
    for (const EngineExport& exported : exports) {
      auto number = NumberOf(*exported.engine, exported.derived[i]);
      if (!number) continue;
      figures.push_back({lamp.name, std::string(exported.engine->title), std::move(number->field),
                         std::move(number->value), std::move(number->unit),
                         std::move(number->note)});
    }
  }
  return figures;
}

std::optional<LightSpectrum::Rendering> RenderingOf(const Spectrum& spectrum) {
  const auto input = PrepareRendering(spectrum);
  if (!input) return std::nullopt;
  LightSpectrum::Rendering rendering;
  rendering.Ra = ColorRenderingOf(*input).Ra;
  rendering.fidelity = ColorFidelityOf(*input);
  rendering.gamut = GamutAndBinsOf(rendering.fidelity);
  return rendering;
}

// The light's first; a file that cannot be read was reported where it counted.
void AddSpectrum(const Session& session, const std::string& light, const std::string& file,
                 std::vector<LightSpectrum>& spectra) {
  if (file.empty() || std::ranges::find(spectra, light, &LightSpectrum::light) != spectra.end()) {
    return;
  }
  auto one = ReadTheOneSpectrum(DiskSources(), PathInSession(session, file), file);
  if (!one) return;
  auto rendering = RenderingOf(one->imported.spectrum);
  spectra.push_back({light, file, std::move(one->imported.spectrum), std::move(rendering)});
}

std::vector<LightSpectrum> SpectraOf(const Session& session) {
  std::vector<LightSpectrum> spectra;
  for (const SessionReading& row : session.readings) {
    AddSpectrum(session, row.reading.light, row.reading.spectrum_file, spectra);
  }
  for (const CaptureDescription& capture : session.captures) {
    AddSpectrum(session, capture.light, capture.spectrum_file, spectra);
  }
  return spectra;
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
  const std::vector<std::uint8_t> scale = report::ScaleColors(kScaleRows);
  out.scale_uri = PngUri({scale.data(), 1, kScaleRows, 3});
  out.region = picture.region;
  return out;
}

}  // namespace

ReportExtras ExtrasOf(const LightFile& lights) {
  const std::vector<EngineExport> exports = ExportForReport(lights);
  ReportExtras extras;
  extras.figures = FiguresOf(lights, exports);
  extras.parity = ParityOf(lights, exports);
  return extras;
}

ReportExtras ExtrasOf(const CalibratedSession& calibrated, const PictureRecord& record) {
  ReportExtras extras = ExtrasOf(calibrated.lights);
  extras.spectra = SpectraOf(calibrated.session);
  for (const RecordedPicture& picture : record.pictures()) {
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

std::string ReportHtml(const CalibratedSession& calibrated, const PictureRecord& record) {
  return ReportPage(calibrated.lights, TitleOf(calibrated.session), ExtrasOf(calibrated, record));
}

}  // namespace lightcal::app
