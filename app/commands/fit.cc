// SPDX-License-Identifier: Apache-2.0
// lightcal fit: the estimate, as light.json.
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "light_table.h"
#include "lightcal/records/light_codec.h"
#include "output_files.h"
#include "session_input.h"

namespace lightcal::app {
namespace {

struct Options {
  std::string session;
  std::string output;
  std::string tolerance = "1%";
  std::string effects = "auto";
  bool force = false;
};

Result<void> RunFit(const Options& options, Console& console) {
  const auto tolerance = ParseTolerance(options.tolerance);
  if (!tolerance) return tl::unexpected(tolerance.error());
  auto calibrated = CalibrateSession(options.session, {*tolerance, options.effects}, console);
  if (!calibrated) return Propagate(std::move(calibrated));
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  const auto json = LightFileToJson(calibrated->lights);
  if (!json) return tl::unexpected(json.error());
  const std::string path = options.output.empty()
                               ? DefaultOutputDirectory(calibrated->session) + "/light.json"
                               : options.output;
  if (auto written = WriteOutputs({{path, *json}}, options.force); !written) return written;
  console.Print(LightTable(calibrated->lights) + "\n" + FitTable(calibrated->lights));
  console.PrintJson(nlohmann::ordered_json::parse(*json));
  console.Note("wrote " + path);
  return {};
}

}  // namespace

Run BuildFit(CLI::App& parser) {
  auto options = std::make_shared<Options>();
  parser.add_option("session", options->session, "Session directory or .toml file")->required();
  parser.add_option("-o,--output", options->output,
                    "Where light.json goes [SESSION/out/light.json]");
  parser.add_option("--tol", options->tolerance, "Tolerance of the effect gate")
      ->capture_default_str();
  parser.add_option("--effects", options->effects, "auto, all, none, or +name,-name")
      ->capture_default_str();
  parser.add_flag("--force", options->force, "Replace a light.json that lightcal did not write");
  return [options](Console& console) { return RunFit(*options, console); };
}

}  // namespace lightcal::app
