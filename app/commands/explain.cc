// SPDX-License-Identifier: Apache-2.0
// lightcal explain: which effects this scene calls for, and what each costs and contributes.
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "light_table.h"
#include "lightcal/records/light_codec.h"
#include "session_input.h"

namespace lightcal::app {
namespace {

struct Options {
  std::string session;
  std::string tolerance = "1%";
  std::string effects = "auto";
};

Result<void> RunExplain(const Options& options, Console& console) {
  const auto tolerance = ParseTolerance(options.tolerance);
  if (!tolerance) return tl::unexpected(tolerance.error());
  auto calibrated = CalibrateSession(options.session, {*tolerance, options.effects}, console);
  if (!calibrated) return Propagate(std::move(calibrated));
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  const auto json = LightFileToJson(calibrated->lights);
  if (!json) return tl::unexpected(json.error());
  const auto whole = nlohmann::ordered_json::parse(*json);
  nlohmann::ordered_json document = {{"tolerance", *tolerance},
                                     {"lights", nlohmann::ordered_json::array()}};
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
  auto options = std::make_shared<Options>();
  parser.add_option("session", options->session, "Session directory or .toml file")->required();
  parser.add_option("--tol", options->tolerance, "Tolerance of the effect gate")
      ->capture_default_str();
  parser.add_option("--effects", options->effects, "auto, all, none, or +name,-name")
      ->capture_default_str();
  return [options](Console& console) { return RunExplain(*options, console); };
}

}  // namespace lightcal::app
