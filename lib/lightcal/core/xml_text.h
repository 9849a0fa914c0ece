// SPDX-License-Identifier: Apache-2.0
// Text in XML.
#pragma once

#include <string>
#include <string_view>

namespace lightcal {

// For attributes between double quotes, element contents and comments' words: & < > " escaped,
// control characters, which XML 1.0 has not, blanks.   Source: W3C, XML 1.0, 2.2, 2.4.
[[nodiscard]] std::string XmlEscaped(std::string_view text);

}  // namespace lightcal
