// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "validate/validate_file.h"

namespace lightcal::app {

// A session directory or its .toml, with its journal and shoots. A row of the journal that no fit
// would use is an error, and so is a file that the session names and that is not there.
void ValidateSession(FileVerdict& verdict);

// A journal: with the session it lies beside, or line by line where there is none.
void ValidateJournal(std::string_view text, FileVerdict& verdict);

// "1 light", "3 lights"
[[nodiscard]] std::string Counted(std::size_t count, const std::string& noun);

}  // namespace lightcal::app
