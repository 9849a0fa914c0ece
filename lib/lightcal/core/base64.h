// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace lightcal {

// Bytes as base64 text, as data: URIs hold them.   Source: RFC 4648, 4.
[[nodiscard]] std::string Base64(std::string_view bytes);

}  // namespace lightcal
