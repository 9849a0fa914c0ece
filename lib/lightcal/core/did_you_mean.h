// SPDX-License-Identifier: Apache-2.0
// What a person may have meant by a name that nothing has.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/joined.h"
#include "lightcal/core/nearest_word.h"

namespace lightcal {

// "; did you mean "key"?", or, where nothing is near, "; there are key, fill": of what has names.
template <class Named>
[[nodiscard]] std::string DidYouMean(std::string_view name, const std::vector<Named>& known) {
  std::vector<std::string_view> names;
  names.reserve(known.size());
  for (const Named& item : known) names.push_back(item.name);
  const std::string nearest = NearestWord(name, names);
  if (!nearest.empty()) return "; did you mean \"" + nearest + "\"?";
  return names.empty() ? "" : "; there are " + Joined(names);
}

}  // namespace lightcal
