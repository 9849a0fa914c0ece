// SPDX-License-Identifier: Apache-2.0
// Pieces of JSON that several exporters write, and the app too. Json is nlohmann::ordered_json or
// nlohmann::json, which only .cc files may name.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::json_pieces {

template <class Json, std::size_t N>
[[nodiscard]] Json Array(const std::array<double, N>& values) {
  Json list = Json::array();
  for (const double v : values) list.push_back(v == 0.0 ? 0.0 : v);  // -0 is written 0
  return list;
}

template <class Json>
[[nodiscard]] Json UncertainJson(const Uncertain& u) {
  Json json = {{"value", u.value}, {"u95", u.u95}};
  if (u.low) json["low95"] = *u.low;
  if (u.high) json["high95"] = *u.high;
  return json;
}

template <class Json>
void Put(Json& object, const char* key, const std::optional<Uncertain>& value) {
  if (value) object[key] = UncertainJson<Json>(*value);
}
template <class Json>
void Put(Json& object, const char* key, const std::optional<double>& value) {
  if (value) object[key] = *value == 0.0 ? 0.0 : *value;
}

// [{"path": ..., "sha256": ...}, ...]
template <class Json>
[[nodiscard]] Json FilesJson(const std::vector<InputFile>& files) {
  Json list = Json::array();
  for (const InputFile& file : files) {
    list.push_back({{"path", file.path}, {"sha256", file.sha256}});
  }
  return list;
}
// The text at a key; empty where there is none.
template <class Json>
[[nodiscard]] std::string TextAt(const Json& json, const char* key) {
  const auto it = json.find(key);
  return it != json.end() && it->is_string() ? it->template get<std::string>() : std::string();
}
// FilesJson read back from under a key; what a file lacks is empty.
template <class Json>
[[nodiscard]] std::vector<InputFile> FilesAt(const Json& json, const char* key) {
  std::vector<InputFile> files;
  const auto it = json.find(key);
  if (it == json.end() || !it->is_array()) return files;
  for (const Json& file : *it) files.push_back({TextAt(file, "path"), TextAt(file, "sha256")});
  return files;
}

template <class Json>
[[nodiscard]] Json ProvenanceJson(const Provenance& provenance) {
  Json json = {{"generator", provenance.generator.empty() ? "lightcal" : provenance.generator}};
  if (!provenance.time.empty()) json["time"] = provenance.time;
  if (!provenance.devices.empty()) json["devices"] = provenance.devices;
  json["inputs"] = FilesJson<Json>(provenance.inputs);
  return json;
}

template <class Json>
[[nodiscard]] bool AllFinite(const Json& json) {
  if (json.is_number_float()) return std::isfinite(json.template get<double>());
  if (!json.is_structured()) return true;
  for (const auto& element : json) {
    if (!AllFinite(element)) return false;
  }
  return true;
}

// Indented text with a final newline; bytes that are not UTF-8 become U+FFFD.
// Fails: not_finite, rather than write null for a number.
template <class Json>
[[nodiscard]] Result<std::string> TextOf(const Json& json, const std::string& subject) {
  if (!AllFinite(json)) {
    return Failed("not_finite", subject, "a number of the light is not finite; nothing exported");
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lightcal::json_pieces
