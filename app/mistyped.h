// SPDX-License-Identifier: Apache-2.0
// What a person meant who typed a command line that does not parse.
#pragma once

#include <string>

#include "lightcal/core/result.h"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace lightcal::app {

// Names the unknown command or option, or the word that is none of an option's, and the nearest one
// there is; anything else in the parser's own words. `parser` is lightcal's, after its parse() has
// thrown.
[[nodiscard]] Error MistypedLine(const CLI::App& parser, const CLI::ParseError& thrown);

}  // namespace lightcal::app
