// SPDX-License-Identifier: Apache-2.0
// lightcal fit: the estimate, as light.json.
#include <CLI/CLI.hpp>
#include <memory>

#include "calibration_options.h"
#include "commands.h"
#include "light_table.h"
#include "lightcal/records/light_codec.h"
#include "output_files.h"

namespace lightcal::app {
namespace {

struct FitOptions {
  CalibrationOptions calibration;
  std::string output;
  bool force = false;
};

Result<void> RunFit(const FitOptions& options, Console& console) {
  auto calibrated = Calibrate(options.calibration, console);
  if (!calibrated) return Propagate(std::move(calibrated));
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  const auto json = LightFileToJson(calibrated->lights);
  if (!json) return tl::unexpected(json.error());
  const std::string path = options.output.empty()
                               ? DefaultOutputDirectory(calibrated->session) + "/light.json"
                               : options.output;
  if (auto written = WriteOutputs({{path, *json}}, options.force); !written) return written;
  console.Print(LightTable(calibrated->lights) + "\n" + FitTable(calibrated->lights));
  console.PrintDocument(DocumentOf(calibrated->lights));
  console.Note("wrote " + path);
  return {};
}

}  // namespace

Run BuildFit(CLI::App& parser) {
  auto options = std::make_shared<FitOptions>();
  AddCalibrationOptions(parser, options->calibration);
  parser.add_option("-o,--output", options->output,
                    "Where light.json goes [SESSION/out/light.json]");
  parser.add_flag("--force", options->force, "Replace a light.json that lightcal did not write");
  return [options](Console& console) { return RunFit(*options, console); };
}

}  // namespace lightcal::app
