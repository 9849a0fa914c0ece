// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/usd_over_layer.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string_view>

#include "lightcal/presets/preset_text.h"

namespace lightcal {
namespace {

// /World/Lamps/Key as its parts; nothing where it is no path of a prim.
std::vector<std::string> PartsOfPath(std::string_view path) {
  std::vector<std::string> parts;
  if (path.starts_with('/')) path.remove_prefix(1);
  while (true) {
    const std::size_t slash = std::min(path.find('/'), path.size());
    std::set<std::string> none;
    const std::string part(path.substr(0, slash));
    if (part.empty() || preset_text::Identifier(part, none) != part) return {};
    parts.push_back(part);
    if (slash == path.size()) return parts;
    path.remove_prefix(slash + 1);
  }
}

// Prims by name, each with its opinions and what stands below it.
struct Over {
  std::string opinions;  // of the prim itself: head, then body
  std::string head;
  std::map<std::string, Over> below;
};

std::string OverText(const std::string& name, const Over& over, const std::string& indent) {
  std::string text = "\n" + indent + "over \"" + name + "\"" + over.head + "\n" + indent + "{\n";
  for (std::size_t at = 0; at < over.opinions.size();) {
    const std::size_t end = over.opinions.find('\n', at);
    text += indent + over.opinions.substr(at, end - at) + "\n";
    at = end + 1;
  }
  for (const auto& [child, one] : over.below) text += OverText(child, one, indent + "  ");
  return text + indent + "}\n";
}

}  // namespace

Result<std::string> UsdOverLayer(const std::string& generator,
                                 const std::vector<UsdOpinions>& prims) {
  Over root;
  for (const UsdOpinions& prim : prims) {
    const std::vector<std::string> parts = PartsOfPath(prim.path);
    if (parts.empty()) {
      return Refused("into_path", prim.path,
                     "is no path of a prim, and a USD layer names prims by nothing else: write "
                     "/World/Lamps/Key, a line a prim in a map.csv");
    }
    Over* over = &root;
    for (const std::string& part : parts) over = &over->below[part];
    over->head = prim.head;
    over->opinions = prim.body;
  }
  std::string text =
      "#usda 1.0\n(\n  doc = \"" + generator +
      ": opinions for the lights of a stage whose metersPerUnit is 1; name this layer first in its "
      "subLayers. Not executed in a renderer\"\n)\n";
  for (const auto& [name, over] : root.below) text += OverText(name, over, "");
  return text;
}

}  // namespace lightcal
