// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/transport/module_door.h"

#include <dlfcn.h>

#include <filesystem>
#include <system_error>
#include <vector>

namespace lightcal::devices {

namespace fs = std::filesystem;

std::string OwnFolder() {
  Dl_info own{};
  std::error_code ignored;
  if (dladdr(reinterpret_cast<const void*>(&OpenModule), &own) == 0 || own.dli_fname == nullptr) {
    return {};
  }
  return fs::weakly_canonical(own.dli_fname, ignored).parent_path().string();
}

Result<void*> OpenModule(const std::string& name, const char* symbol, const std::string& code,
                         const std::string& what) {
  std::error_code ignored;
  const fs::path beside = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  std::vector<std::string> places = {(beside / name).string(),
                                     (beside / LIGHTCAL_MODULE_DIR_FROM_BIN / name).string()};
  if (const fs::path own = OwnFolder(); own != beside) {  // part of a Python package
    places.push_back((own / kModulesFromPython / name).string());
  }
  places.push_back(name);
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
