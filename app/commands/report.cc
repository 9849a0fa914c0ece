// SPDX-License-Identifier: Apache-2.0
// lightcal report: one self-contained page of a session or of fitted lights.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "lightcal/records/light_codec.h"
#include "output_files.h"
#include "report_html.h"
#include "session_input.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string input;
  std::string output;
  bool force = false;
};

struct Source {
  LightFile lights;
  std::string title;
  std::string default_output;
};

Result<Source> FromLightFile(const std::string& path) {
  const auto text = ReadWholeFile(path);
  if (!text) return tl::unexpected(text.error());
  auto lights = LightFileFromJson(*text, path);
  if (!lights) return Propagate(std::move(lights));
  return Source{std::move(*lights), fs::path(path).stem().string(),
                (fs::path(path).parent_path() / "report.html").string()};
}

Result<Source> FromSession(const std::string& path, Console& console) {
  auto calibrated = CalibrateSession(path, CalibrationRequest{}, console);
  if (!calibrated) return Propagate(std::move(calibrated));
  const Session& session = calibrated->session;
  return Source{std::move(calibrated->lights), session.name.empty() ? session.stem : session.name,
                (fs::path(DefaultOutputDirectory(session)) / "report.html").string()};
}

Result<void> RunReport(const Options& options, Console& console) {
  const bool is_light_file = fs::path(options.input).extension() == ".json";
  const auto source =
      is_light_file ? FromLightFile(options.input) : FromSession(options.input, console);
  if (!source) return tl::unexpected(source.error());
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  const std::string path = options.output.empty() ? source->default_output : options.output;
  if (auto written =
          WriteOutputs({{path, ReportHtml(source->lights, source->title)}}, options.force);
      !written) {
    return written;
  }
  console.Print("wrote " + path + "\n");
  console.PrintJson({{"files", nlohmann::ordered_json::array({path})}});
  return {};
}

}  // namespace

Run BuildReport(CLI::App& parser) {
  auto options = std::make_shared<Options>();
  parser.add_option("input", options->input, "light.json, session directory or .toml file")
      ->required();
  parser.add_option("-o,--output", options->output,
                    "The page [SESSION/out/report.html, or beside light.json]");
  parser.add_flag("--force", options->force, "Replace a file that lightcal did not write");
  return [options](Console& console) { return RunReport(*options, console); };
}

}  // namespace lightcal::app
