// SPDX-License-Identifier: Apache-2.0
// The numbers one light has in one engine's file, by the file's own field names: what the exporter
// writes and what <stem>.preset.json lists for audit, from the same values.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lightcal {

struct DerivedField {
  std::string name;
  std::vector<double> values;  // one number, or a vector
};

struct DerivedLight {
  std::string type;  // "SpotLight3D", "RectLight", ...
  std::vector<DerivedField> fields;
  std::vector<DerivedField> notes;      // how they came about; in no file but preset.json
  std::vector<DerivedField> elsewhere;  // what its file says of it in another place; not listed
  std::string substitution;  // what this light does otherwise than the lamp; "" = nothing

  void Put(std::string name, double value) { fields.push_back({std::move(name), {value}}); }
  void Put(std::string name, std::vector<double> values) {
    fields.push_back({std::move(name), std::move(values)});
  }
  [[nodiscard]] const DerivedField* Find(std::string_view name) const {
    for (const auto* part : {&fields, &elsewhere}) {
      for (const DerivedField& field : *part) {
        if (field.name == name) return &field;
      }
    }
    return nullptr;
  }
};

}  // namespace lightcal
