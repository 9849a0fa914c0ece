// SPDX-License-Identifier: Apache-2.0
// lightcal explain: which effects this scene calls for, and what each costs and contributes.
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "calibration_options.h"
#include "commands.h"
#include "light_table.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/records/light_codec.h"

namespace lightcal::app {
namespace {

Result<void> RunExplain(const CalibrationOptions& options, Console& console) {
  auto calibrated = Calibrate(options, console);
  if (!calibrated) return Propagate(std::move(calibrated));
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  const auto json = LightFileToJson(calibrated->lights);
  if (!json) return tl::unexpected(json.error());
  const auto whole = nlohmann::ordered_json::parse(*json);
  nlohmann::ordered_json document = {{"lights", nlohmann::ordered_json::array()}};
  for (const auto& light : whole["lights"]) {
    document["lights"].push_back({{"name", light["name"]}, {"effects", light["effects"]}});
  }
  for (const FittedLight& light : calibrated->lights.lights) {
    console.Print(light.name + ": " + Headline(light) + "\n" + EffectTable(light) +
                  "next: " + NextStep(calibrated->session, light) + "\n\n");
  }
  console.PrintJson(document);
  return {};
}

}  // namespace

Run BuildExplain(CLI::App& parser) {
  auto options = std::make_shared<CalibrationOptions>();
  AddCalibrationOptions(parser, *options);
  return [options](Console& console) { return RunExplain(*options, console); };
}

}  // namespace lightcal::app
