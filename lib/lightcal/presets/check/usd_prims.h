// SPDX-License-Identifier: Apache-2.0
// The prims of a .usda, one attribute a line: what each says, and where it hangs.
#pragma once

#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "lightcal/presets/check/reader_parts.h"
#include "lightcal/presets/check/scene_frame.h"

namespace lightcal {

struct UsdPrim {
  std::string type, name;
  std::string space{};                          // of its colours: "acescg"; "" = Rec. 709
  std::map<std::string, std::string> values{};  // "inputs:radius" -> "0.5"; metadata, too
  std::size_t parent = 0;                       // of the list; 0 = the layer itself

  [[nodiscard]] const std::string& Text(const std::string& key) const {
    static const std::string kNothing;
    const auto it = values.find(key);
    return it == values.end() ? kNothing : it->second;
  }
  [[nodiscard]] double Number(const std::string& key, double by_default) const {
    const std::string& text = Text(key);
    if (text.empty()) return by_default;
    if (text == "true" || text == "false") return text == "true" ? 1.0 : 0.0;
    return OneNumber(name + ": " + key, std::string_view(text).substr(0, text.find(" (")));
  }
  [[nodiscard]] bool On(const std::string& key) const { return Number(key, 0.0) != 0.0; }
};

// `def Type "name"` begins a prim, which its brace ends; `over "name"` goes on with one that was
// there. The first is the layer's own metadata, with its chosen "renderer". Of variants those that
// the file opens with. Throws std::exception with what is wrong.
[[nodiscard]] std::vector<UsdPrim> UsdPrimsOf(const std::string& text);

// Nothing but opinions on lights of a person's stage.
[[nodiscard]] bool AreOversAlone(const std::vector<UsdPrim>& prims);

struct PlacedPrim {
  SceneFrame frame;
  bool hidden = false;  // it, or what it hangs below: inactive or invisible
};
[[nodiscard]] PlacedPrim PlaceOfPrim(const std::vector<UsdPrim>& prims, const UsdPrim& prim);

}  // namespace lightcal
