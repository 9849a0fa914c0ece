// SPDX-License-Identifier: Apache-2.0
#include "check/read_scenes.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <utility>

#include "lightcal/records/photometric_codec.h"

namespace lightcal::app {

void TakeTable(EngineLight& light, const std::string& photometric) {
  auto read = PhotometricFromText(photometric, light.name);
  if (!read) throw std::runtime_error(read.error().message);
  light.kind = EngineLightKind::kTable;
  light.table = std::move(read->file.table);
  if (light.name.empty()) light.name = read->file.header.luminaire;
}

std::vector<double> NumbersIn(std::string_view text) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  bool in_word = false;  // the 3 of Vector3 is no number
  while (at < end) {
    const bool letter = (*at >= 'a' && *at <= 'z') || (*at >= 'A' && *at <= 'Z') || *at == '_';
    const bool digit = *at >= '0' && *at <= '9';
    double value = 0.0;
    if (!in_word && (digit || *at == '-' || *at == '.')) {
      const auto [next, error] = std::from_chars(at, end, value);
      if (error == std::errc()) numbers.push_back(value);
      at = std::max(next, at + 1);
      continue;
    }
    in_word = letter || (in_word && digit);
    ++at;
  }
  return numbers;
}

}  // namespace lightcal::app
