// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/module_door.h"

#include <dlfcn.h>

#include <array>
#include <filesystem>
#include <system_error>

namespace lightcal::devices {

namespace fs = std::filesystem;

Result<void*> OpenModule(const std::string& name, const char* symbol, const std::string& code,
                         const std::string& what) {
  std::error_code ignored;
  const fs::path beside = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  const std::array<std::string, 3> places = {
      (beside / name).string(), (beside / LIGHTCAL_MODULE_DIR_FROM_BIN / name).string(), name};
  std::string said;
  for (const std::string& place : places) {
    if (place.find('/') != std::string::npos && !fs::exists(place, ignored)) continue;
    void* const module = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* const found = module != nullptr ? dlsym(module, symbol) : nullptr;
    if (found != nullptr) return found;
    const char* const error = dlerror();  // NOLINT(concurrency-mt-unsafe): callers hold a static
    if (error != nullptr) said = error;
  }
  return Failed(code, name, what + " does not load (" + said + "); install lightcal whole");
}

}  // namespace lightcal::devices
