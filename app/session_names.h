// SPDX-License-Identifier: Apache-2.0
// Names a person types, against those a session has.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/joined.h"
#include "lightcal/core/nearest_word.h"
#include "lightcal/core/result.h"
#include "lightcal/records/session.h"

namespace lightcal::app {

// "; did you mean "key"?", or, where nothing is near, "; there are key, fill".
template <class Item>
std::string DidYouMean(std::string_view name, const std::vector<Item>& known) {
  std::vector<std::string_view> names;
  names.reserve(known.size());
  for (const Item& item : known) names.push_back(item.name);
  const std::string nearest = NearestWord(name, names);
  if (!nearest.empty()) return "; did you mean \"" + nearest + "\"?";
  return names.empty() ? "" : "; there are " + Joined(names);
}

// Whether the session has this light, and this meter ("" and data_sheet are always there).
// Refused: unknown_light, unknown_meter, with what is meant instead.
[[nodiscard]] Result<void> CheckNames(const Session& session, const std::string& light,
                                      const std::string& meter);

}  // namespace lightcal::app
