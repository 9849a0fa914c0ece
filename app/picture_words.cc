// SPDX-License-Identifier: Apache-2.0
#include "picture_words.h"

#include <string_view>

#include "lightcal/core/nearest_word.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal::app {

Result<LuminanceConvention> ParseConvention(const std::string& option, const std::string& word) {
  if (word == "photometric") return LuminanceConvention::kPhotometric;
  if (word == "radiometric") return LuminanceConvention::kRadiometric;
  if (word == "radiance") return LuminanceConvention::kRadiance;
  return WrongUsage(option, "\"" + word + "\" is none of photometric, radiometric, radiance");
}

Result<Projection> ParseProjection(const std::string& option, const std::string& word) {
  if (const auto projection = ProjectionByName(word)) return *projection;
  const std::string near = NearestWord(word, kProjectionWords);
  return WrongUsage(option, "\"" + word + "\" is none of rect, latlong, equidistant, equisolid" +
                                (near.empty() ? "" : "; did you mean " + near + "?"));
}

Result<double> ParseShare(const std::string& option, const std::string& text) {
  std::string_view digits = TrimBlanks(text);
  const bool percent = digits.ends_with('%');
  if (percent) digits.remove_suffix(1);
  const auto number = ParseNumber(TrimBlanks(digits));
  const double share = number ? *number / (percent ? 100.0 : 1.0) : -1.0;
  if (!(share > 0.0 && share < 1.0)) {
    return WrongUsage(option, "\"" + text + "\" is not a share such as 2% or 0.02");
  }
  return share;
}

}  // namespace lightcal::app
