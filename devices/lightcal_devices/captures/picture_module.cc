// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/picture_module.h"

#include <dlfcn.h>

#include <array>
#include <filesystem>
#include <string>
#include <system_error>

namespace lightcal {
namespace {

namespace fs = std::filesystem;

// Never closed: OpenImageIO's threads outlive any scope of ours.
Result<OiioRead> Open() {
  std::error_code ignored;
  const fs::path beside = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  const std::array<std::string, 3> places = {
      (beside / kOiioModuleName).string(),
      (beside / LIGHTCAL_MODULE_DIR_FROM_BIN / kOiioModuleName).string(), kOiioModuleName};
  std::string said;
  for (const std::string& place : places) {
    if (place.find('/') != std::string::npos && !fs::exists(place, ignored)) continue;
    void* const module = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* const symbol = module != nullptr ? dlsym(module, kOiioReadSymbol) : nullptr;
    if (symbol != nullptr) return reinterpret_cast<OiioRead>(symbol);
    const char* const error = dlerror();  // NOLINT(concurrency-mt-unsafe): inside a static's start
    if (error != nullptr) said = error;
  }
  return Failed("no_picture_module", kOiioModuleName,
                "the part that reads HDR, TIFF, PNG and JPEG does not load (" + said +
                    "); install lightcal whole");
}

}  // namespace

Result<OiioRead> PictureModule() {
  static const Result<OiioRead> module = Open();
  return module;
}

}  // namespace lightcal
