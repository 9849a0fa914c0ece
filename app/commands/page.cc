// SPDX-License-Identifier: Apache-2.0
// lightcal page: the page for a phone or another computer, with lights in it or without.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "light_input.h"
#include "output_files.h"
#include "page_file.h"

namespace lightcal::app {
namespace {

struct PageOptions {
  std::string lights;
  std::string output = "lightcal.html";
  bool force = false;
};

Result<void> RunPage(const PageOptions& options, Console& console) {
  Result<std::string> page;
  if (options.lights.empty()) {
    page = ReadPage();
  } else {
    const auto lights = LightsIn(options.lights);
    if (!lights) return tl::unexpected(lights.error());
    page = PageWith(*lights, std::filesystem::path(options.lights).filename().string());
  }
  if (!page) return Propagate(std::move(page));
  const std::vector<OutputFile> files = {{options.output, *std::move(page)}};
  if (auto written = WriteOutputs(files, options.force); !written) return written;
  console.Print("wrote " + options.output + "\n");
  console.Note("open it in any browser, or send it to a phone: it asks for no network");
  console.PrintDocument({{"files", PathsOf(files)}});
  return {};
}

}  // namespace

Run BuildPage(CLI::App& parser) {
  auto options = std::make_shared<PageOptions>();
  parser.add_option("lights", options->lights,
                    "Lights to carry along: a light.json or a session that was run [none]");
  parser.add_option("-o,--output", options->output, "The page")->capture_default_str();
  parser.add_flag("--force", options->force, "Replace a file that lightcal did not write");
  return [options](Console& console) { return RunPage(*options, console); };
}

}  // namespace lightcal::app
