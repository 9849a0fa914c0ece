// SPDX-License-Identifier: Apache-2.0
// What nearly every test includes, compiled once for all of them (a precompiled header, see
// CMakeLists.txt), and JSON, whose code test_headers.cc holds once instead of every test anew.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"

namespace nlohmann {
// What GoogleTest prints of a value: its JSON text.
void PrintTo(const json& value, std::ostream* out);
}  // namespace nlohmann

extern template class nlohmann::basic_json<>;
extern template class nlohmann::detail::serializer<nlohmann::json>;
extern template class nlohmann::detail::parser<
    nlohmann::json, nlohmann::detail::iterator_input_adapter<std::string::const_iterator>>;
extern template class std::vector<nlohmann::json>;
extern template class std::map<std::string, nlohmann::json, std::less<>>;
