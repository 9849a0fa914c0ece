// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/plots.h"

#include <algorithm>
#include <array>
#include <utility>

#include "lightcal/report/chromaticity_plot.h"
#include "lightcal/report/color_vector_graphic.h"
#include "lightcal/report/control_figure.h"
#include "lightcal/report/figures.h"
#include "lightcal/report/gate_figure.h"
#include "lightcal/report/luminance_figure.h"
#include "lightcal/report/minutes_figure.h"
#include "lightcal/report/readings.h"
#include "lightcal/report/spectrum_figure.h"
#include "lightcal/report/style.h"
#include "lightcal/report/text.h"

namespace lightcal::report {
namespace {

constexpr std::string_view kGate = "gate";
constexpr std::string_view kMatch = "match";  // a sheet with rules of its own

// The first that belongs to the light; null where none does.
template <class Item>
const Item* FirstOf(const std::vector<Item>& items, const FittedLight& light) {
  const auto found = std::ranges::find(items, light.name, &Item::light);
  return found == items.end() ? nullptr : &*found;
}

void AddRejected(const FittedLight& light, PlotCaption& caption) {
  const bool rejected =
      std::ranges::any_of(light.residuals, [](const ResidualRow& row) { return !row.used; });
  if (rejected) caption.keys.push_back(CrossKey("left out"));
}

PlotCaption ResidualKeys(const FittedLight& light, const ReportExtras& /*extras*/) {
  PlotCaption caption{{ReadingKey("reading with its 95 %"), LineKey("zero", "the fitted lamp")},
                      ""};
  AddRejected(light, caption);
  return caption;
}

PlotCaption DistanceKeys(const FittedLight& light, const ReportExtras& /*extras*/) {
  PlotCaption caption{
      {ReadingKey(HoldWalls(light.residuals) ? "reading less the walls' light, its 95 %"
                                             : "reading with its 95 %"),
       LineKey("model", "the fitted lamp")},
      ""};
  if (light.covariance_lnI_d0_E0) caption.keys.push_back(BandKey("band", "its 95 %"));
  AddRejected(light, caption);
  return caption;
}

PlotCaption ChromaticityKeys(const FittedLight& light, const ReportExtras& /*extras*/) {
  return ChromaticityCaption(light.color.cct_K.has_value());
}

std::string DrawSpectrum(const FittedLight& light, const ReportExtras& extras,
                         std::string_view id) {
  const LightSpectrum* spectrum = FirstOf(extras.spectra, light);
  return spectrum == nullptr ? "" : SpectrumFigure(*spectrum, id);
}

PlotCaption SpectrumCaption(const FittedLight& light, const ReportExtras& extras) {
  const LightSpectrum& spectrum = *FirstOf(extras.spectra, light);
  std::string text = "<code>" + Escaped(spectrum.file) + "</code>";
  if (spectrum.rendering) text += " · CRI Ra <b>" + Fixed(spectrum.rendering->Ra, 0) + "</b>";
  return {{}, text};
}

std::string DrawTm30(const FittedLight& light, const ReportExtras& extras, std::string_view id) {
  const LightSpectrum* spectrum = FirstOf(extras.spectra, light);
  if (spectrum == nullptr || !spectrum->rendering) return "";
  return ColorVectorFigure(spectrum->rendering->fidelity, spectrum->rendering->gamut, light.name,
                           id);
}

PlotCaption Tm30Keys(const FittedLight& /*light*/, const ReportExtras& /*extras*/) {
  return Tm30Caption();
}

PlotCaption PolarKeys(const FittedLight& /*light*/, const ReportExtras& /*extras*/) {
  return {{}, "candela by the angle from the aim, which points down"};
}

std::string DrawLuminance(const FittedLight& light, const ReportExtras& extras,
                          std::string_view id) {
  const LuminancePicture* picture = FirstOf(extras.pictures, light);
  return picture == nullptr ? "" : LuminanceFigure(*picture, id);
}

PlotCaption LuminanceCaption(const FittedLight& light, const ReportExtras& extras) {
  const LuminancePicture& picture = *FirstOf(extras.pictures, light);
  return {{},
          "the picture of the " + Escaped(picture.what) + " in false colours" +
              (picture.region ? ", framed what was measured" : "")};
}

std::string DrawMinutes(const FittedLight& light, const ReportExtras& extras, std::string_view id) {
  const MinutesLadder* ladder = FirstOf(extras.ladders, light);
  return ladder == nullptr ? "" : MinutesFigure({ladder, 1}, id);
}

PlotCaption MinutesKeys(const FittedLight& light, const ReportExtras& extras) {
  return MinutesCaption({FirstOf(extras.ladders, light), 1});
}

// The light's own control of that number, the dimmer first.
const ControlSweep* SweepOf(const ReportExtras& extras, const FittedLight& light,
                            std::size_t number) {
  for (const ControlSweep& sweep : extras.sweeps) {
    if (sweep.light == light.name && number-- == 0) return &sweep;
  }
  return nullptr;
}

template <std::size_t kNumber, std::string (*kDraw)(const ControlSweep&, std::string_view)>
std::string DrawControl(const FittedLight& light, const ReportExtras& extras, std::string_view id) {
  const ControlSweep* sweep = SweepOf(extras, light, kNumber);
  return sweep == nullptr ? "" : kDraw(*sweep, id);
}

template <std::size_t kNumber>
PlotCaption ControlKeys(const FittedLight& light, const ReportExtras& extras) {
  const std::string others = ControlCaption(*SweepOf(extras, light, kNumber));
  return {{ReadingKey("read, with its 95 %"), LineKey("model", "between"),
           BandKey("band", "its 95 %"), LineKey("guide", "the label's promise")},
          others.empty() ? "" : " · " + others};
}

template <std::string (*kDraw)(const FittedLight&, std::string_view)>
std::string OfLight(const FittedLight& light, const ReportExtras& /*extras*/, std::string_view id) {
  return kDraw(light, id);
}

PlotCaption RoomKeys(const FittedLight& light, const ReportExtras& /*extras*/) {
  PlotCaption caption{{ReadingKey("reading × distance², its 95 %"), LineKey("model", "your lamp"),
                       BandKey("band", "its 95 %")},
                      ""};
  if (!light.in_room.empty() && light.in_room.front().ln_b) {
    caption.keys.push_back(BandKey("wedge", "what the walls add"));
    const bool carded = std::ranges::any_of(
        light.residuals, [](const ResidualRow& row) { return row.used && !row.walls_lx; });
    if (carded) caption.keys.push_back(LineKey("guide", "what the card took away"));
  }
  AddRejected(light, caption);
  return caption;
}

constexpr std::array kLightPlots = {
    LightPlot{"room", "What the room adds", &OfLight<RoomFigure>, &RoomKeys},
    LightPlot{"distance", "Illuminance against distance", &OfLight<DistanceFigure>, &DistanceKeys},
    LightPlot{"residuals", "Distance from the model", &OfLight<ResidualFigure>, &ResidualKeys},
    LightPlot{"output", "Light by its control", &DrawControl<0, &OutputFigure>, &ControlKeys<0>},
    LightPlot{"cct", "Colour temperature by its control", &DrawControl<0, &TemperatureFigure>,
              &ControlKeys<0>},
    LightPlot{"output2", "Light by its second control", &DrawControl<1, &OutputFigure>,
              &ControlKeys<1>},
    LightPlot{"cct2", "Colour temperature by its second control",
              &DrawControl<1, &TemperatureFigure>, &ControlKeys<1>},
    LightPlot{"luminance", "Luminance", &DrawLuminance, &LuminanceCaption},
    LightPlot{"polar", "Intensity by direction", &OfLight<PolarFigure>, &PolarKeys},
    LightPlot{"chromaticity", "Chromaticity, CIE 1976 u′v′", &OfLight<ChromaticityFigure>,
              &ChromaticityKeys},
    LightPlot{"spectrum", "Spectrum", &DrawSpectrum, &SpectrumCaption},
    LightPlot{"tm30", "Colour rendering, TM-30", &DrawTm30, &Tm30Keys},
    LightPlot{"minutes", "What the next minutes of measuring buy", &DrawMinutes, &MinutesKeys},
};

}  // namespace

std::span<const LightPlot> LightPlots() { return kLightPlots; }

std::vector<std::string_view> PlotNames() {
  std::vector<std::string_view> names;
  for (const LightPlot& plot : kLightPlots) names.push_back(plot.name);
  names.push_back(kMatch);
  names.push_back(kGate);
  return names;
}

std::vector<PlotFile> PlotFilesOf(std::string_view name, const LightFile& file,
                                  const ReportExtras& extras) {
  std::vector<PlotFile> files;
  if (name == kGate && HasEffects(file.lights)) {
    files.push_back({"", GatePlot(file.lights, kUsualTolerance)});
  }
  if (name == kMatch) {
    for (const LightMatchSheet& one : extras.matches) {
      files.push_back({one.light, MatchSheetSvg(one.sheet)});
    }
  }
  const auto plot = std::ranges::find(kLightPlots, name, &LightPlot::name);
  if (plot == kLightPlots.end()) return files;
  for (const FittedLight& light : file.lights) {
    std::string svg = plot->draw(light, extras, name);
    if (svg.empty()) continue;
    svg = WithCaption(std::move(svg), plot->caption(light, extras));
    files.push_back({light.name, StandaloneSvg(std::move(svg))});
  }
  return files;
}

}  // namespace lightcal::report
