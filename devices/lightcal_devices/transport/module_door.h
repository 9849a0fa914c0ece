// SPDX-License-Identifier: Apache-2.0
// lightcal's own modules: parts that load many libraries and are opened on first use.
#pragma once

#include <string>

#include "lightcal/core/result.h"

namespace lightcal::devices {

// The folder of the file that this code was loaded from: the program's, or of a Python module that
// lightcal is part of; "" = nobody knows. There the modules lie in kModulesFromPython.
[[nodiscard]] std::string OwnFolder();
inline constexpr const char* kModulesFromPython = "../../../lightcal";

// The function `symbol` of the module `name` ("lightcal_pictures.so"), looked for beside the
// executable, then in ../<libdir>/lightcal from there, then where the system looks for libraries
// (LD_LIBRARY_PATH, run path). The module is never closed: its libraries' threads outlive any
// scope. Fails: `code`, the message beginning with `what` and holding what the loader said.
[[nodiscard]] Result<void*> OpenModule(const std::string& name, const char* symbol,
                                       const std::string& code, const std::string& what);

// The functions that a module answers, where `symbol` is a `const Functions* ()`. Fails as above.
template <class Functions>
Result<const Functions*> OpenModuleFunctions(const std::string& name, const char* symbol,
                                             const std::string& code, const std::string& what) {
  const auto entry = OpenModule(name, symbol, code, what);
  if (!entry) return tl::unexpected(entry.error());
  return reinterpret_cast<const Functions* (*)()>(*entry)();
}

}  // namespace lightcal::devices
