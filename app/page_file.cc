// SPDX-License-Identifier: Apache-2.0
#include "page_file.h"

#include <filesystem>
#include <system_error>
#include <vector>

#include "lightcal/records/json_codec.h"
#include "lightcal/records/light_codec.h"
#include "lightcal_devices/transport/module_door.h"
#include "output_files.h"
#include "shell/shell_texts.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPageFile = "lightcal_page.html";
constexpr std::string_view kCarried = "id=\"carried\">null<";

}  // namespace

Result<std::string> ReadPage() {
  std::error_code ignored;
  const fs::path beside = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  std::vector<fs::path> places = {beside / kPageFile,
                                  beside / LIGHTCAL_DATA_DIR_FROM_BIN / kPageFile};
  if (const fs::path own = devices::OwnFolder(); own != beside) {  // part of a Python package
    places.push_back(own / devices::kModulesFromPython / kPageFile);
    places.push_back(own / LIGHTCAL_DATA_DIR_FROM_PYTHON / kPageFile);
  }
  for (const fs::path& place : places) {
    if (fs::exists(place, ignored)) return ReadOutput(place.string());
  }
  return Failed("no_page", kPageFile,
                "this lightcal was built without the page; install clang-19 lld-19 wasi-libc "
                "libc++-19-dev-wasm32 libclang-rt-19-dev-wasm32, then: `cmake --preset release && "
                "cmake --build --preset release --target lightcal_page`");
}

Result<std::string> PageWith(const LightFile& lights, const std::string& name) {
  auto page = ReadPage();
  if (!page) return page;
  auto json = LightFileToJson(lights);
  if (!json) return json;
  const std::size_t at = page->find(kCarried);
  if (at == std::string::npos) {
    return Failed("no_page", kPageFile, "is not of this lightcal; build it again");
  }
  const std::string quoted = records::PrintJson(records::Node(name), records::JsonLayout::kOneLine);
  // Inside a script element nothing may look like its end.
  const std::string carried = "{\"name\":" + quoted + ",\"light\":" + *json + "}";
  page->replace(at + kCarried.size() - 5, 4, Replaced(carried, "<", "\\u003c"));
  return page;
}

}  // namespace lightcal::app
