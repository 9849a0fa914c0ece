// SPDX-License-Identifier: Apache-2.0
// A USD layer of `over`s: opinions on prims of a person's stage, and nothing else.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"

namespace lightcal {

// What the layer says of one prim.
struct UsdOpinions {
  std::string path{};  // "/World/Lamps/Key"
  std::string head{};  // metadata in parentheses after the prim's name, or ""
  std::string body{};  // whole lines between its braces, indented by 2 as below the root
};

// The layer's text: prims below one another as their paths say, by name; of one path's opinions
// the last. `generator` begins its doc. Refused: into_path (a path is no path of a prim).
[[nodiscard]] Result<std::string> UsdOverLayer(const std::string& generator,
                                               const std::vector<UsdOpinions>& prims);

}  // namespace lightcal
