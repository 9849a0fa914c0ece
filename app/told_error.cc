// SPDX-License-Identifier: Apache-2.0
#include "told_error.h"

#include <nlohmann/json.hpp>

namespace lightcal::app {

Result<void> EndTold(Console& console, nlohmann::ordered_json document, const Error& error) {
  document["error"] = {
      {"code", error.code}, {"subject", error.subject}, {"message", error.message}};
  console.PrintJson(document);
  PrintError(error, false);
  return tl::unexpected(Error{error.kind, "", "", ""});
}

}  // namespace lightcal::app
