// SPDX-License-Identifier: Apache-2.0
#include "told_error.h"

namespace lightcal::app {

Result<void> EndTold(Console& console, records::Node document, const Error& error) {
  document.Put("error", DocumentOf(error));
  console.PrintDocument(std::move(document));
  PrintError(error, false);
  return tl::unexpected(Error{error.kind, "", "", ""});
}

}  // namespace lightcal::app
