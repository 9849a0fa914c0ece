// SPDX-License-Identifier: Apache-2.0
// lightcal color: a chromaticity, a colour temperature, a measured spectrum or a stream of
// chromaticities -> XYZ, xy, uv, CCT, Duv and linear RGB.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "color_asked.h"
#include "color_batch.h"
#include "color_extras.h"
#include "commands.h"
#include "lightcal/report/chromaticity_plot.h"
#include "lightcal/report/color_vector_graphic.h"
#include "match/behind_gels.h"
#include "output_files.h"
#include "picture_file.h"

namespace lightcal::app {
namespace {

std::string PlotOf(const ColorAnswer& answer) {
  FittedColor color;
  color.xy = answer.xy;
  if (const auto& noise = answer.findings.noise; noise && answer.has_cct()) {
    color.cct_K = UncertainFromNormal(answer.cct.temperature.value(), noise->temperature.value());
    color.duv = UncertainFromNormal(answer.cct.duv, noise->duv);
  }
  return report::ChromaticityPlot(color);
}

// The pictures asked for, of the one spectrum they are drawn of.
Result<std::vector<OutputFile>> PicturesOf(const ColorOptions& options,
                                           const std::vector<ColorAnswer>& answers) {
  std::vector<OutputFile> pictures;
  const auto check_one = [&](const std::string& option) -> Result<void> {
    if (answers.size() == 1) return {};
    return WrongUsage(option, "is drawn of one spectrum; choose it with --column");
  };
  if (!options.vector_graphic.empty()) {
    if (auto one = check_one("--vector-graphic"); !one) return Propagate(std::move(one));
    const ColorAnswer& answer = answers.front();
    const auto& rendering = answer.metrics.rendering;
    if (!rendering) {
      return Refused(
          "no_color_rendering", options.spectrum,
          "has no colour rendering to draw: the spectrum is too narrow or too coarse, or "
          "its colour has no temperature");
    }
    const std::string& title = answer.name.empty() ? options.spectrum : answer.name;
    auto picture =
        PictureFile(options.vector_graphic,
                    report::ColorVectorGraphic(rendering->fidelity, rendering->gamut, title));
    if (!picture) return Propagate(std::move(picture));
    pictures.push_back(*std::move(picture));
  }
  if (!options.extra.plot.empty()) {
    if (auto one = check_one("--plot"); !one) return Propagate(std::move(one));
    auto picture = PictureFile(options.extra.plot, PlotOf(answers.front()));
    if (!picture) return Propagate(std::move(picture));
    pictures.push_back(*std::move(picture));
  }
  return pictures;
}

Result<void> RunOneOrMany(const ColorOptions& options, const ColorExtras& extras,
                          Console& console) {
  const auto answered = AnswerColor(options, extras, console);
  if (!answered) return tl::unexpected(answered.error());
  if (auto allowed = console.RefuseIfStrict(); !allowed) return allowed;
  const auto pictures = PicturesOf(options, answered->colors);
  if (!pictures) return tl::unexpected(pictures.error());
  if (auto written = WriteOutputs(*pictures, options.force); !written) return written;
  if (answered->one) {
    if (!answered->behind.empty()) console.Print(ThroughText(answered->behind.front()) + "\n\n");
    console.Print(TableOfOne(answered->colors.front()));
  } else {
    console.Print(TableOfMany(answered->colors));
  }
  console.PrintDocument(DocumentOf(*answered));
  return {};
}

}  // namespace

Run BuildColor(CLI::App& parser) {
  auto o = std::make_shared<ColorOptions>();
  parser
      .add_option("color", o->typed,
                  "3200K, a chromaticity 0.33,0.34 or a spectrum: as --cct, --xy, --spectrum")
      ->expected(0, 3);
  parser.add_option("--xy", o->xy, "CIE 1931 chromaticity")
      ->delimiter(',')
      ->expected(2)
      ->type_name("X,Y");
  parser.add_option("--xyz", o->xyz, "Tristimulus values")
      ->delimiter(',')
      ->expected(3)
      ->type_name("X,Y,Z");
  parser.add_option("--cct", o->cct, "Colour temperature, e.g. 3200K")->type_name("K");
  parser.add_option("--duv", o->duv, "Distance from the Planckian locus, positive is greenish")
      ->type_name("D");
  parser.add_option("--locus", o->locus, "Where --cct lies")
      ->check(CLI::IsMember({"planck", "daylight"}))
      ->capture_default_str();
  parser
      .add_option("--spectrum", o->spectrum,
                  "A spectrometer's export, or illuminant:FL11, led:4000, gaussian:530:30")
      ->type_name("FILE");
  parser
      .add_option("--column", o->column,
                  "Which spectrum of the file: its name, or its number from 1")
      ->type_name("NAME|N");
  parser
      .add_option("--through", o->through,
                  "Put the lamp behind gels: gels.csv:L204, gels.csv:L204+L298, \"half cto\" of "
                  "--gels; gels.csv alone lists each of its gels")
      ->type_name("FILE:GEL");
  parser
      .add_option("--gels", o->gels,
                  "The gels that --through names [demonstration filters by formula]")
      ->type_name("FILE.csv");
  parser
      .add_option("--vector-graphic", o->vector_graphic,
                  "Write the TM-30 colour vector graphic of the spectrum")
      ->type_name("FILE.svg|png");
  parser.add_flag("--force", o->force, "Replace a file that lightcal did not write");
  parser.add_option("--batch", o->batch, "Lines of x,y; - reads standard input")
      ->type_name("FILE.csv");
  AddColorExtraOptions(parser, o->extra);
  return [o](Console& console) -> Result<void> {
    TakeTyped(*o);
    if (auto checked = CheckColor(*o); !checked) return checked;
    if (!o->batch.empty()) return RunColorBatch(o->batch, console);
    const auto extras = ParseColorExtras(o->extra);
    if (!extras) return tl::unexpected(extras.error());
    return RunOneOrMany(*o, *extras, console);
  };
}

}  // namespace lightcal::app
