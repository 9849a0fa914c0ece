// SPDX-License-Identifier: Apache-2.0
#include "test_headers.h"

template class nlohmann::basic_json<>;
template class nlohmann::detail::serializer<nlohmann::json>;
template class nlohmann::detail::parser<
    nlohmann::json, nlohmann::detail::iterator_input_adapter<std::string::const_iterator>>;
template class std::vector<nlohmann::json>;
template class std::map<std::string, nlohmann::json, std::less<>>;

namespace nlohmann {
void PrintTo(const json& value, std::ostream* out) { *out << value; }
}  // namespace nlohmann
