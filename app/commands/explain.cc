// SPDX-License-Identifier: Apache-2.0
// lightcal explain: which effects this scene calls for, and what each costs and contributes.
#include <CLI/CLI.hpp>
#include <memory>

#include "calibration_options.h"
#include "commands.h"
#include "light_table.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/records/light_codec.h"
#include "lightcal/report/gate_figure.h"
#include "output_files.h"
#include "picture_file.h"

namespace lightcal::app {
namespace {

struct ExplainOptions {
  CalibrationOptions calibration;
  std::string plot;
  bool force = false, timing = false;
};

Result<void> WritePlot(const ExplainOptions& options, const LightFile& lights) {
  const auto tolerance = ParseTolerance(options.calibration.tolerance);
  if (!tolerance) return tl::unexpected(tolerance.error());
  auto picture = PictureFile(options.plot, report::GatePlot(lights.lights, *tolerance));
  if (!picture) return Propagate(std::move(picture));
  return WriteOutputs({*std::move(picture)}, options.force);
}

Result<void> RunExplain(const ExplainOptions& options, Console& console) {
  auto settings = SettingsAsked(options.calibration);
  if (!settings) return Propagate(std::move(settings));
  settings->time_effects = options.timing;
  auto calibrated = CalibrateAloud(options.calibration.session, *std::move(settings), console);
  if (!calibrated) return Propagate(std::move(calibrated));
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  if (const auto json = LightFileToJson(calibrated->lights); !json) {
    return tl::unexpected(json.error());
  }
  if (!options.plot.empty()) {
    if (auto written = WritePlot(options, calibrated->lights); !written) return written;
  }
  for (const FittedLight& light : calibrated->lights.lights) {
    console.Print(light.name + ": " + Headline(light) + "\n" + EffectTable(light) +
                  EffectsOfNoConcern(light) + "\n" + BudgetTable(light) +
                  "next: " + NextStep(calibrated->session, light) + "\n\n");
  }
  console.PrintDocument({{"lights", Node::List(calibrated->lights.lights, ExplanationOf)}});
  return {};
}

}  // namespace

Run BuildExplain(CLI::App& parser) {
  auto options = std::make_shared<ExplainOptions>();
  AddCalibrationOptions(parser, options->calibration);
  parser
      .add_option("--plot", options->plot,
                  "Write what the gate saves: cost and error of these lights beside other scenes")
      ->type_name("FILE.svg|png");
  parser.add_flag("--timing", options->timing,
                  "Measure what each effect costs here and now [as declared: the same bytes]");
  parser.add_flag("--force", options->force,
                  "Replace an existing file that lightcal did not write");
  return [options](Console& console) { return RunExplain(*options, console); };
}

}  // namespace lightcal::app
